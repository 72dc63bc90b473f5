#pragma once
// The changes of cells by an operation, so that embeddings and views can follow.

#include <vector>

#include "core/topology/storage/dart.h"

namespace dartboard {

/// One cell became two: a dart of each part. The part of `kept` keeps the embedding's number, the part of `split` needs
/// a new one (section 4.3).
struct DissociatedCell {
  Dart kept, split;
};

/// The cells that an operation split or removed, by dimension. The operation itself contains no physics.
///
/// After a series of operations the parts of a pair may have come apart further, or be removed; their darts still
/// identify the cells that were touched.
struct TopologyChange {
  std::vector<DissociatedCell> vertices, edges, faces;

  // A dart, dead now, of every cell that was removed with a volume or face.
  std::vector<Dart> removed_vertices, removed_edges, removed_faces, removed_volumes;

  bool empty() const { return vertices.empty() && edges.empty() && faces.empty() && removed_faces.empty(); }
  /// Append the changes of an operation that came after this one.
  void append(const TopologyChange& later);
};

}  // namespace dartboard
