#pragma once
// Symmetric sparse matrices with one entry, a number or a 3x3 block, for each pair of coupled vertices.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/time/system/node_pattern.h"

namespace dartboard {

/// The lower triangle of a symmetric matrix. The blocks below the diagonal are symmetric themselves, as those of
/// springs are.
template <class Entry>
struct NodeMatrix {
  NodePattern pattern;
  std::vector<Entry> diagonal;  // by vertex
  std::vector<Entry> below;     // by entry of the pattern

  std::size_t node_count() const { return diagonal.size(); }
  std::size_t bytes() const { return pattern.bytes() + bytes_of(diagonal, below); }
  const Entry& diagonal_block(std::size_t i) const { return diagonal[i]; }

  /// y = A x.
  void multiply(std::span<const Eigen::Vector3d> x, std::span<Eigen::Vector3d> y) const {
    for (std::size_t i = 0; i < diagonal.size(); ++i) y[i] = diagonal[i] * x[i];
    for (std::size_t j = 0; j < diagonal.size(); ++j) {
      const Eigen::Vector3d at_column = x[j];
      Eigen::Vector3d sum = y[j];
      for (std::uint32_t k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k) {
        const std::uint32_t i = pattern.row[k];
        sum += below[k] * x[i];
        y[i] += below[k] * at_column;
      }
      y[j] = sum;
    }
  }
};

using BlockMatrix = NodeMatrix<Eigen::Matrix3d>;
using ScalarMatrix = NodeMatrix<double>;  // the same number for each of the three coordinates

}  // namespace dartboard
