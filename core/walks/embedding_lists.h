#pragma once
// Walk (b), section 5.2: "all the embeddings of cells of a given dimension in a separate double-linked list".

#include <cstdint>
#include <vector>

#include "core/topology/cells.h"

namespace dartboard {

/// A double-linked list of the embeddings of one dimension. Nodes are numbered like the embeddings they stand for.
class EmbeddingList {
 public:
  struct Node {
    Dart dart;  // of the cell that carries the embedding
    std::uint32_t previous, next;
  };

  void push_back(std::uint32_t embedding, Dart dart);
  void erase(std::uint32_t embedding);
  void clear();

  template <class F>
  void for_each(F&& f) const {
    for (std::uint32_t k = first_; k != end; k = nodes_[k].next) f(k, nodes_[k].dart);
  }

 private:
  static constexpr std::uint32_t end = 0xFFFFFFFF;
  std::vector<Node> nodes_;
  std::uint32_t first_ = end, last_ = end;
};

/// Visits embeddings along their lists; the neighbours of a cell are still found through its darts.
class EmbeddingLists {
 public:
  template <class Body>
  void rebuild(const Body& body) {
    vertices_.clear();
    edges_.clear();
    for_each_cell<0>(body.map, [&](Vertex v) { vertices_.push_back(body.vertex(body.map, v.dart), v.dart); });
    for_each_cell<1>(body.map, [&](Edge e) { edges_.push_back(body.edge(body.map, e.dart), e.dart); });
  }

  template <class Body, class F>
  void for_each_vertex(const Body&, F&& f) const {
    vertices_.for_each([&](std::uint32_t k, Dart) { f(k); });
  }
  /// f(edge, vertex, vertex): numbers of embeddings.
  template <class Body, class F>
  void for_each_edge(const Body& body, F&& f) const {
    const auto& map = body.map;
    edges_.for_each(
        [&](std::uint32_t k, Dart d) { f(k, body.vertex(map, d), body.vertex(map, map.template alpha<0>(d))); });
  }

 private:
  EmbeddingList vertices_, edges_;
};

}  // namespace dartboard
