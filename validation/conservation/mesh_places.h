#pragma once
// Places of the corners, edges and sides of a mesh in the map that was built from it.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "core/mechanics/mass_spring_body.h"
#include "validation/conservation/remaining_cells.h"

namespace dartboard {

/// A dart of each corner, edge and side, numbered like those of RemainingCells, and back.
///
/// Darts are never made after the start, so this stays true whatever is taken apart.
struct MeshPlaces {
  std::vector<Dart> corner, edge, side;
  std::vector<std::uint32_t> cell_of, corner_of, side_of;  // by dart
  std::vector<std::vector<Dart>> darts_of;                 // by cell

  MeshPlaces() = default;
  /// pre  the body is as `build_body` made it from `mesh`
  template <class Body>
  MeshPlaces(const Body& body, const Mesh& mesh, const RemainingCells& cells)
      : corner(mesh.nodes.size()), darts_of(mesh.cell_count()) {
    const auto& map = body.map;
    edge.resize(cells.first_edge(static_cast<std::uint32_t>(mesh.cell_count())));
    side.resize(cells.first_side(static_cast<std::uint32_t>(mesh.cell_count())));
    for (auto* column : {&cell_of, &corner_of, &side_of}) column->resize(map.capacity());
    map.for_each_dart([&](Dart d) {
      const std::uint32_t c = body.cell(map, d);
      const auto corner_at = [&](Dart e) {
        const auto nodes = mesh.cell(c);
        const auto found = std::find(nodes.begin(), nodes.end(), body.vertices.point[body.vertex(map, e)]);
        return static_cast<std::uint32_t>(found - nodes.begin());
      };
      const std::uint32_t here = corner_at(d), along = corner_at(map.template alpha<0>(d)),
                          before = corner_at(map.template alpha<1, 0>(d));
      cell_of[d.index] = c;
      darts_of[c].push_back(d);
      corner_of[d.index] = mesh.first[c] + here;
      corner[corner_of[d.index]] = d;
      for (std::uint32_t e = cells.first_edge(c); e < cells.first_edge(c + 1); ++e)
        if (cells.ends(e).a == mesh.first[c] + here && cells.ends(e).b == mesh.first[c] + along) edge[e] = d;
      // three neighbours on a side determine it; two, on the edge of a polygon
      const auto sides = sides_of(mesh.kinds[c]);
      for (std::uint32_t s = 0; s < sides.size(); ++s) {
        const auto has = [&](std::uint32_t k) {
          return std::find(sides[s].begin(), sides[s].end(), static_cast<int>(k)) != sides[s].end();
        };
        if (!has(here) || !has(along) || (Body::dimension == 3 && !has(before))) continue;
        side_of[d.index] = cells.first_side(c) + s;
        side[side_of[d.index]] = d;
      }
    });
  }
};

/// The lowest darts of the body's cells, ascending: the order in which masses are summed.
template <class Body>
std::vector<Dart> cells_by_dart(const Body& body) {
  std::vector<Dart> darts = body.cell_dart;
  std::sort(darts.begin(), darts.end());
  return darts;
}

/// The body's cells, in the order of their darts, as a plain problem at rest whose points are the body's vertices.
///
/// pre  `places` and `cells` are those of `start.mesh`
template <class Body>
Problem rest_problem(const Body& body, const Problem& start, const MeshPlaces& places) {
  Problem problem;
  problem.material = start.material;
  problem.surroundings = start.surroundings;
  problem.h = start.h;
  problem.mesh.points.resize(body.vertices.size());
  std::vector<std::uint32_t> nodes;
  for (const Dart d : cells_by_dart(body)) {
    const std::uint32_t c = places.cell_of[d.index];
    nodes.clear();
    for (std::uint32_t k = start.mesh.first[c]; k < start.mesh.first[c + 1]; ++k) {
      nodes.push_back(body.vertex(body.map, places.corner[k]));
      problem.mesh.points[nodes.back()] = start.mesh.points[start.mesh.nodes[k]];
    }
    problem.mesh.add_cell(start.mesh.kinds[c], nodes);
  }
  for (std::uint32_t k = 0; k < body.vertices.size(); ++k)
    if (body.vertices.fixed[k]) problem.fixed.push_back(k);
  return problem;
}

}  // namespace dartboard
