#pragma once
// Symmetric sparse matrices with one entry, a number or a 3x3 block, for each pair of coupled vertices.

#include <Eigen/Core>
#include <span>
#include <type_traits>
#include <vector>

#include "core/time/system/node_pattern.h"

namespace dartboard {

/// The lower triangle of a symmetric matrix; above the diagonal the blocks are transposed.
template <class Entry>
struct NodeMatrix {
  NodePattern pattern;
  std::vector<Entry> diagonal;  // by vertex
  std::vector<Entry> below;     // by entry of the pattern

  std::size_t node_count() const { return diagonal.size(); }
  template <class Archive>
  void state(Archive& archive) {
    archive(pattern, diagonal, below);
  }
  std::size_t bytes() const { return pattern.bytes() + bytes_of(diagonal, below); }
  const Entry& diagonal_block(std::size_t i) const { return diagonal[i]; }

  /// y = A x.
  void multiply(std::span<const Eigen::Vector3d> x, std::span<Eigen::Vector3d> y) const {
    for (std::size_t i = 0; i < diagonal.size(); ++i) y[i] = diagonal[i] * x[i];
    add_below(x, y);
  }
  /// y += A x.
  void add_product(std::span<const Eigen::Vector3d> x, std::span<Eigen::Vector3d> y) const {
    for (std::size_t i = 0; i < diagonal.size(); ++i) y[i] += diagonal[i] * x[i];
    add_below(x, y);
  }

 private:
  void add_below(std::span<const Eigen::Vector3d> x, std::span<Eigen::Vector3d> y) const {
    for (std::size_t j = 0; j < diagonal.size(); ++j) {
      const Eigen::Vector3d at_column = x[j];
      Eigen::Vector3d sum = y[j];
      for (std::uint32_t k = pattern.column_start[j]; k < pattern.column_start[j + 1]; ++k) {
        const std::uint32_t i = pattern.row[k];
        if constexpr (std::is_same_v<Entry, double>)
          sum += below[k] * x[i];
        else
          sum += below[k].transpose() * x[i];
        y[i] += below[k] * at_column;
      }
      y[j] = sum;
    }
  }
};

using BlockMatrix = NodeMatrix<Eigen::Matrix3d>;
using ScalarMatrix = NodeMatrix<double>;  // the same number for each of the three coordinates

}  // namespace dartboard
