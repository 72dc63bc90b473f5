#pragma once
// Walk (c), section 5.2: the map projected into four arrays, one for each dimension of cells.

#include <array>
#include <cstdint>
#include <vector>

#include "core/mechanics/adapt.h"
#include "core/topology/cells.h"

namespace dartboard {

/// The paper's `struct Cell { Dart *dart; Embedding *emb; }`, with numbers in place of pointers.
struct CellEntry {
  Dart dart;
  std::uint32_t embedding;
  friend bool operator==(const CellEntry&, const CellEntry&) = default;
};

/// The entry of an edge also names its two ends, the vertex embeddings at its dart and across alpha_0. One stream of 16
/// bytes: with the ends in an array of their own a step took 8 % longer on the paper's body.
struct EdgeEntry : CellEntry {
  std::array<std::uint32_t, 2> ends;
  friend bool operator==(const EdgeEntry&, const EdgeEntry&) = default;
};

/// Contiguous arrays to "navigate inside the 3-g-map and access data"; the time loop uses these and no dart.
///
class CellArrays {
 public:
  std::vector<CellEntry> vertices, faces, volumes;
  std::vector<EdgeEntry> edges;
  friend bool operator==(const CellArrays&, const CellArrays&) = default;

  /// Build from scratch by covering the map, as the paper does "after a series of simultaneous topological changes".
  ///
  /// Entries stand in the order of their embeddings' numbers, so that a change moves none of the others.
  /// cost    O(darts)
  template <class Body>
  void rebuild(const Body& body) {
    const auto& map = body.map;
    resize(body.vertices.size(), body.springs.size(), body.face_dart.size(), body.cell_dart.size());
    for_each_cell<0>(map, [&](Vertex v) { set(vertices, body.vertex(map, v.dart), v.dart); });
    for_each_cell<1>(map, [&](Edge e) { set_edge(body, body.edge(map, e.dart), e.dart); });
    if constexpr (Body::dimension == 3) {
      for_each_cell<2>(map, [&](Face f) { set(faces, body.face(map, f.dart), f.dart); });
      for_each_cell<3>(map, [&](Volume v) { set(volumes, body.cell(map, v.dart), v.dart); });
    } else {
      for_each_cell<2>(map, [&](Face f) { set(faces, body.cell(map, f.dart), f.dart); });
    }
  }

  /// Follow what `adapt` reports; gives what `rebuild` would.
  ///
  /// cost    O(changed embeddings), whatever the size of the body
  template <class Body>
  void apply(const Body& body, const ChangedEmbeddings& changed) {
    constexpr bool solid = Body::dimension == 3;
    resize(changed.vertex_count, changed.edge_count, changed.face_count, changed.cell_count);
    for (const auto k : changed.vertices) set(vertices, k, body.vertices.dart[k]);
    for (const auto k : changed.edges) set_edge(body, k, body.edge_dart[k]);
    for (const auto k : changed.faces) set(faces, k, body.face_dart[k]);
    for (const auto k : changed.cells) set(solid ? volumes : faces, k, body.cell_dart[k]);
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

 private:
  void resize(std::size_t vertex_count, std::size_t edge_count, std::size_t face_count, std::size_t cell_count) {
    const bool solid = face_count > 0;  // a surface counts its faces as cells
    vertices.resize(vertex_count);
    edges.resize(edge_count);
    faces.resize(solid ? face_count : cell_count);
    volumes.resize(solid ? cell_count : 0);
  }
  static void set(std::vector<CellEntry>& array, std::uint32_t k, Dart d) { array[k] = {d, k}; }
  template <class Body>
  void set_edge(const Body& body, std::uint32_t k, Dart d) {
    edges[k] = {{d, k}, {body.vertex(body.map, d), body.vertex(body.map, body.map.template alpha<0>(d))}};
  }
};

}  // namespace dartboard
