#pragma once
// Variants timed by `bench ablation`: a scene with each feature switched on from a bare one and off from a full one,
// and the bare scene compared with loops that do less and less around them.

#include <functional>
#include <string>
#include <vector>

#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/paired.h"
#include "core/scene/body/memory.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// A scene, and the output that it produces: every tenth step.
struct AblationVariant {
  std::string name;  // "bare", "bare + damping", "full", "full - damping"
  SceneFile scene;
  bool frames = false, diagnostics = false;
};

/// Bytes that built objects report for parts that a bare scene does not ask for.
std::size_t bytes_not_asked_for(const MemoryReport& report);
/// Bytes of damping: its part, and those of the springs beyond a rest length, a stiffness and two ends each.
std::size_t bytes_of_damping(const MemoryReport& report, std::size_t springs);

/// Two tasks to compare: `task` takes the time of `baseline` and that of the feature.
struct AblationPair {
  std::string feature;
  std::string task, baseline;
};

/// The body of the paper's size: bare, full, and each feature on and off.
std::vector<AblationVariant> ablation_variants();
/// Each pair times one feature, which the first has and the second has not.
std::vector<AblationPair> switched_on();
std::vector<AblationPair> switched_off();

/// The bare scene, step by step less around it: "simulation" (Simulation::advance), "watched loop" (the integrator,
/// then the detector and the speed check), "loop and detector", "loop" (the integrator on plain arrays, nothing else),
/// "plain loop" (the same method written out for springs and masses alone: no damping, viscosity or fixed vertices
/// anywhere in it, and no look at whether the state is finite).
std::vector<AblationPair> staircase();

/// Does the extra work of the task of a pair take at most half a percent of a step? Not tested where the interval lies
/// on both sides of that with the median above, or where the baseline, which does less, is slower by more than its
/// interval: it is no lower bound then, and the ratio says nothing.
Verdict verdict_on_time(const Figure& task_over_baseline);

struct AblationOptions {
  int process = 0, rounds = 8, steps = 100;
  std::uint64_t seed = 1;
};

/// Time all variants and loops in this process.
///
/// throws  SolverError if the loops of the staircase do not leave the same bits, or a scene with its output and its
///         integrator alone: these are not timed in that case
void study_ablation(const AblationOptions& options, const std::function<void(const Sample&)>& sink);

}  // namespace dartboard
