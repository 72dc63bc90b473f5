#include "core/scene/simulated_body.h"

#include <algorithm>

#include "core/scene/body_of_columns.h"
#include "core/scene/body_on_map.h"

namespace dartboard {

std::unique_ptr<SimulatedBody> make_simulated_body(const Problem& problem, bool topology_changes) {
  if (!topology_changes) return std::make_unique<BodyOfColumns>(problem);
  const auto& kinds = problem.mesh.kinds;
  if (problem.mesh.dimension() == 2) return std::make_unique<BodyOnMap<Map2>>(problem);
  if (std::all_of(kinds.begin(), kinds.end(), [](CellKind kind) { return kind == CellKind::tetrahedron; }))
    return std::make_unique<BodyOnMap<TetMap>>(problem);
  return std::make_unique<BodyOnMap<Map3>>(problem);
}

std::unique_ptr<SimulatedBody> make_simulated_body(const SceneFile& scene, const Problem& problem) {
  if (!scene.is_chain()) return make_simulated_body(problem, !scene.events.empty());
  std::vector<SpringEnds> links;
  for (std::uint32_t k = 0; k + 1 < problem.mesh.points.size(); ++k) links.push_back({k, k + 1});
  return std::make_unique<BodyOfColumns>(problem, links);
}

}  // namespace dartboard
