#include "core/elements/polar_factor.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>

namespace dartboard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// By the eigenvectors v_i of F'F: F v_i has the length of the stretch s_i. The shortest one is replaced by the cross
// product of the others, which makes the determinant +1.
Matrix3d rotation_by_eigenvectors(const Matrix3d& f) {
  // iterative: the closed form loses half the digits where eigenvalues are close
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(f.transpose() * f);
  Matrix3d v = solver.eigenvectors();
  if (v.determinant() < 0.0) v.col(0) = -v.col(0);
  Vector3d u2 = f * v.col(2);
  const double s2 = u2.norm();
  if (s2 == 0.0) return Matrix3d::Identity();
  u2 /= s2;
  Vector3d u1 = f * v.col(1);
  u1 -= u1.dot(u2) * u2;
  if (u1.norm() <= 1e-14 * s2) u1 = (v.col(1) - v.col(1).dot(u2) * u2);
  if (u1.norm() <= 1e-7) u1 = u2.unitOrthogonal();
  u1.normalize();
  Matrix3d u;
  u << u1.cross(u2), u1, u2;
  return u * v.transpose();
}

}  // namespace

Matrix3d polar_rotation(const Matrix3d& f) {
  const double size = f.squaredNorm();
  if (!(size > 0.0) || !std::isfinite(size))
    return size == 0.0 ? Matrix3d(Matrix3d::Identity()) : Matrix3d(0.0 / size * f);
  const Matrix3d cof = cofactors(f);
  const double det = f.row(0).dot(cof.row(0));
  // The sum of the stretches, the last one negative where F is inverted, is the largest root of a quartic; Newton's
  // method comes down to it from the largest sum that stretches of this size can have, and stops where it does not.
  const double cof_size = cof.squaredNorm();
  double sum = std::sqrt(3.0 * size);
  for (int k = 0; k < 60; ++k) {
    const double excess = sum * sum - size;
    const double value = excess * excess - 8.0 * det * sum - 4.0 * cof_size;
    const double slope = 4.0 * sum * excess - 8.0 * det;
    const double next = sum - value / slope;
    if (!(slope > 0.0) || !(next < sum)) break;
    sum = next;
  }
  const double k = 0.5 * (sum * sum - size);
  const double z = k * sum - det;
  // z is the product of the sums of two stretches
  if (!(z > 1e-6 * size * std::sqrt(size))) return rotation_by_eigenvectors(f);
  const Matrix3d r = ((k + size) * f + sum * cof - f * (f.transpose() * f)) / z;
  const Matrix3d r_cof = cofactors(r);
  const double r_det = r.row(0).dot(r_cof.row(0));
  // next to a root that is threefold, rounding may throw Newton's method off it
  if (!(std::abs(r_det - 1.0) < 1e-6)) return rotation_by_eigenvectors(f);
  return 0.5 * (r + r_cof / r_det);  // one step of Newton's method to R R' = I
}

}  // namespace dartboard
