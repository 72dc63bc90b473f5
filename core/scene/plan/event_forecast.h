#pragma once
// A forecast of the effect of a scene's events on a body, from their keys and its mesh.

#include <vector>

#include "core/scene/plan/scene_plan.h"

namespace dartboard {

std::vector<EventForecast> forecast_events(const SceneFile& scene, const Mesh& mesh, const MeshTally& counts);

}  // namespace dartboard
