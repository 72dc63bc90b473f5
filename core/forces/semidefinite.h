#pragma once
// The nearest positive semidefinite matrix of a piece with a few vertices.

#include <Eigen/Core>
#include <cstddef>
#include <span>

namespace dartboard {

/// Sets the negative eigenvalues of a symmetric matrix to zero. Its blocks are K_ab, b <= a, in place a (a + 1) / 2 +
/// b.
///
/// pre  1 <= count <= 8, the number of vertices
void make_semidefinite(std::span<Eigen::Matrix3d> blocks, std::size_t count);

}  // namespace dartboard
