#pragma once
// The corners of an element in the order of its rest shape, read off the darts.

#include <algorithm>
#include <array>
#include <cstdint>

#include "core/mechanics/cell_nodes.h"
#include "core/mechanics/mass_spring_body.h"

namespace dartboard {

/// A dart at each corner of the tetrahedron of d: at its own vertex, then along its edge, its face and its volume. From
/// the lowest dart of a cell, which no operation changes as long as the cell lives, this order is permanent.
template <class Map>
std::array<Dart, 4> corners_from(const Map& map, Dart d) {
  return {d, map.template alpha<0>(d), map.template alpha<1, 0>(d), map.template alpha<2, 1, 0>(d)};
}

/// The corners of cell c: of a tetrahedron, as above; of a cell of any kind, right-handed as a mesh has them.
template <class Map>
void find_nodes(const MassSpringBody<Map, Held::by_every_dart>& body, std::uint32_t c, TetrahedronNodes& nodes) {
  const auto corners = corners_from(body.map, body.cell_dart[c]);
  for (std::size_t k = 0; k < 4; ++k) nodes[k] = body.vertex(body.map, corners[k]);
}
template <class Map>
void find_nodes(const MassSpringBody<Map, Held::by_every_dart>& body, std::uint32_t c, SolidNodes& nodes) {
  Mesh cell;
  add_cell_of(body, c, cell);
  nodes.count = static_cast<std::uint32_t>(cell.nodes.size());
  nodes.at = {};
  std::ranges::copy(cell.nodes, nodes.at.begin());
}
/// The corners of a triangle: round it from its lowest dart.
template <class Map>
void find_nodes(const MassSpringBody<Map, Held::by_every_dart>& body, std::uint32_t c, TriangleNodes& nodes) {
  Dart at = body.cell_dart[c];
  for (std::uint32_t& node : nodes) {
    node = body.vertex(body.map, at);
    at = body.map.template alpha<0, 1>(at);
  }
}

/// The number of elements of this kind in a body: one per cell, or 0. Springs within cells use the corners of solids,
/// and so do surfaces of triangles and quadrilaterals.
template <class Map>
std::size_t element_count(const MassSpringBody<Map, Held::by_every_dart>& body, const TetrahedronNodes&) {
  return shapes_of<RestShape>(body.elements).size();
}
template <class Map>
std::size_t element_count(const MassSpringBody<Map, Held::by_every_dart>& body, const SolidNodes&) {
  return std::max({shapes_of<SolidShape>(body.elements).size(), shapes_of<MembraneShape>(body.elements).size(),
                   body.cell_springs.size()});
}
template <class Map>
std::size_t element_count(const MassSpringBody<Map, Held::by_every_dart>& body, const TriangleNodes&) {
  return shapes_of<PlaneInverse>(body.elements).size();
}

}  // namespace dartboard
