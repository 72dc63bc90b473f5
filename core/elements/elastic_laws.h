#pragma once
// Elastic laws: the energy of a deformation, its stress, and their derivatives. Written once for every kind of element.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "core/elements/lanes/law_constants.h"
#include "core/elements/polar_factor.h"
#include "core/forces/compression.h"
#include "core/forces/force_term.h"

namespace dartboard {

/// Lame's constants [Pa] of an isotropic solid.
struct Lame {
  double mu, lambda;
};
/// pre  young > 0, -1 < poisson < 1/2
inline Lame lame_of(double young, double poisson) {
  return {young / (2.0 * (1.0 + poisson)), young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson))};
}

/// The largest eigenvalue [Pa] of linear elasticity: of a change of volume, or of shape if Poisson's ratio is negative.
inline double stiffest_strain(double mu, double lambda) { return 2.0 * mu + 3.0 * std::max(lambda, 0.0); }

/// The derivative of a stress by a deformation gradient, both as columns of nine, column after column.
using Hessian = Eigen::Matrix<double, 9, 9>;

/// The nearest positive semidefinite matrix, by its eigenvectors unless it is positive semidefinite already.
Hessian projected(const Hessian& hessian);

// A law has, for a deformation gradient F:
//   energy(F)         density [J/m^3], zero for a rotation
//   change(F, D)      energy(F + D) - energy(F) from differences that do not cancel, and the sizes of its summands
//   stress(F)         first Piola-Kirchhoff [Pa], the derivative of the energy
//   hessian(F, how)   the derivative of the stress
//   modulus()         [Pa] a bound of the Hessian's eigenvalues at rest, whatever Poisson's ratio

/// Stable neo-Hookean: smooth for every F, also inverted or flat, without a polar decomposition.
///
///     energy = mu' / 2 (I - 3 - log((I + 1) / 4)) + lambda' / 2 ((J - a)^2 - (1 - a)^2),  I = |F|^2, J = det F
///
/// with mu' = 4/3 mu, lambda' = lambda + 5/6 mu and a = 1 + 3 mu' / (4 lambda'), so that it is linear elasticity near
/// rest, and has no stress at rest.
/// source  Smith, de Goes, Kim, ACM Transactions on Graphics 37(2), 2018
class NeoHookean {
 public:
  explicit NeoHookean(const Lame& lame)
      : mu_(4.0 / 3.0 * lame.mu), lambda_(lame.lambda + 5.0 / 6.0 * lame.mu), slack_(0.75 * mu_ / lambda_) {}

  double energy(const Eigen::Matrix3d& f) const;
  EnergyChange change(const Eigen::Matrix3d& f, const Eigen::Matrix3d& d) const;
  Eigen::Matrix3d stress(const Eigen::Matrix3d& f) const {
    const Eigen::Matrix3d cof = cofactors(f);
    const double det = f.row(0).dot(cof.row(0));
    return (mu_ * (1.0 - 1.0 / (f.squaredNorm() + 1.0))) * f + (lambda_ * ((det - 1.0) - slack_)) * cof;
  }
  Hessian hessian(const Eigen::Matrix3d& f, Compression compression) const;
  double modulus() const { return 2.0 * mu_ + 3.0 * lambda_; }
  NeoHookeanConstants constants() const { return {mu_, lambda_, slack_}; }

 private:
  double mu_, lambda_, slack_;
};

/// Corotational: linear elasticity in the frame of the exact polar rotation R.
///
///     energy = mu |F - R|^2 + lambda / 2 (tr(R'F) - 3)^2
///
/// Its exact gradient is the force of warped stiffness, because R is exact.
/// source  Mueller, Gross, Graphics Interface 2004 (warped stiffness); Kim, Eberle, Dynamic Deformables, 2022, for the
///         eigenvalues: the three twists have 2 mu + 2 (lambda (tr S - 3) - 2 mu) / (s_i + s_j)
class Corotational {
 public:
  explicit Corotational(const Lame& lame) : mu_(lame.mu), lambda_(lame.lambda) {}

  double energy(const Eigen::Matrix3d& f) const;
  EnergyChange change(const Eigen::Matrix3d& f, const Eigen::Matrix3d& d) const;
  Eigen::Matrix3d stress(const Eigen::Matrix3d& f) const {
    const Eigen::Matrix3d r = polar_rotation(f);
    return (2.0 * mu_) * (f - r) + (lambda_ * (r.cwiseProduct(f).sum() - 3.0)) * r;
  }
  Hessian hessian(const Eigen::Matrix3d& f, Compression compression) const;
  double modulus() const { return stiffest_strain(mu_, lambda_); }
  CorotationalConstants constants() const { return {mu_, lambda_}; }

 private:
  double mu_, lambda_;
};

/// St. Venant-Kirchhoff: linear in Green's strain E = (F'F - I) / 2; softens without end where it is compressed.
///
///     energy = mu E:E + lambda / 2 (tr E)^2
class StVenantKirchhoff {
 public:
  explicit StVenantKirchhoff(const Lame& lame) : mu_(lame.mu), lambda_(lame.lambda) {}

  double energy(const Eigen::Matrix3d& f) const;
  EnergyChange change(const Eigen::Matrix3d& f, const Eigen::Matrix3d& d) const;
  Eigen::Matrix3d stress(const Eigen::Matrix3d& f) const { return f * second_stress(f); }
  Hessian hessian(const Eigen::Matrix3d& f, Compression compression) const;
  double modulus() const { return stiffest_strain(mu_, lambda_); }
  StVenantKirchhoffConstants constants() const { return {mu_, lambda_}; }

 private:
  Eigen::Matrix3d second_stress(const Eigen::Matrix3d& f) const {  // second Piola-Kirchhoff
    const Eigen::Matrix3d e = 0.5 * (f.transpose() * f - Eigen::Matrix3d::Identity());
    return (2.0 * mu_) * e + (lambda_ * e.trace()) * Eigen::Matrix3d::Identity();
  }
  double mu_, lambda_;
};

/// The stress of a discrete gradient (Gonzalez 1996) between F and F + D, from the law's at F + D/2: its product with
/// D is the change of energy, and it keeps the angular momentum, because the term added is F_m dC, C = F'F.
template <class Law>
Eigen::Matrix3d discrete_stress(const Law& law, const Eigen::Matrix3d& f, const Eigen::Matrix3d& d) {
  const Eigen::Matrix3d middle = f + 0.5 * d;
  const Eigen::Matrix3d half = middle.transpose() * d, dc = half + half.transpose();
  Eigen::Matrix3d stress = law.stress(middle);
  const double size = dc.squaredNorm();
  if (size > 0.0) {
    const double missing = law.change(f, d).value - stress.cwiseProduct(d).sum();
    stress += (2.0 * missing / size) * (middle * dc);
  }
  return stress;
}

}  // namespace dartboard
