#pragma once
// The pairs of vertices coupled by springs and force terms: the sparsity of every matrix of a spring system, one row
// per vertex.

#include <cstdint>
#include <vector>

#include "core/base/bytes.h"
#include "core/time/system/spring_system.h"

namespace dartboard {

/// The lower triangle of a symmetric matrix on the free vertices, in compressed columns.
///
/// Fixed vertices keep a row, with the diagonal alone. Rows ascend in each column; parallel springs share an entry. The
/// pairs of a piece are (1, 0), (2, 0), (2, 1), (3, 0) and so on.
struct NodePattern {
  static constexpr std::uint32_t none = 0xffffffffu;

  std::vector<std::uint32_t> column_start{0};  // nodes + 1
  std::vector<std::uint32_t> row;              // of the entries below the diagonal
  // by spring, then by pair of each piece of each force term: its entry below the diagonal; `none` if an end is fixed
  std::vector<std::uint32_t> place;

  std::size_t node_count() const { return column_start.size() - 1; }
  template <class Archive>
  void state(Archive& archive) {
    archive(column_start, row, place);
  }
  std::size_t bytes() const { return bytes_of(column_start, row, place); }
  bool same_entries(const NodePattern& other) const { return column_start == other.column_start && row == other.row; }
};

/// cost    O(vertices + pairs log(pairs at a vertex))
NodePattern node_pattern_of(const SpringSystem& system);

}  // namespace dartboard
