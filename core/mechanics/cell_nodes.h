#pragma once
// The nodes of a cell in the order of a mesh, read off the darts.

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <vector>

#include "core/mechanics/mass_spring_body.h"
#include "core/plain/error.h"
#include "core/plain/mesh.h"

namespace dartboard {

namespace detail {

/// A dart of a volume and whether an odd number of involutions leads to it.
struct SidedDart {
  Dart dart;
  bool odd;
};

/// The darts of the volume of `first`, breadth first, each with its side.
template <class Map>
std::vector<SidedDart> sided_darts(const Map& map, Dart first) {
  std::vector<SidedDart> found{{first, false}};
  Mark met(map);
  met.set(first);
  for (std::size_t k = 0; k < found.size(); ++k)
    for (const Dart next : {map.template alpha<0>(found[k].dart), map.template alpha<1>(found[k].dart),
                            map.template alpha<2>(found[k].dart)})
      if (met.set_if_new(next)) found.push_back({next, !found[k].odd});
  return found;
}

/// The darts met from d along alpha_0 alpha_1, one at each node of its face.
template <class Map>
std::vector<Dart> around_face(const Map& map, Dart d) {
  std::vector<Dart> darts;
  Dart at = d;
  do {
    darts.push_back(at);
    at = map.template alpha<0, 1>(at);
  } while (at != d);
  return darts;
}

/// How many darts that would be.
template <class Map>
std::size_t face_size(const Map& map, Dart d) {
  std::size_t size = 0;
  Dart at = d;
  do {
    ++size;
    at = map.template alpha<0, 1>(at);
  } while (at != d);
  return size;
}

}  // namespace detail

/// Add cell k of a body to a mesh whose points are the vertices of the body by number; right-handed at rest.
///
/// The kind is inferred from the sizes of the faces; the walk starts on a face of three nodes for a prism and of four
/// for a pyramid.
/// throws  InputError for a polyhedron that is not one of the kinds of cell
template <class Map, Held held>
void add_cell_of(const MassSpringBody<Map, held>& body, std::uint32_t k, Mesh& mesh) {
  const Map& map = body.map;
  if constexpr (Map::dimension == 3 && Map::tetrahedral) {
    // of darts in turn even and odd, the first that starts a clockwise walk seen from outside, as below
    const Dart lowest = body.cell_dart[k];
    const Dart start = body.cell_inside_out[k] == 0 ? map.template alpha<0>(lowest) : lowest;
    const std::array darts{start, map.template alpha<0, 1>(start), map.template alpha<0, 1, 0, 1>(start),
                           map.template alpha<2, 1, 0>(start)};
    std::array<std::uint32_t, 4> corners;
    for (std::size_t a = 0; a < 4; ++a) corners[a] = body.vertex(map, darts[a]);
    return mesh.add_cell(CellKind::tetrahedron, corners);
  }
  std::vector<std::uint32_t> nodes;
  const auto add_node = [&](Dart d) { nodes.push_back(body.vertex(map, d)); };
  const auto fail = [&](std::size_t faces) {
    throw InputError(fmt::format(
        "cell {} has {} nodes and {} faces, expected a polygon or polyhedron of at most 8 nodes that meshes "
        "know",
        k, nodes.size(), faces));
  };

  if constexpr (Map::dimension == 2) {
    for (const Dart d : detail::around_face(map, body.cell_dart[k])) add_node(d);
    if (nodes.size() != 3 && nodes.size() != 4) fail(1);
    mesh.add_cell(nodes.size() == 3 ? CellKind::triangle : CellKind::quadrilateral, nodes);
  } else {
    const auto darts = detail::sided_darts(map, body.cell_dart[k]);
    // a dart at each face with three nodes, and at each with four, in both ways round
    std::array<std::vector<detail::SidedDart>, 2> on_face;
    for (const auto& at : darts) {
      const std::size_t size = detail::face_size(map, at.dart);
      if (size != 3 && size != 4) fail(0);
      on_face[size - 3].push_back(at);
    }
    const std::size_t triangles = on_face[0].size() / 6, quadrilaterals = on_face[1].size() / 8;
    CellKind kind = CellKind::tetrahedron;
    if (triangles == 4 && quadrilaterals == 0)
      kind = CellKind::tetrahedron;
    else if (triangles == 4 && quadrilaterals == 1)
      kind = CellKind::pyramid;
    else if (triangles == 2 && quadrilaterals == 3)
      kind = CellKind::prism;
    else if (triangles == 0 && quadrilaterals == 6)
      kind = CellKind::hexahedron;
    else
      fail(triangles + quadrilaterals);

    // A right-handed cell is listed with its first face clockwise seen from outside. `cell_inside_out` gives the
    // direction of the walk from the even darts.
    const bool start_odd = body.cell_inside_out[k] == 0;
    Dart start = no_dart;
    for (const auto& at : on_face[kind == CellKind::tetrahedron || kind == CellKind::prism ? 0 : 1])
      if (start == no_dart && at.odd == start_odd) start = at.dart;
    const auto bottom = detail::around_face(map, start);
    for (const Dart d : bottom) add_node(d);
    if (kind == CellKind::tetrahedron || kind == CellKind::pyramid)
      add_node(map.template alpha<2, 1, 0>(start));  // up the edge that leaves the first face: to the tip
    else
      for (const Dart d : bottom) add_node(map.template alpha<2, 1, 0>(d));
    mesh.add_cell(kind, nodes);
  }
}

}  // namespace dartboard
