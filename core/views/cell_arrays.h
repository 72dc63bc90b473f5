#pragma once
// Walk (c), section 5.2: the map projected into four arrays, one for each dimension of cells.

#include <array>
#include <cstdint>
#include <vector>

#include "core/mechanics/embedding.h"
#include "core/topology/cells.h"

namespace dartboard {

/// The paper's `struct Cell { Dart *dart; Embedding *emb; }`, with numbers in place of pointers.
struct CellEntry {
  Dart dart;
  std::uint32_t embedding;
};

/// The entry of an edge also names its two ends, the vertex embeddings at its dart and across alpha_0. One stream of 16
/// bytes: with the ends in an array of their own a step took 8 % longer on the paper's body.
struct EdgeEntry : CellEntry {
  std::array<std::uint32_t, 2> ends;
};

/// Contiguous arrays to "navigate inside the 3-g-map and access data"; the time loop sees these and no dart.
///
/// Faces have no embedding of their own in a mass/spring body: their entries hold only the dart.
struct CellArrays {
  std::vector<CellEntry> vertices, faces, volumes;
  std::vector<EdgeEntry> edges;

  /// Build from scratch, as the paper does "after a series of simultaneous topological changes".   cost  O(darts)
  template <class Body>
  void rebuild(const Body& body) {
    const auto& map = body.map;
    for (auto* array : {&vertices, &faces, &volumes}) array->clear();
    edges.clear();
    for_each_cell<0>(map, [&](Vertex v) { vertices.push_back({v.dart, body.vertex(map, v.dart)}); });
    for_each_cell<1>(map, [&](Edge e) {
      edges.push_back({{e.dart, body.edge(map, e.dart)},
                       {body.vertex(map, e.dart), body.vertex(map, map.template alpha<0>(e.dart))}});
    });
    if constexpr (Body::dimension == 2) {
      for_each_cell<2>(map, [&](Face f) { faces.push_back({f.dart, body.cell(map, f.dart)}); });
    } else {
      for_each_cell<2>(map, [&](Face f) { faces.push_back({f.dart, no_embedding}); });
      for_each_cell<3>(map, [&](Volume v) { volumes.push_back({v.dart, body.cell(map, v.dart)}); });
    }
  }

  template <class Body, class F>
  void for_each_vertex(const Body&, F&& f) const {
    for (const CellEntry& entry : vertices) f(entry.embedding);
  }
  /// f(edge, vertex, vertex): numbers of embeddings.
  template <class Body, class F>
  void for_each_edge(const Body&, F&& f) const {
    for (const EdgeEntry& entry : edges) f(entry.embedding, entry.ends[0], entry.ends[1]);
  }

  std::size_t bytes() const {
    return sizeof(CellEntry) * (vertices.capacity() + faces.capacity() + volumes.capacity()) +
           sizeof(EdgeEntry) * edges.capacity();
  }
};

}  // namespace dartboard
