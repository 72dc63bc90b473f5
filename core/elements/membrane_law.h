#pragma once
// The laws of membranes in plane stress, for deformation gradients with three rows and two columns.

#include <Eigen/Core>
#include <variant>

#include "core/elements/elastic_laws.h"
#include "core/forces/compression.h"
#include "core/forces/force_term.h"
#include "core/plain/material.h"

namespace dartboard {

/// The deformation gradient from the plane of a piece of surface at rest to space.
using SurfaceGradient = Eigen::Matrix<double, 3, 2>;
/// The derivative of a stress by a surface gradient, both as columns of six, column after column.
using SurfaceHessian = Eigen::Matrix<double, 6, 6>;

/// Lame's constants [N/m] of a sheet that is free to become thinner: lambda is less than that of the solid.
/// units   young [N/m]: that of the solid times the thickness
/// pre     young > 0, -1 < poisson < 1/2
inline Lame lame_of_sheet(double young, double poisson) {
  return {young / (2.0 * (1.0 + poisson)), young * poisson / ((1.0 + poisson) * (1.0 - poisson))};
}

/// F = R S: R has orthonormal columns, S is symmetric and not negative.
struct SurfacePolar {
  SurfaceGradient rotation;
  Eigen::Vector3d normal;  // to both of its columns
};
/// For any F: with the normal n of the surface, R = (F + (f2 x n, n x f1)) / tr S, which is accurate for flat F too. If
/// F maps the surface to a line, n is some normal to that; for F = 0, R is arbitrary.
SurfacePolar surface_polar(const SurfaceGradient& f);

// A law of a surface has the functions of those of solids (elastic_laws.h), in N/m and J/m^2, and
//   discrete_stress(F, D)  a discrete gradient between F and F + D: its product with D is the change of energy, and it
//                          keeps the angular momentum
// A turn of the plane at rest does not change the results, so that any frame of the plane will do.

/// St. Venant-Kirchhoff: linear in Green's strain E = (F'F - I) / 2, which bending leaves zero; softens where it is
/// compressed.
///
///     energy = mu E:E + lambda / 2 (tr E)^2
class StVenantKirchhoffSheet {
 public:
  explicit StVenantKirchhoffSheet(const Lame& lame) : mu_(lame.mu), lambda_(lame.lambda) {}

  double energy(const SurfaceGradient& f) const;
  EnergyChange change(const SurfaceGradient& f, const SurfaceGradient& d) const;
  SurfaceGradient stress(const SurfaceGradient& f) const { return f * second_stress(strain(f)); }
  /// F half way times the mean of both second stresses, as the energy is quadratic in E.
  /// source  Simo, Tarnow, ZAMP 43, 1992
  SurfaceGradient discrete_stress(const SurfaceGradient& f, const SurfaceGradient& d) const;
  /// Projected: without the loss of stiffness across a compression.
  SurfaceHessian hessian(const SurfaceGradient& f, Compression compression) const;

 private:
  static Eigen::Matrix2d strain(const SurfaceGradient& f) {
    return 0.5 * (f.transpose() * f - Eigen::Matrix2d::Identity());
  }
  Eigen::Matrix2d second_stress(const Eigen::Matrix2d& e) const {
    return (2.0 * mu_) * e + (lambda_ * e.trace()) * Eigen::Matrix2d::Identity();
  }
  double mu_, lambda_;
};

/// Corotational: linear elasticity in the plane of the surface, turned by the exact R.
///
///     energy = mu |F - R|^2 + lambda / 2 (tr(R'F) - 2)^2
class CorotationalSheet {
 public:
  explicit CorotationalSheet(const Lame& lame) : mu_(lame.mu), lambda_(lame.lambda) {}

  double energy(const SurfaceGradient& f) const;
  EnergyChange change(const SurfaceGradient& f, const SurfaceGradient& d) const;
  SurfaceGradient stress(const SurfaceGradient& f) const;
  /// source  Gonzalez 1996, as for solids
  SurfaceGradient discrete_stress(const SurfaceGradient& f, const SurfaceGradient& d) const;
  /// Projected: without the negative eigenvalues, which are those of turns in the plane and out of it.
  SurfaceHessian hessian(const SurfaceGradient& f, Compression compression) const;

 private:
  double mu_, lambda_;
};

/// Any of these laws.
class MembraneLaw {
 public:
  /// A material of springs makes a law without resistance.
  /// throws  InputError for a model that surfaces do not have
  explicit MembraneLaw(const Material& material);
  static bool has(Model model) { return model == Model::stvk || model == Model::corotational; }

  double energy(const SurfaceGradient& f) const {
    return std::visit([&](const auto& law) { return law.energy(f); }, law_);
  }
  EnergyChange change(const SurfaceGradient& f, const SurfaceGradient& d) const {
    return std::visit([&](const auto& law) { return law.change(f, d); }, law_);
  }
  SurfaceGradient stress(const SurfaceGradient& f) const {
    return std::visit([&](const auto& law) { return law.stress(f); }, law_);
  }
  SurfaceGradient discrete_stress(const SurfaceGradient& f, const SurfaceGradient& d) const {
    return std::visit([&](const auto& law) { return law.discrete_stress(f, d); }, law_);
  }
  SurfaceHessian hessian(const SurfaceGradient& f, Compression compression) const {
    return std::visit([&](const auto& law) { return law.hessian(f, compression); }, law_);
  }
  /// [N/m] the largest eigenvalue of the Hessian at rest.
  double modulus() const { return modulus_; }

 private:
  std::variant<StVenantKirchhoffSheet, CorotationalSheet> law_;
  double modulus_;
};
inline SurfaceGradient discrete_stress(const MembraneLaw& law, const SurfaceGradient& f, const SurfaceGradient& d) {
  return law.discrete_stress(f, d);
}

}  // namespace dartboard
