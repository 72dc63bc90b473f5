#pragma once
// The expected remainder of tetrahedra that were subdivided, came apart and were removed: a witness that knows no dart.

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/plain/mesh.h"

namespace dartboard {

/// Tetrahedra with points at rest, masses, and the contribution of each to its edges; and the sides by which they are
/// joined. Side n of a cell is opposite its corner n; edges of a cell are 01 02 03 12 13 23.
///
/// The rule of refinement, restated. A vertex w is put in the middle of a set S of s corners, and each cell P around S
/// becomes the s cells (P without n, with w), n in S. Each has the mass of P over s. The contribution of P to
///
///     an edge ab of P                    is shared by the children that have it, those for n in S without a and b;
///     an edge that S is                  makes two halves, twice as stiff each;
///     an edge from w to any other node   is `bracing`, shared by the children that have it.
///
/// Masses and contributions are computed by the same divisions as core's, and must have the same bits. Rest lengths are
/// not: here they are distances between points, and each cell keeps a bound on the error of the squared length that
/// core derives from other lengths; cells around an edge keep the same.
class SubdividedCells {
 public:
  struct Corner {
    std::uint32_t cell, node;
    friend bool operator==(const Corner&, const Corner&) = default;
  };
  struct EdgeOfCell {
    std::uint32_t cell, edge;
    friend bool operator==(const EdgeOfCell&, const EdgeOfCell&) = default;
  };
  struct Tetrahedron {
    std::array<std::uint32_t, 4> points;
    std::array<Corner, 4> across;  // by side: the cell joined there and its side; this side itself if nothing is joined
    double mass;
    std::array<double, 6> share;         // contributed to an edge, over the material's stiffness
    std::array<double, 6> square_error;  // error bound of core's square of the rest length [m^2]
    std::array<double, 4> side_area;     // [m^2] an equal part of the original side
    bool is_there;
    std::uint32_t depth;  // number of refinements that led to it
  };
  struct Point {
    Eigen::Vector3d rest;
    double error;  // bound on the error of a coordinate [m]
  };
  struct Child {
    std::uint32_t parent, replaced, cell;  // `replaced`: the node of the parent whose place the vertex took
  };

  /// pre  cells are tetrahedra
  SubdividedCells(const Mesh& mesh, double density);

  void dissociate(Corner side);
  void remove(std::uint32_t cell);
  /// All cells that hold together around these nodes of the cell (2, 3 or all 4; bit n: node n) become several.
  std::vector<Child> subdivide(std::uint32_t cell, std::uint8_t nodes, double bracing);

  static constexpr std::array<std::array<std::uint32_t, 2>, 6> ends{{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
  static std::uint32_t edge_between(std::uint32_t a, std::uint32_t b);

  const std::vector<Tetrahedron>& cells() const { return cells_; }
  const std::vector<Point>& points() const { return points_; }
  std::size_t count() const { return count_; }
  bool is_joined(Corner side) const { return !(cells_[side.cell].across[side.node] == side); }
  /// The cells around these nodes of the cell, that one first, with the same nodes there.
  std::vector<std::pair<std::uint32_t, std::uint8_t>> around(std::uint32_t cell, std::uint8_t nodes) const;
  /// The rest length computed from the points, and a bound on the error of core's.
  std::pair<double, double> rest_length(EdgeOfCell edge) const;
  /// The volume [m^3] computed from the points, and a bound on its rounding error.
  std::pair<double, double> volume(std::uint32_t cell) const;

  /// Calls f(corners) for each vertex; f(edges of cells) for each edge.
  /// cost  O(cells)
  template <class F>
  void for_each_vertex(F&& f) const {
    for_each_class<4>([](std::uint32_t n) { return static_cast<std::uint8_t>(1u << n); }, f);
  }
  template <class F>
  void for_each_edge(F&& f) const {
    for_each_class<6>([](std::uint32_t e) { return static_cast<std::uint8_t>(1u << ends[e][0] | 1u << ends[e][1]); },
                      f);
  }
  std::size_t count_sides() const;
  std::size_t count_boundary() const;

 private:
  std::uint32_t node_at(std::uint32_t cell, std::uint32_t point) const;
  void add_children(std::uint32_t parent, std::uint8_t nodes, std::uint32_t vertex, double bracing,
                    std::vector<Child>& children);
  void join(Corner a, Corner b);

  // Parts of cells, k in 0 .. count - 1 of each, identified by their nodes.
  template <std::uint32_t parts, class Nodes, class F>
  void for_each_class(Nodes&& nodes, F& f) const {
    std::vector<std::uint8_t> met(cells_.size(), 0);
    std::vector<EdgeOfCell> members;
    for (std::uint32_t c = 0; c < cells_.size(); ++c)
      for (std::uint32_t k = 0; cells_[c].is_there && k < parts; ++k) {
        if (met[c] >> k & 1u) continue;
        members.clear();
        for (const auto& [cell, mask] : around(c, nodes(k))) {
          std::uint32_t j = 0;
          while (nodes(j) != mask) ++j;
          met[cell] = static_cast<std::uint8_t>(met[cell] | 1u << j);
          members.push_back({cell, j});
        }
        f(std::span<const EdgeOfCell>(members));
      }
  }

  std::vector<Tetrahedron> cells_;
  std::vector<Point> points_;
  std::size_t count_ = 0;
};

}  // namespace dartboard
