#pragma once
// A forecast of the effect of a scene's events on a body, from their keys and its mesh.

#include <vector>

#include "core/scene/plan/scene_plan.h"

namespace dartboard {

std::vector<EventForecast> forecast_events(const SceneFile& scene, const Mesh& mesh, const MeshTally& counts);

/// Random removals keep an edge while some of its cells are left, and add one for each gap between them; the average
/// follows from the number of cells of an edge. Other removals take cells with their share of the other parts.
MeanSizes mean_sizes(const SceneFile& scene, const Mesh& mesh, const MeshTally& counts);

}  // namespace dartboard
