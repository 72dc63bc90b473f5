#pragma once
// Three elastic laws from their definitions, in any precision: energy, stress, and the derivative of the stress.

#include <Eigen/Core>

#include "core/plain/material.h"

namespace dartboard::reference {

template <class Real>
using Matrix3 = Eigen::Matrix<Real, 3, 3>;

/// An isotropic solid: its model and Lame's constants [Pa].
struct ElasticLaw {
  Model model = Model::stvk;
  long double mu = 0, lambda = 0;
};
/// throws  InputError for a material of springs
ElasticLaw elastic_law(const Material& material);

/// [Pa] 2 mu + 3 lambda, for a neo-Hookean solid with the constants by Smith, de Goes and Kim: a bound of the change of
/// any law's stress at rest.
long double modulus(const ElasticLaw& law);

// Functions of a deformation gradient F, for Real = double and long double. Rotations are found by singular values
// where F is flat or inside out, and by averaging F with its inverse transpose elsewhere (core solves a quartic).

/// [J/m^3]
template <class Real>
Real energy_density(const ElasticLaw& law, const Matrix3<Real>& f);
/// The first Piola-Kirchhoff stress [Pa], the derivative of the energy density.
template <class Real>
Matrix3<Real> stress(const ElasticLaw& law, const Matrix3<Real>& f);
/// Gonzalez's discrete gradient from F to F + D: the stress half way, plus a multiple of F_m dC, C = F'F, such that its
/// product with D is the change of energy, which is found by quadrature along the way.
/// source  Gonzalez, J. Nonlinear Science 6, 1996
template <class Real>
Matrix3<Real> discrete_stress(const ElasticLaw& law, const Matrix3<Real>& f, const Matrix3<Real>& d);
/// The derivative of the stress by F, both as columns of nine, column after column.
using StressSlope = Eigen::Matrix<long double, 9, 9>;
StressSlope stress_slope(const ElasticLaw& law, const Matrix3<long double>& f);

/// The rotation that is nearest to F, with determinant 1 also where F turns inside out.
template <class Real>
Matrix3<Real> nearest_rotation(const Matrix3<Real>& f);

/// [Pa] A bound of the error of the stress over the relative rounding of the numbers, as large as `summed`, that F was
/// summed from; infinite if the nearest rotation is not unique. F may be as `far` from this one.
long double stress_size(const ElasticLaw& law, const Matrix3<long double>& f, long double summed, long double far = 0);

/// [Pa] The further error of a discrete gradient in double precision, over the same rounding: the two strains of a
/// corotational move are as accurate as their rotations, and their difference is divided by the move.
long double discrete_stress_size(const ElasticLaw& law, const Matrix3<long double>& f, const Matrix3<long double>& d);

}  // namespace dartboard::reference
