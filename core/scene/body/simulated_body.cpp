#include "core/scene/body/simulated_body.h"

#include <utility>

#include "core/mechanics/curve_order.h"
#include "core/plain/error.h"
#include "core/scene/body/body_of_columns.h"
#include "core/scene/body/body_of_parts.h"
#include "core/scene/body/body_on_map.h"
#include "core/topology/storage/hash.h"

namespace dartboard {
namespace {

/// `mesh_cell` are the numbers of the problem's cells in the mesh of the scene; empty where they are the same.
std::unique_ptr<SimulatedBody> make_body(const Problem& problem, const BodyNeeds& needs,
                                         std::vector<std::uint32_t> mesh_cell) {
  if (!needs.topology_changes) return std::make_unique<BodyOfColumns>(problem, needs, std::move(mesh_cell));
  switch (needs.storage) {
    case Storage::links: throw InputError("a chain has no cells that could change");
    case Storage::surface: return std::make_unique<BodyOnMap<Map2>>(problem, needs, std::move(mesh_cell));
    case Storage::tetrahedra: return std::make_unique<BodyOnMap<TetMap>>(problem, needs, std::move(mesh_cell));
    case Storage::several:
    case Storage::any_cells: break;
  }
  return std::make_unique<BodyOnMap<Map3>>(problem, needs, std::move(mesh_cell));
}

/// The body with its cells in the order in which they are stored.
std::unique_ptr<SimulatedBody> make_ordered_body(const Problem& problem, const BodyNeeds& needs,
                                                 std::vector<std::uint32_t> mesh_cell) {
  if (std::vector<std::uint32_t> order = order_along_curve(problem.mesh); !order.empty()) {
    try {
      const Problem ordered = in_order(problem, order);
      if (!mesh_cell.empty())
        for (std::uint32_t& cell : order) cell = mesh_cell[cell];
      return make_body(ordered, needs, std::move(order));
    } catch (const InputError&) {  // names a cell by its number there; the mesh in its own order is refused below
    }
  }
  return make_body(problem, needs, std::move(mesh_cell));
}

}  // namespace

std::uint64_t SimulatedBody::state_hash() const {
  Hash h;
  h.add(vertices().position);
  h.add(vertices().velocity);
  return h.value();
}

std::vector<std::array<Eigen::Vector3d, 2>> SimulatedBody::attachments() const {
  std::vector<std::array<Eigen::Vector3d, 2>> all;
  forces_.for_each([&](const BodyForce& force) {
    const auto some = force.attachments(vertices().position);
    all.insert(all.end(), some.begin(), some.end());
  });
  return all;
}

SpringSystem system_of(const VertexColumns& vertices, std::span<const SpringEnds> ends, SpringSpan springs,
                       const Eigen::Vector3d& gravity, ForceTerms terms) {
  return {.ends = ends,
          .springs = springs,
          .mass = vertices.mass,
          .inverse_mass = vertices.inverse_mass,
          .viscosity = vertices.viscosity,
          .fixed = vertices.fixed,
          .gravity = gravity,
          .pull = vertices.pull,
          .terms = terms,
          .held_axes = vertices.held_axes};
}

std::unique_ptr<SimulatedBody> make_simulated_body(const Problem& problem, const BodyNeeds& needs) {
  if (needs.storage == Storage::several) return std::make_unique<BodyOfParts>(problem, needs, make_ordered_body);
  return make_ordered_body(problem, needs, {});
}

std::unique_ptr<SimulatedBody> make_simulated_body(const Problem& problem, bool topology_changes) {
  return make_simulated_body(problem, body_needs(problem, topology_changes));
}

}  // namespace dartboard
