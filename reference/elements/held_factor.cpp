#include "reference/elements/held_factor.h"

#include <cmath>
#include <cstdint>
#include <span>

#include "core/plain/eigenvalues.h"
#include "core/plain/error.h"
#include "core/plain/random.h"

namespace dartboard::reference {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

Sparse freedom(Eigen::Index unknowns, std::span<const std::uint32_t> held) {
  std::vector<bool> is_held(static_cast<std::size_t>(unknowns), false);
  for (const std::uint32_t i : held)
    for (std::size_t c = 0; c < 3; ++c) is_held[3 * i + c] = true;
  std::vector<Eigen::Triplet<double>> entries;
  int count = 0;
  for (Eigen::Index k = 0; k < unknowns; ++k)
    if (!is_held[static_cast<std::size_t>(k)]) entries.emplace_back(static_cast<int>(k), count++, 1.0);
  Sparse free(unknowns, count);
  free.setFromTriplets(entries.begin(), entries.end());
  return free;
}

}  // namespace

HeldFactor::HeldFactor(const HeldSolid& solid)
    : stiffness_(solid.stiffness), mass_(solid.mass), free_(freedom(solid.stiffness.rows(), solid.held)) {
  factor_.compute(free_.transpose() * stiffness_ * free_);
  if (factor_.info() != Eigen::Success) throw SolverError("the stiffness of the solid is singular: it is not held");
}

VectorXd HeldFactor::displacements(const VectorXd& force) const {
  return free_ * factor_.solve(free_.transpose() * force);
}

std::vector<double> HeldFactor::frequencies(std::size_t count) const {
  const Sparse k = free_.transpose() * stiffness_ * free_, m = free_.transpose() * mass_ * free_;
  const auto wide = static_cast<Eigen::Index>(2 * count + 4);
  MatrixXd x(k.rows(), wide);
  SplitMix64 random(1);
  for (double& entry : x.reshaped()) entry = random.next_signed();
  VectorXd before = VectorXd::Zero(static_cast<Eigen::Index>(count));
  for (int iteration = 0; iteration < 300; ++iteration) {
    x = factor_.solve(m * x).eval();
    const MatrixXd small_k = x.transpose() * (k * x), small_m = x.transpose() * (m * x);
    const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> ritz(small_k, small_m);
    x = (x * ritz.eigenvectors()).eval();
    const VectorXd now = ritz.eigenvalues().head(static_cast<Eigen::Index>(count));
    const bool stands_still = (now - before).norm() <= 2e-10 * now.norm();
    before = now;
    if (stands_still) break;
  }
  std::vector<double> omega;
  for (const double squared : before) omega.push_back(std::sqrt(squared));
  return omega;
}

}  // namespace dartboard::reference
