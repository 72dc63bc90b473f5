#pragma once
// Trials of `recommend --verify`: does it see that the run that it follows is a wrong integrator's?

#include <span>
#include <vector>

#include "validation/judges/judge_trials.h"
#include "validation/scenes/scene_reference.h"

namespace dartboard {

/// For each of these methods a step is recommended for the error, as if there were no other; if its run meets the
/// error, it is run again wrong in each way. A wrong run that misses the error, or is diagnosed, counts as seen.
std::vector<JudgeTrial> try_followed(const TradeoffScene& scene, const SceneReference& reference,
                                     std::span<const IntegratorEntry> methods, double error, const CpuClock& clock);

}  // namespace dartboard
