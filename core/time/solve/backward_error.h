#pragma once
// Backward errors: how wrong the solution of a linear system is, computed from the system itself.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/time/system/node_matrix.h"

namespace dartboard {

using ExtendedVector = Eigen::Matrix<long double, 3, 1>;

/// b - A x, summed in extended precision.
std::vector<ExtendedVector> extended_residual(const BlockMatrix& matrix, std::span<const Eigen::Vector3d> b,
                                              std::span<const Eigen::Vector3d> x);

/// Componentwise: max_i |b - A x|_i / (|A| |x| + |b|)_i, the least relative change of entries that makes x exact; NaN
/// if anything is.
///
/// The residual is summed in extended precision. In rows whose denominator is zero the residual must be zero.
/// source  Oettli, Prager 1964; Higham, Accuracy and Stability of Numerical Algorithms, theorem 7.3
double backward_error(const BlockMatrix& matrix, std::span<const Eigen::Vector3d> b,
                      std::span<const Eigen::Vector3d> x);

/// Normwise: |b - A x| / (|A| |x| + |b|) in the largest norm; NaN if anything is.
/// source  Rigal, Gaches 1967; Higham, theorem 7.1
double normwise_backward_error(const BlockMatrix& matrix, std::span<const Eigen::Vector3d> b,
                               std::span<const Eigen::Vector3d> x);

}  // namespace dartboard
