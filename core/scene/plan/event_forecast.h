#pragma once
// What the events of a scene will do to a body, as far as their keys and its mesh say.

#include <vector>

#include "core/scene/plan/scene_plan.h"

namespace dartboard {

std::vector<EventForecast> forecast_events(const SceneFile& scene, const Mesh& mesh, const MeshTally& counts);

/// Removals at random leave an edge where some of its cells are left, and one more for each gap between them; what that
/// comes to on average follows from how many cells an edge has. Other removals take cells with their share of the rest.
MeanSizes mean_sizes(const SceneFile& scene, const Mesh& mesh, const MeshTally& counts);

}  // namespace dartboard
