#pragma once
// Elements as the points at which their energy is evaluated, and their forces in any precision.

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/plain/material.h"
#include "core/plain/mesh.h"
#include "reference/elements/elastic_law.h"

namespace dartboard::reference {

/// A Gauss point of an element: F = sum of place times gradient', energy = volume times the law's density at F.
struct ElasticPoint {
  ElasticLaw law;
  long double volume = 0;                                  // [m^3]
  std::vector<std::uint32_t> corner;                       // points of the network
  std::vector<Eigen::Matrix<long double, 3, 1>> gradient;  // [1/m] by corner
  long double damping_time = 0;                            // [s]
  bool is_elastic = true;                                  // false: it has damping alone
};

/// The points of one cell at rest: one for a linear tetrahedron, eight for a trilinear hexahedron.
///
/// throws  InputError for another kind of cell, and for a material of springs
std::vector<ElasticPoint> elastic_points(const Mesh& rest, std::size_t cell, const Material& material);

/// F of a point; `x` has three numbers for each point of the network.
template <class Real>
Matrix3<Real> deformation(const ElasticPoint& point, const Real* x) {
  Matrix3<Real> f = Matrix3<Real>::Zero();
  const Eigen::Map<const Eigen::Matrix<Real, 3, 1>> first(x + 3 * std::size_t{point.corner[0]});
  for (std::size_t a = 1; a < point.corner.size(); ++a) {
    const Eigen::Map<const Eigen::Matrix<Real, 3, 1>> place(x + 3 * std::size_t{point.corner[a]});
    f += (place - first) * point.gradient[a].template cast<Real>().transpose();
  }
  return f;
}

/// force += the pull [N] of a point with this stress [Pa] on its corners.
template <class Real>
void add_pull(const ElasticPoint& point, const Matrix3<Real>& stress, Real* force) {
  for (std::size_t a = 0; a < point.corner.size(); ++a) {
    Eigen::Map<Eigen::Matrix<Real, 3, 1>> at(force + 3 * std::size_t{point.corner[a]});
    at -= Real(point.volume) * (stress * point.gradient[a].template cast<Real>());
  }
}

/// The first Piola-Kirchhoff stress [Pa] of the law at F, if it has any.
template <class Real>
Matrix3<Real> elastic_stress(const ElasticPoint& point, const Matrix3<Real>& f) {
  return point.is_elastic ? stress(point.law, f) : Matrix3<Real>(Matrix3<Real>::Zero());
}

/// The stress [Pa] that damping adds when F changes at this rate [1/s]: linear elasticity of the rate of Green's strain
/// (F'F - 1) / 2, times the damping time.
template <class Real>
Matrix3<Real> damping_stress(const ElasticPoint& point, const Matrix3<Real>& f, const Matrix3<Real>& rate) {
  const Matrix3<Real> strain = (rate.transpose() * f + f.transpose() * rate) / Real(2);
  const Matrix3<Real> second =
      Real(2 * point.law.mu) * strain + Real(point.law.lambda) * strain.trace() * Matrix3<Real>::Identity();
  return Real(point.damping_time) * (f * second);
}

/// Six orthogonal eigenstrains of linear elasticity, each of size 1: one of volume, two along the axes, three
/// shears.
template <class Real>
Matrix3<Real> unit_strain(int k) {
  using std::sqrt;
  Matrix3<Real> strain = Matrix3<Real>::Zero();
  if (k == 0) strain.diagonal() << 1, 1, 1;
  if (k == 1) strain.diagonal() << 1, -1, 0;
  if (k == 2) strain.diagonal() << 1, 1, -2;
  if (k == 3) strain(1, 2) = strain(2, 1) = 1;
  if (k == 4) strain(2, 0) = strain(0, 2) = 1;
  if (k == 5) strain(0, 1) = strain(1, 0) = 1;
  return strain / sqrt(strain.squaredNorm());
}

/// Calls f(corner, size) for each corner: the largest pull of damping there [N], if corners that are farther apart by
/// `reach` [m] than here move at up to `speed` [m/s] against each other; a relative rounding times it bounds the error
/// of the pull.
template <class F>
void for_each_damping_size(const ElasticPoint& point, const long double* x, long double reach, long double speed,
                           F&& f) {
  if (point.damping_time == 0) return;
  long double stretch = 0, rate = 0;
  for (std::size_t a = 1; a < point.corner.size(); ++a) {
    long double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const long double line = x[3 * std::size_t{point.corner[a]} + k] - x[3 * std::size_t{point.corner[0]} + k];
      square += line * line;
    }
    stretch += (std::sqrt(square) + reach) * point.gradient[a].norm();
    rate += speed * point.gradient[a].norm();
  }
  const long double most = std::abs(point.damping_time) * (2 * point.law.mu + 3 * std::abs(point.law.lambda)) * rate;
  for (std::size_t a = 0; a < point.corner.size(); ++a)
    f(point.corner[a], point.volume * most * stretch * stretch * point.gradient[a].norm());
}

/// Calls f(corner, size) for each corner: `size` [N] times a relative rounding of the lines between corners, each
/// longer by `reach` [m] than here, bounds the error of the force there; infinite if a rotation is not unique.
template <class F>
void for_each_size(const ElasticPoint& point, const long double* x, long double reach, F&& f) {
  long double summed = 0, far = 0;
  for (std::size_t a = 1; a < point.corner.size(); ++a) {
    long double square = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const long double line = x[3 * std::size_t{point.corner[a]} + k] - x[3 * std::size_t{point.corner[0]} + k];
      square += line * line;
    }
    summed += (std::sqrt(square) + reach) * point.gradient[a].norm();
    far += reach * point.gradient[a].norm();
  }
  const long double size = stress_size(point.law, deformation(point, x), summed, far);
  for (std::size_t a = 0; a < point.corner.size(); ++a)
    f(point.corner[a], point.volume * size * point.gradient[a].norm());
}

/// The 3x3 block [N/m] of corners a and b of the slope of a point's stress.
Matrix3<long double> stiffness_block(const ElasticPoint& point, const StressSlope& slope, std::size_t a, std::size_t b);

/// The 3x3 block [N s/m] by which the pull of a point's damping on corner a decreases with the velocity of corner b.
Matrix3<long double> damping_block(const ElasticPoint& point, const Matrix3<long double>& f, std::size_t a,
                                   std::size_t b);

}  // namespace dartboard::reference
