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

/// Contiguous arrays to "navigate inside the 3-g-map and access data"; the time loop sees these and no dart.
///
/// Faces have no embedding of their own in a mass/spring body: their entries hold only the dart.
struct CellArrays {
  std::vector<CellEntry> vertices, edges, faces, volumes;
  std::vector<std::array<std::uint32_t, 2>> ends;  // of edges[k]: the vertex embeddings at its dart and across alpha_0

  /// Build from scratch, as the paper does "after a series of simultaneous topological changes".   cost  O(darts)
  template <class Body>
  void rebuild(const Body& body) {
    const auto& map = body.map;
    for (auto* array : {&vertices, &edges, &faces, &volumes}) array->clear();
    ends.clear();
    for_each_cell<0>(map, [&](Vertex v) { vertices.push_back({v.dart, body.vertex(map, v.dart)}); });
    for_each_cell<1>(map, [&](Edge e) {
      edges.push_back({e.dart, body.edge(map, e.dart)});
      ends.push_back({body.vertex(map, e.dart), body.vertex(map, map.template alpha<0>(e.dart))});
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
    for (std::size_t k = 0; k < edges.size(); ++k) f(edges[k].embedding, ends[k][0], ends[k][1]);
  }

  std::size_t bytes() const {
    return sizeof(CellEntry) * (vertices.capacity() + edges.capacity() + faces.capacity() + volumes.capacity()) +
           sizeof(ends[0]) * ends.capacity();
  }
};

}  // namespace dartboard
