#pragma once
// The rest position of a body under forces, by Newton's method over its own forces and tangents.

#include <Eigen/Core>
#include <Eigen/SparseCore>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "core/time/system/spring_system.h"

namespace dartboard {

struct StaticRest {
  std::vector<Eigen::Vector3d> x;  // [m]
  std::size_t iterations = 0;      // of all parts of the load
  double residual = 0.0;           // the residual forces on free vertices over the applied ones
};

struct StaticPlan {
  int parts = 1;            // of the load, one after the other
  double residual = 1e-11;  // stops the last of them; the others end at a thousandth
  std::size_t most = 200;   // iterations of a part
};

/// A matrix [N/m] that replaces the tangent at x, over all unknowns.
using StaticMatrix = std::function<Eigen::SparseMatrix<double>(std::span<const Eigen::Vector3d> x)>;

/// Newton's method from `start` on with whole steps: the force left over, a matrix, its factor, a step. With the exact
/// tangent, where `matrix` is empty, residuals fall quadratically.
///
/// `force` [N] on each vertex is added to the forces of the system.
/// pre     start and force have the system's vertices, and the force is large compared with rounding of the body's own
/// throws  SolverError if a part of the load takes too many iterations, or its residual is NaN
StaticRest static_rest(const SpringSystem& system, std::span<const Eigen::Vector3d> start,
                       std::span<const Eigen::Vector3d> force, const StaticPlan& plan, const StaticMatrix& matrix = {});

}  // namespace dartboard
