#include "core/elements/elastic_laws.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace dartboard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Nine = Eigen::Matrix<double, 9, 1>;

Nine nine(const Matrix3d& m) { return Eigen::Map<const Nine>(m.data()); }

double product(const Matrix3d& a, const Matrix3d& b) { return a.cwiseProduct(b).sum(); }

// F'F - I of F = I + G is G + G' + G'G: exact to a rounding of G, while the square of F is rounded relative to 1.
Matrix3d twice_strain(const Matrix3d& f) {
  const Matrix3d g = f - Matrix3d::Identity();
  return g + g.transpose() + g.transpose() * g;
}

Matrix3d cross_matrix(const Vector3d& w) {
  Matrix3d m;
  m << 0.0, -w[2], w[1], w[2], 0.0, -w[0], -w[1], w[0], 0.0;
  return m;
}

}  // namespace

Hessian projected(const Hessian& hessian) {
  // rigid turns have eigenvalues of zero to rounding: a matrix that is otherwise positive is left unchanged
  const double rounding = 1e-13 * hessian.norm();
  const Hessian lifted = hessian + rounding * Hessian::Identity();
  if (Eigen::LLT<Hessian>(lifted).info() == Eigen::Success || !hessian.allFinite()) return hessian;
  const Eigen::SelfAdjointEigenSolver<Hessian> solver(hessian);
  return solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).asDiagonal() * solver.eigenvectors().transpose();
}

// ---- stable neo-Hookean

// From the invariants less their values at rest, both computed from the strain, in which rotations cancel.
double NeoHookean::energy(const Matrix3d& f) const {
  const Matrix3d c = twice_strain(f), cof = cofactors(c);
  const double i = c.trace(), det = f.row(0).dot(cofactors(f).row(0));
  const double square = c.trace() + cof.trace() + c.row(0).dot(cof.row(0));  // J^2 - 1
  // the root of a number near 0 would lose digits that the determinant has
  const double j = det > 0.5 ? square / (1.0 + std::sqrt(1.0 + square)) : det - 1.0;
  return 0.5 * mu_ * (i - std::log1p(i / 4.0)) - 0.75 * mu_ * j + 0.5 * lambda_ * j * j;
}

EnergyChange NeoHookean::change(const Matrix3d& f, const Matrix3d& d) const {
  const Matrix3d cof_f = cofactors(f), cof_d = cofactors(d);
  const double i = f.squaredNorm() + 1.0, j = f.row(0).dot(cof_f.row(0)) - 1.0;
  const double di = 2.0 * product(f, d) + d.squaredNorm();
  const double dj = product(cof_f, d) + product(f, cof_d) + d.row(0).dot(cof_d.row(0));
  const double stretch = 0.5 * mu_ * di, log = -0.5 * mu_ * std::log1p(di / i);
  const double volume = lambda_ * dj * (j - slack_), square = 0.5 * lambda_ * dj * dj;
  return {(stretch + log) + (volume + square), std::abs(stretch) + std::abs(log) + std::abs(volume) + std::abs(square)};
}

Hessian NeoHookean::hessian(const Matrix3d& f, Compression compression) const {
  const Matrix3d cof = cofactors(f);
  const double i = f.squaredNorm() + 1.0, det = f.row(0).dot(cof.row(0));
  const double pressure = lambda_ * ((det - 1.0) - slack_);
  const Nine of_f = nine(f), of_cof = nine(cof);
  Hessian h = (mu_ * (1.0 - 1.0 / i)) * Hessian::Identity() + (2.0 * mu_ / (i * i)) * of_f * of_f.transpose() +
              lambda_ * of_cof * of_cof.transpose();
  // d cof f [d] is linear in f: its matrix is made of the columns of f as cross products
  for (int c = 0; c < 3; ++c) {
    const Matrix3d across = pressure * cross_matrix(f.col(c));
    const int a = (c + 1) % 3, b = (c + 2) % 3;
    h.block<3, 3>(3 * a, 3 * b) -= across;
    h.block<3, 3>(3 * b, 3 * a) += across;
  }
  return compression == Compression::projected ? projected(h) : h;
}

// ---- corotational

double Corotational::energy(const Matrix3d& f) const {
  const Matrix3d r = polar_rotation(f);
  const double trace = product(r, f - r);  // tr(R'F) - 3
  return mu_ * (f - r).squaredNorm() + 0.5 * lambda_ * trace * trace;
}

EnergyChange Corotational::change(const Matrix3d& f, const Matrix3d& d) const {
  const Matrix3d r0 = polar_rotation(f), r1 = polar_rotation(f + d);
  const Matrix3d s0 = r0.transpose() * (f - r0), s1 = r1.transpose() * (f + d - r1);  // strains
  const Matrix3d ds = s1 - s0, sum = s0 + s1;
  const double shear = mu_ * product(ds, sum), trace = 0.5 * lambda_ * ds.trace() * sum.trace();
  // strains are rounded as the rotations are: relative to 1, however small their change
  const double sizes = mu_ * sum.lpNorm<1>() + 0.5 * lambda_ * 3.0 * std::abs(sum.trace());
  return {shear + trace, std::abs(shear) + std::abs(trace) + 2.0 * sizes};
}

// 2 mu I + lambda r r' + (lambda (tr S - 3) - 2 mu) dR/dF. With T_i = R [e_i]x as columns of nine, dR/dF is
// T (tr(S) I - S)^-1 T': turning is perpendicular to stretching.
Hessian Corotational::hessian(const Matrix3d& f, Compression compression) const {
  const Matrix3d r = polar_rotation(f);
  Matrix3d s = r.transpose() * f;
  s = (0.5 * (s + s.transpose())).eval();
  const double turn = lambda_ * (s.trace() - 3.0) - 2.0 * mu_;
  Eigen::Matrix<double, 9, 3> twist;
  for (int i = 0; i < 3; ++i) twist.col(i) = nine(r * cross_matrix(Vector3d::Unit(i)));
  const Eigen::SelfAdjointEigenSolver<Matrix3d> stretches(s.trace() * Matrix3d::Identity() - s);
  Vector3d values;
  for (int i = 0; i < 3; ++i) {
    // sums of two stretches; where one vanishes, the rotation jumps, and any finite number will do
    const double least = 1e-9 * (std::abs(s.trace()) + f.norm());
    const double sum = stretches.eigenvalues()[i];
    const double value = turn / (std::abs(sum) > least ? sum : std::copysign(std::max(least, 1e-300), sum));
    values[i] = compression == Compression::projected ? std::max(value, -mu_) : value;
  }
  const Matrix3d inverse = stretches.eigenvectors() * values.asDiagonal() * stretches.eigenvectors().transpose();
  const Nine of_r = nine(r);
  return 2.0 * mu_ * Hessian::Identity() + lambda_ * of_r * of_r.transpose() + twist * inverse * twist.transpose();
}

// ---- St. Venant-Kirchhoff

double StVenantKirchhoff::energy(const Matrix3d& f) const {
  const Matrix3d e = 0.5 * twice_strain(f);
  return mu_ * e.squaredNorm() + 0.5 * lambda_ * e.trace() * e.trace();
}

EnergyChange StVenantKirchhoff::change(const Matrix3d& f, const Matrix3d& d) const {
  const Matrix3d half = f.transpose() * d;
  const Matrix3d de = 0.5 * (half + half.transpose() + d.transpose() * d);
  const Matrix3d sum = twice_strain(f) + de;  // E0 + E1
  const double shear = mu_ * product(de, sum), trace = 0.5 * lambda_ * de.trace() * sum.trace();
  const double sizes = mu_ * de.lpNorm<1>() * (1.0 + f.squaredNorm());
  return {shear + trace, std::abs(shear) + std::abs(trace) + sizes};
}

Hessian StVenantKirchhoff::hessian(const Matrix3d& f, Compression compression) const {
  const Matrix3d s = second_stress(f), c = f * f.transpose();
  Hessian h;
  // d(FS): dF S, and F times 2 mu dE + lambda tr dE I with dE = sym(F' dF)
  for (int l = 0; l < 3; ++l)
    for (int j = 0; j < 3; ++j)
      h.block<3, 3>(3 * j, 3 * l) = s(j, l) * Matrix3d::Identity() + mu_ * ((j == l ? 1.0 : 0.0) * c) +
                                    mu_ * f.col(l) * f.col(j).transpose() + lambda_ * f.col(j) * f.col(l).transpose();
  return compression == Compression::projected ? projected(h) : h;
}

}  // namespace dartboard
