#include "core/scene/body/needs.h"

#include <algorithm>

#include "core/scene/file/force_kind.h"
#include "core/time/integrators.h"

namespace dartboard {

Storage storage_of(const Mesh& mesh) {
  if (is_mixed(mesh)) return Storage::several;
  if (!mesh.links.empty()) return Storage::links;
  if (mesh.dimension() == 2) return Storage::surface;
  return std::ranges::all_of(mesh.kinds, [](CellKind kind) { return kind == CellKind::tetrahedron; })
             ? Storage::tetrahedra
             : Storage::any_cells;
}

std::string_view map_name(Storage storage) {
  switch (storage) {
    case Storage::links: return "no map";
    case Storage::surface: return "2-g-map";
    case Storage::tetrahedra: return "tetrahedral 3-g-map";
    case Storage::several: return "a map for each dimension";
    case Storage::any_cells: break;
  }
  return "3-g-map";
}

BodyNeeds body_needs(const Problem& problem, bool topology_changes) {
  return {.storage = storage_of(problem.mesh),
          .topology_changes = topology_changes,
          .viscosity = problem.material.viscosity != 0.0,
          .fixed = !problem.fixed.empty()};
}

namespace {

/// By body: 1 if all of its points are fixed.
std::vector<std::uint8_t> bodies_held_still(const Problem& problem) {
  const std::vector<std::size_t>& first = problem.bodies.cell;
  std::vector<std::uint8_t> still(problem.bodies.count(), 1);
  for (std::size_t body = 0; body < still.size(); ++body)
    for (std::size_t c = first[body]; c < first[body + 1]; ++c)
      for (const std::uint32_t point : problem.mesh.cell(c))
        if (!std::ranges::binary_search(problem.fixed, point)) still[body] = 0;
  return still;
}

}  // namespace

Needs needs_of(const SceneFile& scene, const Problem& problem) {
  BodyNeeds body = body_needs(problem, std::ranges::any_of(scene.events, changes_topology, &SceneEvent::action));
  body.diagonals = scene.diagonals;
  body.pull = !std::ranges::all_of(scene.forces, &SceneForce::follows);
  for (std::size_t k = 0; k < force_kinds().size(); ++k)
    if (std::optional<ForceNeed> need = force_kinds()[k].need(scene, problem)) {
      need->kind = k;
      body.forces.push_back(std::move(*need));
    }
  body.obstacles = scene.obstacles;
  for (const SceneTouch& touch : scene.touches) body.touches.push_back({touch.first, touch.second, touch.law});
  // a change of the map is followed by rest positions
  body.rest = scene.output.fields.displacement || (body.topology_changes && body.rest_of_forces());
  if (!body.touches.empty()) {
    body.first_cell = problem.bodies.cell;
    if (scene.driven.empty() && !has<Release>(scene.events)) body.still = bodies_held_still(problem);
  }
  return {.body = body,
          .damping =
              std::ranges::any_of(problem.cell_materials().all(), [](const Material& m) { return m.damping != 0.0; }),
          .gravity = !problem.surroundings.gravity.isZero(0.0),
          .cell_damping = std::ranges::any_of(problem.cell_materials().all(),
                                              [](const Material& m) { return m.damping_time != 0.0; }),
          .solver = scheme_of(scene.integrator).implicit,
          .refinement = has<Refine>(scene.events),
          .stress_watch = has<TearWhereStressed>(scene.events)};
}

}  // namespace dartboard
