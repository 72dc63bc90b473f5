#include "core/forces/semidefinite.h"

#include <Eigen/Eigenvalues>

#if defined(__GNUC__) && !defined(__clang__)
// a false alarm: GCC does not know that there is at least one vertex
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

namespace dartboard {

void make_semidefinite(std::span<Eigen::Matrix3d> blocks, std::size_t count) {
  const auto at = [](std::size_t a) { return static_cast<Eigen::Index>(3 * a); };
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 24, 24> whole(at(count), at(count));
  for (std::size_t a = 0; a < count; ++a)
    for (std::size_t b = 0; b < count; ++b) {
      if (a >= b)
        whole.block<3, 3>(at(a), at(b)) = blocks[a * (a + 1) / 2 + b];
      else
        whole.block<3, 3>(at(a), at(b)) = blocks[b * (b + 1) / 2 + a].transpose();
    }
  const Eigen::SelfAdjointEigenSolver<decltype(whole)> solver(whole);
  whole = solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).asDiagonal() * solver.eigenvectors().transpose();
  for (std::size_t a = 0, k = 0; a < count; ++a)
    for (std::size_t b = 0; b <= a; ++b) blocks[k++] = whole.block<3, 3>(at(a), at(b));
}

}  // namespace dartboard
