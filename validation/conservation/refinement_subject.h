#pragma once
// A body that is refined and taken apart, and the witness of what it should be.

#include <array>
#include <vector>

#include "core/mechanics/refine.h"
#include "core/topology/storage/tet_darts.h"
#include "validation/conservation/conservation.h"
#include "validation/conservation/conserved_sums.h"
#include "validation/conservation/subdivided_cells.h"

namespace dartboard {

/// The body, the witness, and which dart is where in it.
template <class Map>
struct RefinedSubject {
  using Corner = SubdividedCells::Corner;

  explicit RefinedSubject(const Problem& problem)
      : start_(&problem),
        body(build_body<Map, Held::by_every_dart>(problem)),
        cells(problem.mesh, problem.material.density),
        darts_of(problem.mesh.cell_count()) {
    body.map.for_each_dart([this](Dart d) {
      const std::uint32_t c = body.cell(body.map, d), point = body.vertices.point[body.vertex(body.map, d)];
      std::uint32_t node = 0;
      while (cells.cells()[c].points[node] != point) ++node;
      put(d, {c, node});
    });
    body.vertices.keep_rest();
    body.vertices.pull = body.vertices.rest;  // of each vertex another
    views.rebuild(body);
  }

  /// The corner at a dart, the nodes of its edge or face, and the side it lies on.
  Corner corner(Dart d) const { return corner_of[d.index]; }
  template <int i>
  std::uint8_t nodes(Dart d) const {
    if constexpr (i == 3) return 15;
    unsigned nodes = 1u << corner(d).node | 1u << corner(body.map.template alpha<0>(d)).node;
    if constexpr (i == 2) nodes |= 1u << corner(body.map.template alpha<1, 0>(d)).node;
    return static_cast<std::uint8_t>(nodes);
  }
  Corner side(Dart d) const {
    std::uint32_t n = 0;
    while ((nodes<2>(d) >> n & 1u) != 0) ++n;
    return {corner(d).cell, n};
  }
  /// The number that the body gives to a corner or an edge of a cell.
  std::uint32_t vertex(Corner c) const {
    for (const Dart d : darts_of[c.cell])
      if (corner(d).node == c.node) return body.vertex(body.map, d);
    return no_embedding;
  }
  std::uint32_t edge(SubdividedCells::EdgeOfCell e) const {
    const auto [a, b] = SubdividedCells::ends[e.edge];
    for (const Dart d : darts_of[e.cell])
      if (corner(d).node == a && corner(body.map.template alpha<0>(d)).node == b) return body.edge(body.map, d);
    return no_embedding;
  }
  std::uint32_t cell_number(std::uint32_t c) const { return body.cell(body.map, darts_of[c].front()); }

  /// Follow a subdivision: `children` are the witness's.
  void put_children(const Subdivision& subdivision, std::span<const SubdividedCells::Child> children) {
    darts_of.resize(cells.cells().size());
    for (const auto& child : subdivision.children) {
      const auto& parent = subdivision.parents[child.parent].darts;
      std::size_t p = 0;
      while (tet_darts.node[p] != child.replaced) ++p;
      const Corner replaced = corner(parent[p]);
      for (const auto& c : children)
        if (c.parent == replaced.cell && c.replaced == replaced.node)
          for (p = 0; p < 24; ++p) put(child.darts[p], {c.cell, corner(parent[p]).node});
    }
  }

  const Problem& start() const { return *start_; }

 private:
  const Problem* start_;

 public:
  LiveBody<Map> body;
  Views views;
  SubdividedCells cells;
  std::vector<Corner> corner_of;            // by dart
  std::vector<std::vector<Dart>> darts_of;  // by cell of the witness

 private:
  void put(Dart d, Corner c) {
    if (corner_of.size() <= d.index) corner_of.resize(d.index + 1);
    corner_of[d.index] = c;
    darts_of[c.cell].push_back(d);
  }
};

}  // namespace dartboard
