#include "core/elements/membrane_law.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/plain/error.h"

namespace dartboard {
namespace {

using Eigen::Matrix2d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

/// f of the eigenvalues of a symmetric matrix, in its directions.
template <class F>
Matrix2d of_eigenvalues(const Matrix2d& s, const F& f) {
  const double mean = 0.5 * s.trace(), half = 0.5 * (s(0, 0) - s(1, 1)), across = 0.5 * (s(0, 1) + s(1, 0));
  const double radius = std::sqrt(half * half + across * across);
  const double large = f(mean + radius), small = f(mean - radius);
  if (radius == 0.0) return large * Matrix2d::Identity();
  // twice the projector on the direction of the larger one, less 1
  Matrix2d direction;
  direction << half / radius, across / radius, across / radius, -half / radius;
  return (0.5 * (large + small)) * Matrix2d::Identity() + (0.5 * (large - small)) * direction;
}

double least_eigenvalue(const Matrix2d& s) {
  const double half = 0.5 * (s(0, 0) - s(1, 1)), across = 0.5 * (s(0, 1) + s(1, 0));
  return 0.5 * s.trace() - std::sqrt(half * half + across * across);
}

double product(const SurfaceGradient& a, const SurfaceGradient& b) { return a.cwiseProduct(b).sum(); }

Lame lame_of_membrane(const Material& material) {
  if (material.model == Model::springs) return {0.0, 0.0};
  if (!MembraneLaw::has(material.model))
    throw InputError(
        fmt::format("surfaces have no model '{}'; expected 'stvk' or 'corotational'", name(material.model)));
  return lame_of_sheet(material.young, material.poisson);
}

}  // namespace

SurfacePolar surface_polar(const SurfaceGradient& f) {
  const Vector3d f1 = f.col(0), f2 = f.col(1);
  Vector3d normal = f1.cross(f2);
  double area = normal.norm();
  const Vector3d& longer = f1.squaredNorm() >= f2.squaredNorm() ? f1 : f2;
  const double length = longer.norm();
  if (!(length > 0.0)) return {SurfaceGradient::Identity(), Vector3d::UnitZ()};
  const Vector3d along = longer / length;
  if (area > 0.0) {
    normal /= area;
  } else {
    Eigen::Index least = 0;
    along.cwiseAbs().minCoeff(&least);
    normal = along.cross(Vector3d::Unit(least));
  }
  // rounding turns the normal of a surface that is nearly a line: but not towards that line
  normal = (normal - along.dot(normal) * along).normalized();
  SurfaceGradient r;
  r << f1 + f2.cross(normal), f2 + normal.cross(f1);
  return {r / std::sqrt(0.5) / r.norm(), normal};
}

// ---- St. Venant-Kirchhoff

double StVenantKirchhoffSheet::energy(const SurfaceGradient& f) const {
  const Matrix2d e = strain(f);
  return mu_ * e.squaredNorm() + 0.5 * lambda_ * e.trace() * e.trace();
}

EnergyChange StVenantKirchhoffSheet::change(const SurfaceGradient& f, const SurfaceGradient& d) const {
  const Matrix2d half = f.transpose() * d;
  const Matrix2d de = 0.5 * (half + half.transpose() + d.transpose() * d);
  const Matrix2d sum = 2.0 * strain(f) + de;  // E0 + E1
  const double shear = mu_ * de.cwiseProduct(sum).sum(), trace = 0.5 * lambda_ * de.trace() * sum.trace();
  const double sizes = (mu_ + std::abs(lambda_)) * de.lpNorm<1>() * (1.0 + f.squaredNorm());
  return {shear + trace, std::abs(shear) + std::abs(trace) + sizes};
}

SurfaceGradient StVenantKirchhoffSheet::discrete_stress(const SurfaceGradient& f, const SurfaceGradient& d) const {
  const SurfaceGradient middle = f + 0.5 * d;
  return middle * second_stress(strain(middle) + 0.125 * (d.transpose() * d));
}

SurfaceHessian StVenantKirchhoffSheet::hessian(const SurfaceGradient& f, Compression compression) const {
  Matrix2d s = second_stress(strain(f));
  if (compression == Compression::projected && least_eigenvalue(s) < 0.0)
    s = of_eigenvalues(s, [](double value) { return std::max(value, 0.0); });
  const Matrix3d c = f * f.transpose();
  SurfaceHessian h;
  // d(FS): dF S, and F times 2 mu dE + lambda tr dE I with dE = sym(F' dF), which is positive semidefinite
  for (int l = 0; l < 2; ++l)
    for (int j = 0; j < 2; ++j)
      h.block<3, 3>(3 * j, 3 * l) = s(j, l) * Matrix3d::Identity() + mu_ * ((j == l ? 1.0 : 0.0) * c) +
                                    mu_ * f.col(l) * f.col(j).transpose() + lambda_ * f.col(j) * f.col(l).transpose();
  return h;
}

// ---- corotational

double CorotationalSheet::energy(const SurfaceGradient& f) const {
  const SurfaceGradient r = surface_polar(f).rotation;
  const double trace = product(r, f - r);  // tr(R'F) - 2
  return mu_ * (f - r).squaredNorm() + 0.5 * lambda_ * trace * trace;
}

EnergyChange CorotationalSheet::change(const SurfaceGradient& f, const SurfaceGradient& d) const {
  const SurfaceGradient r0 = surface_polar(f).rotation, r1 = surface_polar(f + d).rotation;
  const Matrix2d s0 = r0.transpose() * (f - r0), s1 = r1.transpose() * (f + d - r1);  // strains
  const Matrix2d ds = s1 - s0, sum = s0 + s1;
  const double shear = mu_ * ds.cwiseProduct(sum).sum(), trace = 0.5 * lambda_ * ds.trace() * sum.trace();
  // strains are rounded as the rotations are: relative to 1, however small their change
  const double sizes = mu_ * sum.lpNorm<1>() + 0.5 * std::abs(lambda_) * 2.0 * std::abs(sum.trace());
  return {shear + trace, std::abs(shear) + std::abs(trace) + 2.0 * sizes};
}

SurfaceGradient CorotationalSheet::stress(const SurfaceGradient& f) const {
  const SurfaceGradient r = surface_polar(f).rotation;
  return (2.0 * mu_) * (f - r) + (lambda_ * product(r, f - r)) * r;
}

SurfaceGradient CorotationalSheet::discrete_stress(const SurfaceGradient& f, const SurfaceGradient& d) const {
  const SurfaceGradient middle = f + 0.5 * d;
  const Matrix2d half = middle.transpose() * d, dc = half + half.transpose();
  SurfaceGradient found = stress(middle);
  const double size = dc.squaredNorm();
  if (size > 0.0) found += (2.0 * (change(f, d).value - product(found, d)) / size) * (middle * dc);
  return found;
}

// 2 mu I + lambda r r' + (lambda (tr S - 2) - 2 mu) dR/dF. R turns in its plane by T (T' dF) / tr S with T = R turned
// by a right angle, and out of it by n (n' dF) S^-1.
SurfaceHessian CorotationalSheet::hessian(const SurfaceGradient& f, Compression compression) const {
  const auto [r, n] = surface_polar(f);
  const Matrix2d s = r.transpose() * f;
  const double turn = lambda_ * product(r, f - r) - 2.0 * mu_;
  // where a stretch vanishes the rotation jumps, and any finite number will do
  const double least = std::max(1e-9 * f.norm(), 1e-300);
  const bool projects = compression == Compression::projected;
  double in_plane = turn / std::max(s.trace(), least);
  if (projects) in_plane = std::max(in_plane, -mu_);
  const Matrix2d outward = of_eigenvalues(s, [&](double stretch) {
    const double value = 2.0 * mu_ + turn / std::max(stretch, least);
    return (projects ? std::max(value, 0.0) : value) - 2.0 * mu_;
  });
  SurfaceGradient t;
  t << r.col(1), -r.col(0);
  const Eigen::Matrix<double, 6, 1> of_r = r.reshaped(), of_t = t.reshaped();
  SurfaceHessian h =
      2.0 * mu_ * SurfaceHessian::Identity() + lambda_ * of_r * of_r.transpose() + in_plane * of_t * of_t.transpose();
  const Matrix3d across = n * n.transpose();
  for (int l = 0; l < 2; ++l)
    for (int j = 0; j < 2; ++j) h.block<3, 3>(3 * j, 3 * l) += outward(j, l) * across;
  return h;
}

// ---- any of them

MembraneLaw::MembraneLaw(const Material& material) : law_(StVenantKirchhoffSheet(lame_of_membrane(material))) {
  const Lame lame = lame_of_membrane(material);
  if (material.model == Model::corotational) law_ = CorotationalSheet(lame);
  // the eigenvalues of pure shear, and of a strain equal in all directions
  modulus_ = 2.0 * (lame.mu + std::max(lame.lambda, 0.0));
}

}  // namespace dartboard
