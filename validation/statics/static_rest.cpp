#include "validation/statics/static_rest.h"

#include <fmt/format.h>

#include <Eigen/SparseCholesky>
#include <cmath>

#include "core/plain/error.h"
#include "core/time/system/accelerations.h"
#include "validation/statics/linearised.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

constexpr double of_a_part = 1e-3;  // residual at which the next part of the load is added

/// The unknowns of free vertices, as the columns of a matrix.
Sparse freedom(const SpringSystem& system) {
  std::vector<Eigen::Triplet<double>> entries;
  int count = 0;
  for (std::uint32_t i = 0; i < system.vertex_count(); ++i)
    if (!system.fixed[i])
      for (int c = 0; c < 3; ++c) entries.emplace_back(static_cast<int>(3 * i) + c, count++, 1.0);
  Sparse free(static_cast<Eigen::Index>(3 * system.vertex_count()), count);
  free.setFromTriplets(entries.begin(), entries.end());
  return free;
}

}  // namespace

StaticRest static_rest(const SpringSystem& system, std::span<const Vector3d> start, std::span<const Vector3d> force,
                       const StaticPlan& plan, const StaticMatrix& matrix) {
  const Sparse free = freedom(system);
  StaticRest rest{{start.begin(), start.end()}};
  std::vector<Vector3d> a(system.vertex_count());
  // the residual: that share of the load and the body's own forces
  const auto left_over = [&](double share) {
    accelerations(system, {.fixed = true}, rest.x, {}, a);
    VectorXd left(free.rows());
    for (std::size_t i = 0; i < a.size(); ++i)
      left.segment<3>(static_cast<Eigen::Index>(3 * i)) = system.mass[i] * a[i] + share * force[i];
    return VectorXd(free.transpose() * left);
  };
  double asked = 0.0;
  for (const Vector3d& f : force) asked += f.squaredNorm();
  asked = std::sqrt(asked);
  Eigen::SimplicialLDLT<Sparse> factor;  // if a body bends far, the tangent need not be definite on the way
  for (int part = 1; part <= plan.parts; ++part) {
    const double share = static_cast<double>(part) / plan.parts;
    const double enough = part < plan.parts ? of_a_part : plan.residual;
    for (std::size_t taken = 0;; ++taken, ++rest.iterations) {
      const VectorXd left = left_over(share);
      rest.residual = left.norm() / asked;
      if (rest.residual <= enough) break;
      if (taken == plan.most || !std::isfinite(rest.residual))
        throw SolverError(fmt::format("a residual of {:.3g} is left of part {} of {} of the load after {} iterations",
                                      rest.residual, part, plan.parts, taken));
      const Sparse k = matrix ? matrix(rest.x) : linearised(system, rest.x).stiffness;
      factor.compute(free.transpose() * k * free);
      if (factor.info() != Eigen::Success) throw SolverError("the tangent of the body is singular");
      const VectorXd step = free * factor.solve(left);
      for (std::size_t i = 0; i < rest.x.size(); ++i) rest.x[i] += step.segment<3>(static_cast<Eigen::Index>(3 * i));
    }
  }
  return rest;
}

}  // namespace dartboard
