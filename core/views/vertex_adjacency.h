#pragma once
// The edges around every vertex.

#include <compare>
#include <cstdint>
#include <span>

#include "core/views/slack_rows.h"
#include "core/views/spring_ends.h"

namespace dartboard {

/// An edge, and the vertex at its other end: numbers of embeddings.
struct Neighbour {
  std::uint32_t vertex, edge;
  friend auto operator<=>(const Neighbour&, const Neighbour&) = default;
};

/// Of every vertex the incident edges, sorted by neighbour and then by edge.
///
/// A neighbour occurs as often as edges lead to it: after a dissociation two edges may join the same two vertices. An
/// edge from a vertex to itself occurs twice there, once for each end.
class VertexAdjacency {
 public:
  /// cost    O(edges), times the edges around a vertex at worst
  template <class Body>
  void rebuild(const Body& body) {
    ends_.rebuild(body);
    fill(body.vertices.size());
  }

  /// Follow what `adapt` reports; gives what `rebuild` would.
  ///
  /// cost    O(edges around the ends of the changed edges), whatever the size of the body
  template <class Body>
  void apply(const Body& body, const ChangedEmbeddings& changed) {
    while (rows_.count() < changed.vertex_count) rows_.add_row();
    ends_.apply(
        body, changed, [this](std::uint32_t k, const SpringEnds& ends) { take_out(k, ends); },
        [this](std::uint32_t k, const SpringEnds& ends) { put_in(k, ends); });
    while (rows_.count() > changed.vertex_count) rows_.drop_last_row();
  }

  std::size_t vertex_count() const { return rows_.count(); }
  std::span<const Neighbour> around(std::uint32_t vertex) const {
    return std::span(rows_.column<0>())
        .subspan(static_cast<std::size_t>(rows_.start(vertex)), static_cast<std::size_t>(rows_.length(vertex)));
  }
  /// Equal when the lists of all vertices are; where they lie does not count.
  friend bool operator==(const VertexAdjacency& a, const VertexAdjacency& b);

  std::size_t bytes() const { return rows_.bytes() + ends_.bytes(); }

 private:
  void fill(std::size_t vertex_count);
  void take_out(std::uint32_t edge, const SpringEnds& ends);
  void put_in(std::uint32_t edge, const SpringEnds& ends);
  SlackRows<Neighbour>::Index position(std::uint32_t vertex, Neighbour neighbour) const;

  SpringEndsView ends_;  // as the rows have them
  SlackRows<Neighbour> rows_;
};

}  // namespace dartboard
