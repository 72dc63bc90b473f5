#include "core/scene/body/simulated_body.h"

#include "core/plain/error.h"
#include "core/scene/body/body_of_columns.h"
#include "core/scene/body/body_on_map.h"

namespace dartboard {

std::unique_ptr<SimulatedBody> make_simulated_body(const Problem& problem, const BodyNeeds& needs) {
  if (!needs.topology_changes) return std::make_unique<BodyOfColumns>(problem, needs);
  switch (needs.storage) {
    case Storage::links: throw InputError("a chain has no cells that could change");
    case Storage::surface: return std::make_unique<BodyOnMap<Map2>>(problem, needs);
    case Storage::tetrahedra: return std::make_unique<BodyOnMap<TetMap>>(problem, needs);
    case Storage::any_cells: break;
  }
  return std::make_unique<BodyOnMap<Map3>>(problem, needs);
}

std::unique_ptr<SimulatedBody> make_simulated_body(const Problem& problem, bool topology_changes) {
  return make_simulated_body(problem, body_needs(problem, topology_changes));
}

}  // namespace dartboard
