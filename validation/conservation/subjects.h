#pragma once
// A body under operations, the witness of its expected state, and the correspondence of their places.

#include <array>
#include <span>
#include <vector>

#include "core/mechanics/refine.h"
#include "core/topology/storage/tet_darts.h"
#include "validation/conservation/conservation.h"
#include "validation/conservation/conserved_sums.h"
#include "validation/conservation/mesh_places.h"
#include "validation/conservation/subdivided_cells.h"

namespace dartboard {

/// The body of a problem and its views.
/// pre  the problem outlives it
template <class AnyMap>
struct SubjectBody {
  using Map = AnyMap;

  explicit SubjectBody(const Problem& problem) : start(&problem), body(build_body<Map, Held::by_every_dart>(problem)) {
    body.vertices.keep_rest();
    body.vertices.pull = body.vertices.rest;  // each vertex has another pull
    views.rebuild(body);
  }

  const Problem* start;
  LiveBody<Map> body;
  Views views;
};

/// A body that is taken apart. The witness of a vertex are its corners, that of an edge the coinciding edges of cells.
///
/// Both kinds of subject answer the same questions: which cell, side, vertex and edge of the witness is at a dart, the
/// body's number of each, and the share of one cell in the masses, springs and sides.
template <class AnyMap>
struct Subject : SubjectBody<AnyMap> {
  using Side = std::uint32_t;
  using VertexPlace = std::span<const std::uint32_t>;
  using EdgePlace = std::span<const std::uint32_t>;

  explicit Subject(const Problem& problem)
      : SubjectBody<AnyMap>(problem), cells(problem.mesh), places(this->body, problem.mesh, cells) {}

  std::uint32_t cell(Dart d) const { return places.cell_of[d.index]; }
  Side side(Dart d) const { return places.side_of[d.index]; }
  VertexPlace vertex_at(Dart d) const { return cells.vertex(places.corner_of[d.index]); }
  EdgePlace edge_at(Dart d) const {
    const std::uint32_t c = cell(d), here = places.corner_of[d.index],
                        along = places.corner_of[this->body.map.template alpha<0>(d).index];
    for (std::uint32_t e = cells.first_edge(c); e < cells.first_edge(c + 1); ++e)
      if (const auto [a, b] = cells.ends(e); (a == here && b == along) || (a == along && b == here))
        return cells.edge(e);
    return {};
  }
  std::uint32_t vertex(std::uint32_t corner) const { return this->body.vertex(this->body.map, places.corner[corner]); }
  std::uint32_t edge(std::uint32_t edge) const { return this->body.edge(this->body.map, places.edge[edge]); }
  const std::vector<Dart>& darts_of(std::uint32_t c) const { return places.darts_of[c]; }
  Side opposite(Side side) const { return cells.opposite(side); }
  double measure(Side side) const { return cells.measure(side); }

  /// Calls f(number in the body, place) for each vertex and edge of the witness; f(cell) for each cell that is there.
  template <class F>
  void for_each_vertex(F&& f) const {
    cells.for_each_vertex([&](std::uint32_t corner, VertexPlace corners) { f(vertex(corner), corners); });
  }
  template <class F>
  void for_each_edge(F&& f) const {
    cells.for_each_edge([&](std::uint32_t first, EdgePlace edges) { f(edge(first), edges); });
  }
  template <class F>
  void for_each_cell(F&& f) const {
    for (std::uint32_t c = 0; c < start_mesh().cell_count(); ++c)
      if (cells.is_there(c)) f(c);
  }

  /// For one cell: f(mass, vertex), f(stiffness, damping, spring, its vertices a, b), f(side).
  template <class F>
  void for_each_corner_of(std::uint32_t c, F&& f) const {
    const std::uint32_t first = start_mesh().first[c];
    const double share = this->body.node_share[this->body.cell(this->body.map, places.corner[first])];
    for (std::uint32_t k = first; k < start_mesh().first[c + 1]; ++k) f(share, vertex(k));
  }
  template <class F>
  void for_each_edge_of(std::uint32_t c, F&& f) const {
    const Material& material = this->start->material;
    for (std::uint32_t e = cells.first_edge(c); e < cells.first_edge(c + 1); ++e)
      f(material.stiffness, material.damping, edge(e), vertex(cells.ends(e).a), vertex(cells.ends(e).b));
  }
  template <class F>
  void for_each_side_of(std::uint32_t c, F&& f) const {
    for (std::uint32_t side = cells.first_side(c); side < cells.first_side(c + 1); ++side) f(side);
  }

  RemainingCells cells;
  MeshPlaces places;

 private:
  const Mesh& start_mesh() const { return this->start->mesh; }
};

/// A body of tetrahedra that is refined and taken apart.
template <class AnyMap>
struct RefinedSubject : SubjectBody<AnyMap> {
  using Corner = SubdividedCells::Corner;
  using Side = Corner;
  using VertexPlace = Corner;                     // one of its corners
  using EdgePlace = SubdividedCells::EdgeOfCell;  // one of the coinciding edges of cells

  explicit RefinedSubject(const Problem& problem)
      : SubjectBody<AnyMap>(problem),
        cells(problem.mesh, problem.material.density),
        darts_of_(problem.mesh.cell_count()) {
    const LiveBody<AnyMap>& b = this->body;
    b.map.for_each_dart([&](Dart d) {
      const std::uint32_t c = b.cell(b.map, d), point = b.vertices.point[b.vertex(b.map, d)];
      std::uint32_t node = 0;
      while (cells.cells()[c].points[node] != point) ++node;
      put(d, {c, node});
    });
  }

  Corner corner(Dart d) const { return corner_of_[d.index]; }
  /// The nodes of the edge, face or volume at a dart.
  template <int i>
  std::uint8_t nodes(Dart d) const {
    if constexpr (i == 3) return 15;
    unsigned nodes = 1u << corner(d).node | 1u << corner(this->body.map.template alpha<0>(d)).node;
    if constexpr (i == 2) nodes |= 1u << corner(this->body.map.template alpha<1, 0>(d)).node;
    return static_cast<std::uint8_t>(nodes);
  }
  std::uint32_t cell(Dart d) const { return corner(d).cell; }
  Side side(Dart d) const {
    std::uint32_t n = 0;
    while ((nodes<2>(d) >> n & 1u) != 0) ++n;
    return {corner(d).cell, n};
  }
  VertexPlace vertex_at(Dart d) const { return corner(d); }
  EdgePlace edge_at(Dart d) const {
    const Corner here = corner(d), along = corner(this->body.map.template alpha<0>(d));
    return {here.cell, SubdividedCells::edge_between(here.node, along.node)};
  }
  std::uint32_t vertex(Corner c) const {
    for (const Dart d : darts_of(c.cell))
      if (corner(d).node == c.node) return this->body.vertex(this->body.map, d);
    return no_embedding;
  }
  std::uint32_t edge(EdgePlace e) const {
    const auto [a, b] = SubdividedCells::ends[e.edge];
    for (const Dart d : darts_of(e.cell))
      if (corner(d).node == a && corner(this->body.map.template alpha<0>(d)).node == b)
        return this->body.edge(this->body.map, d);
    return no_embedding;
  }
  const std::vector<Dart>& darts_of(std::uint32_t c) const { return darts_of_[c]; }
  Side opposite(Side side) const { return cells.cells()[side.cell].across[side.node]; }
  double measure(Side side) const { return cells.cells()[side.cell].side_area[side.node]; }

  template <class F>
  void for_each_vertex(F&& f) const {
    cells.for_each_vertex([&](auto corners) {
      const Corner first{corners[0].cell, corners[0].edge};
      f(vertex(first), first);
    });
  }
  template <class F>
  void for_each_edge(F&& f) const {
    cells.for_each_edge([&](auto edges) { f(edge(edges[0]), edges[0]); });
  }
  template <class F>
  void for_each_cell(F&& f) const {
    for (std::uint32_t c = 0; c < cells.cells().size(); ++c)
      if (cells.cells()[c].is_there) f(c);
  }

  template <class F>
  void for_each_corner_of(std::uint32_t c, F&& f) const {
    for (std::uint32_t n = 0; n < 4; ++n) f(cells.cells()[c].mass / 4.0, vertex({c, n}));
  }
  template <class F>
  void for_each_edge_of(std::uint32_t c, F&& f) const {
    const Material& material = this->start->material;
    for (std::uint32_t e = 0; e < 6; ++e) {
      const auto [a, b] = SubdividedCells::ends[e];
      const double share = cells.cells()[c].share[e];
      f(material.stiffness * share, material.damping * share, edge({c, e}), vertex({c, a}), vertex({c, b}));
    }
  }
  template <class F>
  void for_each_side_of(std::uint32_t c, F&& f) const {
    for (std::uint32_t n = 0; n < 4; ++n) f(Side{c, n});
  }

  /// Follow a subdivision: `children` are the witness's.
  void put_children(const Subdivision& subdivision, std::span<const SubdividedCells::Child> children) {
    darts_of_.resize(cells.cells().size());
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

  SubdividedCells cells;

 private:
  void put(Dart d, Corner c) {
    if (corner_of_.size() <= d.index) corner_of_.resize(d.index + 1);
    corner_of_[d.index] = c;
    darts_of_[c.cell].push_back(d);
  }

  std::vector<Corner> corner_of_;            // by dart
  std::vector<std::vector<Dart>> darts_of_;  // by cell of the witness
};

}  // namespace dartboard
