#pragma once
// Walk (a), sections 4.2 and 5.1: every loop covers all darts, marks the cells it has met, and looks embeddings up.

#include <cstdint>

#include "core/topology/cells.h"

namespace dartboard {

/// Visits cells by covering the darts of the map. Holds nothing, so it never goes stale.
///
/// cost    O(darts) per loop, plus the look-ups of embeddings
struct DartCoverage {
  template <class Body, class F>
  static void for_each_vertex(const Body& body, F&& f) {
    for_each_cell<0>(body.map, [&](Vertex v) { f(body.vertex(body.map, v.dart)); });
  }
  /// f(edge, vertex, vertex): numbers of embeddings. "b belongs to the vertex orbit of one of the nodes, and alpha_0(b)
  /// to the other one."
  template <class Body, class F>
  static void for_each_edge(const Body& body, F&& f) {
    const auto& map = body.map;
    for_each_cell<1>(map, [&](Edge e) {
      f(body.edge(map, e.dart), body.vertex(map, e.dart), body.vertex(map, map.template alpha<0>(e.dart)));
    });
  }
};

}  // namespace dartboard
