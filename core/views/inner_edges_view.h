#pragma once
// The bending of the inner edges of a surface, by edge number: four vertices, and coefficients from rest positions.

#include <cstdint>
#include <vector>

#include "core/elements/bending.h"
#include "core/mechanics/adapt.h"

namespace dartboard {

/// One row per edge; that of an edge of the boundary is empty. Row is BendingEdge or SecondNeighbours.
template <class Row>
class InnerEdgesView {
 public:
  std::vector<Row> rows;
  friend bool operator==(const InnerEdgesView& a, const InnerEdgesView& b) { return a.rows == b.rows; }

  InnerEdgesView() = default;
  /// `rigidity` [N m] is that of BendingEdge rows; SecondNeighbours rows do not use it.
  explicit InnerEdgesView(double rigidity) : rigidity_(rigidity) {}

  /// pre     the body keeps rest positions (VertexColumns::keep_rest)
  /// cost    O(edges)
  template <class Body>
  void rebuild(const Body& body) {
    rows.resize(body.edge_dart.size());
    for (std::uint32_t k = 0; k < rows.size(); ++k) find(body, k);
  }

  /// Follow what `adapt` reports; gives what `rebuild` would.
  ///
  /// cost    O(changed edges, and the edges of the cells around changed vertices), whatever the size of the body
  template <class Body>
  void apply(const Body& body, const ChangedEmbeddings& changed) {
    rows.resize(changed.edge_count);
    for (const std::uint32_t k : changed.edges) find(body, k);
    Mark seen(body.map);
    for (const std::uint32_t k : changed.vertices)
      for_each_place_of(body.map, Vertex{body.vertices.dart[k]}, seen, [&](Dart d) {
        // every edge of the cell, of which some have this vertex next to them
        Dart at = d;
        do {
          find(body, body.edge(body.map, at));
          at = body.map.template alpha<0, 1>(at);
        } while (at != d);
      });
  }

  template <class Archive>
  void state(Archive& archive) {
    archive(rows);
  }

 private:
  template <class Body>
  void find(const Body& body, std::uint32_t k) {
    rows[k] = {};
    const auto& map = body.map;
    const Dart d = body.edge_dart[k], e = map.template alpha<0>(d);
    if (map.template is_free<2>(d)) return;
    const auto vertex = [&](Dart at) { return body.vertex(map, at); };
    // the corner next to an end of the edge, in the face of the dart
    const auto next_to = [&](Dart at) { return vertex(map.template alpha<1, 0>(at)); };
    set(rows[k], body.vertices.rest, {vertex(d), vertex(e)}, {next_to(d), next_to(map.template alpha<2>(d))},
        {next_to(e), next_to(map.template alpha<2>(e))});
  }

  using Pair = std::array<std::uint32_t, 2>;
  void set(BendingEdge& row, const std::vector<Eigen::Vector3d>& rest, const Pair& ends, const Pair& across,
           const Pair&) const {
    row.nodes = {ends[0], ends[1], across[0], across[1]};
    row.c = bending_coefficients(rigidity_, rest[ends[0]], rest[ends[1]], rest[across[0]], rest[across[1]]);
  }
  void set(SecondNeighbours& row, const std::vector<Eigen::Vector3d>& rest, const Pair&, const Pair& first,
           const Pair& second) const {
    const auto length = [&rest](const Pair& p) { return (rest[p[1]] - rest[p[0]]).norm(); };
    if (first == second) {
      row = {2, {first[0], first[1]}, {length(first)}};
      return;
    }
    row = {4, {first[0], first[1], second[0], second[1]}, {length(first), length(second)}};
  }

  double rigidity_ = 0.0;
};

using BendingView = InnerEdgesView<BendingEdge>;
using SecondNeighboursView = InnerEdgesView<SecondNeighbours>;

}  // namespace dartboard
