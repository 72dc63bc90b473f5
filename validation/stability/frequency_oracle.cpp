#include "validation/stability/frequency_oracle.h"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "core/plain/eigenvalues.h"
#include "core/plain/nan_maximum.h"
#include "core/plain/random.h"

namespace dartboard {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

constexpr Index most_steps = 800;

// No eigenvalue of A above the bound: bound - A is positive definite. A slightly larger bound is tested, since at the
// eigenvalue itself the matrix is singular.
bool is_above_all(const Sparse& a, double bound) {
  Sparse shifted = -a;
  for (Index i = 0; i < a.rows(); ++i) shifted.coeffRef(i, i) += bound;
  shifted.makeCompressed();
  Eigen::SimplicialLLT<Sparse> factor(shifted);
  return factor.info() == Eigen::Success;
}

}  // namespace

Sparse scaled_stiffness(const SpringColumns& body) {
  const auto n = static_cast<Index>(3 * body.x.size());
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(36 * body.springs.size());
  const auto scale = [&body](std::uint32_t i) { return body.fixed[i] ? 0.0 : std::sqrt(body.inverse_mass[i]); };
  for (std::size_t s = 0; s < body.springs.size(); ++s) {
    const auto [i, j] = body.ends[s];
    const Eigen::Vector3d dx = body.x[j] - body.x[i];
    const Eigen::Matrix3d along = dx * dx.transpose() / dx.squaredNorm();
    const double across = 1.0 - body.springs[s].rest_length / dx.norm();
    const Eigen::Matrix3d block = body.springs[s].stiffness * (along + across * (Eigen::Matrix3d::Identity() - along));
    for (const auto& [row, column, sign] : {std::tuple(i, i, 1.0), {j, j, 1.0}, {i, j, -1.0}, {j, i, -1.0}})
      for (int r = 0; r < 3; ++r)
        for (int c = 0; c < 3; ++c)
          entries.emplace_back(static_cast<int>(3 * row) + r, static_cast<int>(3 * column) + c,
                               sign * scale(row) * scale(column) * block(r, c));
  }
  Sparse a(n, n);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

LargestEigenvalue largest_eigenvalue(const Sparse& a, double tolerance) {
  const Index n = a.rows(), most = std::min(n, most_steps);
  LargestEigenvalue found;
  if (n == 0) return found;
  Eigen::MatrixXd basis(n, most);
  VectorXd diagonal(most), beside(most), w(n);
  SplitMix64 random(1);
  for (Index i = 0; i < n; ++i) w[i] = random.next_signed();
  basis.col(0) = w.normalized();
  for (Index k = 0; k < most; ++k) {
    w.noalias() = a * basis.col(k);
    diagonal[k] = basis.col(k).dot(w);
    // twice is enough
    for (int again = 0; again < 2; ++again) w -= basis.leftCols(k + 1) * (basis.leftCols(k + 1).transpose() * w).eval();
    beside[k] = w.norm();
    const bool last = k + 1 == most || beside[k] <= 1e-14 * std::abs(diagonal.head(k + 1).maxCoeff());
    if (last || k % 10 == 9) {
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver;
      solver.computeFromTridiagonal(diagonal.head(k + 1), beside.head(k));
      found.value = solver.eigenvalues()[k];
      found.steps = static_cast<int>(k + 1);
      if (last || beside[k] * std::abs(solver.eigenvectors()(k, k)) <= tolerance * found.value / 4) {
        found.vector = (basis.leftCols(k + 1) * solver.eigenvectors().col(k)).normalized();
        break;
      }
    }
    basis.col(k + 1) = w / beside[k];
  }
  found.residual = (a * found.vector - found.value * found.vector).norm();
  found.proven = found.residual <= tolerance * found.value &&
                 is_above_all(a, found.value + std::max(found.residual, tolerance * found.value));
  return found;
}

FastestMode fastest_mode(const SpringColumns& body) {
  const LargestEigenvalue largest = largest_eigenvalue(scaled_stiffness(body));
  FastestMode mode;
  mode.omega = std::sqrt(max_or_nan(0.0, largest.value));
  // omega^2 lies between value - residual and value + 1e-9 value
  mode.error = largest.value > 0.0 ? std::max(largest.residual, 1e-9 * largest.value) / mode.omega : 0.0;
  mode.proven = largest.proven;
  double most = 0.0;
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    const double scale = body.fixed[i] ? 0.0 : std::sqrt(body.inverse_mass[i]);
    mode.shape.emplace_back(scale * largest.vector.segment<3>(static_cast<Index>(3 * i)));
    most = std::max(most, mode.shape.back().cwiseAbs().maxCoeff());
  }
  if (most > 0.0)
    for (Eigen::Vector3d& p : mode.shape) p /= most;
  return mode;
}

}  // namespace dartboard
