#pragma once
// `recommend --verify` before the court: does it see that the run that it follows is a wrong integrator's?

#include <span>
#include <vector>

#include "validation/judges/judge_trials.h"
#include "validation/scenes/scene_reference.h"

namespace dartboard {

/// Each of these methods is recommended a step for the error, as if there were no other; where its run meets the error,
/// it is run again wrong in each way. What misses the error, or is diagnosed, is seen.
std::vector<JudgeTrial> try_followed(const TradeoffScene& scene, const SceneReference& reference,
                                     std::span<const IntegratorEntry> methods, double error, const CpuClock& clock);

}  // namespace dartboard
