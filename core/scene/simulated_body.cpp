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

}  // namespace dartboard
