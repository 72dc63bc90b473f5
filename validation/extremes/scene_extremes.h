#pragma once
// Scene files at the extremes of the step: every integrator, with every change of the scene on the way.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "validation/extremes/extremes.h"
#include "validation/scenes/tradeoff_scenes.h"

namespace dartboard {

/// A step of the runs of a scene.
struct SceneStep {
  std::string value;  // "h omega 2.5"
  double h;           // [s]
};
/// The step of the scene, if it has one, and steps from a tenth of the shortest period to a million of them; `quick`
/// takes about half of them.
std::vector<SceneStep> extreme_steps_of(const TradeoffScene& scene, bool quick);

/// One hundred steps of every integrator that the scene can have, for each of these, one after the other. The changes
/// of the scene take place at equal intervals among the steps, whatever their times, so that steps of every length run
/// through all of them.
///
/// A run is judged as one of the matrix, with other bounds for its energy: what gravity, forces, driven vertices and
/// obstacles can supply in its time is added to what it starts with. Where the witnesses do not support a part of the
/// scene, or would take too long, only the energy and the detector's agreement with it are left.
std::vector<ExtremeCase> scene_extreme_cases(const std::shared_ptr<const TradeoffScene>& scene, bool quick);

/// The motion of a scene, its changes at these equal intervals among steps of h [s].
///
/// returns  nothing where references do not support the scene, or there are more changes than steps
std::optional<reference::NetworkMotion> motion_in_steps(const TradeoffScene& scene, double h, std::uint64_t steps);

}  // namespace dartboard
