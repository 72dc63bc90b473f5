#include "reference/elements/held_solid.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SparseCholesky>
#include <cmath>

#include "core/plain/error.h"
#include "core/plain/random.h"

namespace dartboard::reference {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

/// The unknowns that are free, as a matrix whose columns they are.
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

using Factor = Eigen::SimplicialLLT<Sparse, Eigen::Lower, Eigen::AMDOrdering<int>>;

void require(const Factor& factor) {
  if (factor.info() != Eigen::Success) throw SolverError("the stiffness of the solid is singular: it is not held");
}

}  // namespace

VectorXd HeldSolid::displacements(const VectorXd& force) const {
  const Sparse free = freedom(stiffness.rows(), held);
  const Factor factor(Sparse(free.transpose() * stiffness * free));
  require(factor);
  return free * factor.solve(free.transpose() * force);
}

std::vector<double> HeldSolid::frequencies(std::size_t count) const {
  const Sparse free = freedom(stiffness.rows(), held);
  const Sparse k = free.transpose() * stiffness * free, m = free.transpose() * mass * free;
  const Factor factor(k);
  require(factor);
  const auto wide = static_cast<Eigen::Index>(2 * count + 4);
  MatrixXd x(k.rows(), wide);
  SplitMix64 random(1);
  for (double& entry : x.reshaped()) entry = random.next_signed();
  VectorXd before = VectorXd::Zero(static_cast<Eigen::Index>(count));
  for (int iteration = 0; iteration < 300; ++iteration) {
    x = factor.solve(m * x).eval();
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
