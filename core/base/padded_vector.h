#pragma once
// Vectors of three numbers in rows of four, each one packet of AVX2.

#include <Eigen/Core>

namespace dartboard {

/// Three numbers, and one that is not used: zero where the three are finite.
struct alignas(32) PaddedVector {
  double number[4];

  PaddedVector() = default;
  explicit PaddedVector(const Eigen::Vector3d& v) : number{v.x(), v.y(), v.z(), 0.0} {}
};

/// The three numbers of a row, for loops that are written once for both kinds of rows.
inline const Eigen::Vector3d& three_of(const Eigen::Vector3d& row) { return row; }
inline Eigen::Vector3d& three_of(Eigen::Vector3d& row) { return row; }
inline Eigen::Map<const Eigen::Vector3d> three_of(const PaddedVector& row) {
  return Eigen::Map<const Eigen::Vector3d>(row.number);
}
inline Eigen::Map<Eigen::Vector3d> three_of(PaddedVector& row) { return Eigen::Map<Eigen::Vector3d>(row.number); }

}  // namespace dartboard
