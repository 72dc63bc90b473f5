#pragma once
// The features of a scene and of this machine that the choice of an integrator depends on.

#include <cstddef>
#include <map>
#include <string>
#include <vector>

#include "core/time/method/step_limit.h"
#include "validation/scenes/scene_stage.h"

namespace dartboard {

/// The number of pieces of each force other than springs, by name: 180 tetrahedra.
using PieceCounts = std::map<std::string, std::size_t>;
PieceCounts pieces_of(const SpringSystem& system);
/// "84 vertices, 180 tetrahedra": springs are named where there are some, or where there is nothing else.
std::string sizes_in_words(std::size_t vertices, std::size_t springs, const PieceCounts& pieces);

/// The features that a choice depends on.
struct SceneFeatures {
  std::size_t vertices = 0, springs = 0, events = 0;
  PieceCounts pieces{};
  double omega_low = 0.0, omega_high = 0.0;  // [1/s] omega_max: power iteration, and Gershgorin's bound; over all times
  double damping_ratio = 0.0;                // at omega_max, the largest of all springs
  double phase = 0.0;                        // duration times omega_max
  double motion_rate = 0.0;                  // [1/s] of the motion: accelerations over velocities at the start
  double motion_size = 0.0;                  // [edges] velocities over that rate
  double force_s = 0.0;                      // seconds of a force evaluation here
  double implicit_step_s = 0.0;              // seconds of a linearly implicit step here, with a kept factor
  std::vector<StableStep> limits{};          // of the step: at the start, and there after events (about 16 of many)
};

/// All features but `implicit_step_s`, which needs a factorisation. The forces are timed three times, `timing_ns` each.
SceneFeatures features_of(const TradeoffScene& scene, const CpuClock& clock, std::int64_t timing_ns = 1'000'000);

/// The time of a linearly implicit step of h [s]: the smaller of the second and third of three steps, of which the
/// first finds a factor; infinite when they fail.
double implicit_step_seconds(const TradeoffScene& scene, double h, const CpuClock& clock);

/// The longest stable step [s] of a method for a scene: the least of StableStep::limit at the start, and there after
/// events, for a run of that duration. A simulation of the scene uses the same number.
double stability_limit(const Scheme& scheme, const SceneFeatures& features, double duration);

}  // namespace dartboard
