#pragma once
// What an operation did to the cells, so that embeddings and views can follow.

#include <vector>

#include "core/topology/dart.h"

namespace dartboard {

/// One cell became two: a dart of each part. The part of `kept` keeps the embedding's number, the part of `split` needs
/// a new one (section 4.3).
struct DissociatedCell {
  Dart kept, split;
};

/// The cells that one operation split, by dimension. The operation itself knows no physics.
struct TopologyChange {
  std::vector<DissociatedCell> vertices, edges, faces;

  bool empty() const { return vertices.empty() && edges.empty() && faces.empty(); }
};

}  // namespace dartboard
