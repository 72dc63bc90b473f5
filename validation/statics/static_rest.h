#pragma once
// Where a body comes to rest under forces, by Newton's method over its own forces and tangents.

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
  double residual = 0.0;           // the forces left on free vertices over those asked for
};

struct StaticPlan {
  int parts = 1;            // of the load, one after the other
  double residual = 1e-11;  // that ends the last of them; the others end at a thousandth
  std::size_t most = 200;   // iterations of a part
};

/// A matrix [N/m] in the place of the tangent at x, of all unknowns.
using StaticMatrix = std::function<Eigen::SparseMatrix<double>(std::span<const Eigen::Vector3d> x)>;

/// Newton's method from `start` on with whole steps: the force left over, a matrix, its factor, a step. With the exact
/// tangent, where `matrix` is empty, residuals fall quadratically.
///
/// `force` [N] on each vertex beside what the system has.
/// pre     start and force have the system's vertices, and the force is large beside the rounding of the body's own
/// throws  SolverError where a part of the load takes too many iterations, or its residual is no number
StaticRest static_rest(const SpringSystem& system, std::span<const Eigen::Vector3d> start,
                       std::span<const Eigen::Vector3d> force, const StaticPlan& plan, const StaticMatrix& matrix = {});

}  // namespace dartboard
