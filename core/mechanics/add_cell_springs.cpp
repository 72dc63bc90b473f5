#include "core/mechanics/add_cell_springs.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/mechanics/element_nodes.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

template <class Map>
using Body = MassSpringBody<Map, Held::by_every_dart>;

bool has_diagonals(const CellMaterials& materials, const Mesh& mesh, std::size_t c, Diagonals which) {
  return materials[c].model == Model::springs && !diagonals_of(mesh.kinds[c], which).empty();
}

/// The weight of the edge from vertex i to vertex j of a cell whose corners have these numbers.
double weight_of_edge(CellKind kind, Diagonals which, const SolidNodes& nodes, std::uint32_t i, std::uint32_t j) {
  for (const CornerSpring& edge : edges_beside(kind, which)) {
    const std::uint32_t a = nodes.at[static_cast<std::size_t>(edge.a)], b = nodes.at[static_cast<std::size_t>(edge.b)];
    if ((a == i && b == j) || (a == j && b == i)) return edge.weight;
  }
  return 1.0;
}

void require_numbers(const CellSprings& springs, std::size_t c) {
  const std::size_t count = diagonals_of(springs.kind, springs.which).size();
  for (std::size_t k = 0; k < count; ++k) {
    const double length = springs.rest_length[k];
    if (!std::isfinite(length) ||
        (springs.elastic && !(length > 0.0 && std::isfinite(springs.modulus / length / length))))
      throw InputError(fmt::format("a diagonal of cell {}, a {}, is {} m long", c, name(springs.kind), length));
  }
}

}  // namespace

template <class Map>
void add_cell_springs(Body<Map>& body, const Mesh& mesh, Diagonals which) {
  const CellMaterials materials = body.cell_materials();
  bool some = false, elastic = false;
  for (std::size_t c = 0; c < mesh.cell_count(); ++c)
    if (has_diagonals(materials, mesh, c, which)) {
      some = true;
      elastic = elastic || materials[c].young > 0.0;
    }
  if (!some) return;

  std::vector<SolidNodes> nodes(mesh.cell_count());
  for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
    find_nodes(body, c, nodes[c]);
    body.cell_springs.emplace_back();
    if (!has_diagonals(materials, mesh, c, which)) continue;
    const Material& material = materials[c];
    std::vector<Eigen::Vector3d> x;
    for (std::size_t k = 0; k < nodes[c].count; ++k) x.push_back(body.vertices.position[nodes[c].at[k]]);
    const bool of_young = material.young > 0.0;
    body.cell_springs.back() =
        cell_springs_of(mesh.kinds[c], which, of_young,
                        of_young ? material.young * std::abs(signed_measure(mesh, c)) : material.stiffness, x);
    require_numbers(body.cell_springs.back(), c);
  }
  if (!elastic) return;

  // tetrahedra have no diagonals, so that each dart has a share of its own here
  const Map& map = body.map;
  map.for_each_dart([&](Dart d) {
    const std::uint32_t c = body.cell(map, d);
    if (!body.cell_springs[c].elastic) return;
    const Dart other = map.template alpha<0>(d);
    body.edge_share[Map::template slot<1>(d)] *=
        weight_of_edge(mesh.kinds[c], which, nodes[c], body.vertex(map, d), body.vertex(map, other));
  });
  for (std::uint32_t k = 0; k < body.springs.size(); ++k)
    body.springs.set(k, body.spring_of(Edge{body.edge_dart[k]}, body.springs[k].rest_length));
}

template void add_cell_springs(Body<Map2>&, const Mesh&, Diagonals);
template void add_cell_springs(Body<Map3>&, const Mesh&, Diagonals);
template void add_cell_springs(Body<TetMap>&, const Mesh&, Diagonals);

}  // namespace dartboard
