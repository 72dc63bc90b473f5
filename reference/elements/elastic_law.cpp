#include "reference/elements/elastic_law.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/plain/error.h"

namespace dartboard::reference {
namespace {

/// Smith, de Goes and Kim's constants: with these the law is linear elasticity near rest.
struct NeoHookeanConstants {
  long double mu, lambda, a;
  explicit NeoHookeanConstants(const ElasticLaw& law)
      : mu(4 * law.mu / 3), lambda(law.lambda + 5 * law.mu / 6), a(1 + 3 * mu / (4 * lambda)) {}
};

template <class Real>
Matrix3<Real> cofactors_of(const Matrix3<Real>& f) {
  Matrix3<Real> cof;
  for (int c = 0; c < 3; ++c) cof.col(c) = f.col((c + 1) % 3).cross(f.col((c + 2) % 3));
  return cof;
}

// the change of the cofactors as F changes by D
Matrix3<long double> cofactors_along(const Matrix3<long double>& f, const Matrix3<long double>& d) {
  Matrix3<long double> change;
  for (int c = 0; c < 3; ++c)
    change.col(c) = f.col((c + 1) % 3).cross(d.col((c + 2) % 3)) + d.col((c + 1) % 3).cross(f.col((c + 2) % 3));
  return change;
}

template <class Real>
Real product(const Matrix3<Real>& a, const Matrix3<Real>& b) {
  return (a.transpose() * b).trace();
}

// R' dR is the skew matrix W with W S + S W = R' D - D' R: in the frame of the stretches, entry by entry.
Matrix3<long double> rotation_along(const Matrix3<long double>& f, const Matrix3<long double>& r,
                                    const Matrix3<long double>& d) {
  const Matrix3<long double> stretch = r.transpose() * f;
  const Eigen::SelfAdjointEigenSolver<Matrix3<long double>> solver((stretch + stretch.transpose()) / 2);
  const Matrix3<long double>& v = solver.eigenvectors();
  const Matrix3<long double> turning = v.transpose() * (r.transpose() * d - d.transpose() * r) * v;
  Matrix3<long double> w = Matrix3<long double>::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (i != j) w(i, j) = turning(i, j) / (solver.eigenvalues()[i] + solver.eigenvalues()[j]);
  return r * v * w * v.transpose();
}

Matrix3<long double> stress_along(const ElasticLaw& law, const Matrix3<long double>& f, const Matrix3<long double>& d) {
  switch (law.model) {
    case Model::neo_hookean: {
      const NeoHookeanConstants k(law);
      const Matrix3<long double> cof = cofactors_of(f);
      const long double i = f.squaredNorm() + 1;
      return k.mu * (1 - 1 / i) * d + 2 * k.mu * product(f, d) / (i * i) * f + k.lambda * product(cof, d) * cof +
             k.lambda * (f.determinant() - k.a) * cofactors_along(f, d);
    }
    case Model::corotational: {
      const Matrix3<long double> r = nearest_rotation(f), dr = rotation_along(f, r, d);
      return 2 * law.mu * (d - dr) + law.lambda * product(r, d) * r + law.lambda * (product(r, f) - 3) * dr;
    }
    default: {
      const Matrix3<long double> e = (f.transpose() * f - Matrix3<long double>::Identity()) / 2;
      const Matrix3<long double> de = (f.transpose() * d + d.transpose() * f) / 2;
      const auto second = [&law](const Matrix3<long double>& of) -> Matrix3<long double> {
        return 2 * law.mu * of + law.lambda * of.trace() * Matrix3<long double>::Identity();
      };
      return d * second(e) + f * second(de);
    }
  }
}

}  // namespace

ElasticLaw elastic_law(const Material& material) {
  if (material.model == Model::springs)
    throw InputError("the energy of an element of springs; expected a model of elements");
  const long double young = material.young, nu = material.poisson;
  return {material.model, young / (2 * (1 + nu)), young * nu / ((1 + nu) * (1 - 2 * nu))};
}

long double modulus(const ElasticLaw& law) {
  const NeoHookeanConstants k(law);
  return law.model == Model::neo_hookean ? 2 * k.mu + 3 * k.lambda : 2 * law.mu + 3 * law.lambda;
}

template <class Real>
Matrix3<Real> nearest_rotation(const Matrix3<Real>& f) {
  const Real size = f.norm();
  // averages of F and its inverse transpose converge to the rotation, doubling their digits (Higham 1986)
  if (f.determinant() > Real(1e-3L) * size * size * size) {
    Matrix3<Real> r = f;
    for (int k = 0; k < 60; ++k) {
      const Matrix3<Real> next = (r + r.inverse().transpose()) / 2;
      const Real moved = (next - r).norm();
      r = next;
      if (moved < 8 * std::sqrt(std::numeric_limits<Real>::epsilon())) return (r + r.inverse().transpose()) / 2;
    }
  }
  const Eigen::JacobiSVD<Matrix3<Real>> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Matrix3<Real> u = svd.matrixU();
  if ((u * svd.matrixV().transpose()).determinant() < 0) u.col(2) = -u.col(2);  // along the least stretch
  return u * svd.matrixV().transpose();
}

template <class Real>
Real energy_density(const ElasticLaw& law, const Matrix3<Real>& f) {
  const auto mu = static_cast<Real>(law.mu), lambda = static_cast<Real>(law.lambda);
  switch (law.model) {
    case Model::neo_hookean: {
      const NeoHookeanConstants k(law);
      const Real i = f.squaredNorm(), j = f.determinant(), a = static_cast<Real>(k.a);
      return Real(k.mu) / 2 * (i - 3 - std::log((i + 1) / 4)) +
             Real(k.lambda) / 2 * ((j - a) * (j - a) - (1 - a) * (1 - a));
    }
    case Model::corotational: {
      const Matrix3<Real> r = nearest_rotation(f);
      const Real stretch = product(r, f) - 3;
      return mu * (f - r).squaredNorm() + lambda / 2 * stretch * stretch;
    }
    default: {
      const Matrix3<Real> e = (f.transpose() * f - Matrix3<Real>::Identity()) / 2;
      return mu * e.squaredNorm() + lambda / 2 * e.trace() * e.trace();
    }
  }
}

template <class Real>
Matrix3<Real> stress(const ElasticLaw& law, const Matrix3<Real>& f) {
  const auto mu = static_cast<Real>(law.mu), lambda = static_cast<Real>(law.lambda);
  switch (law.model) {
    case Model::neo_hookean: {
      const NeoHookeanConstants k(law);
      return Real(k.mu) * (1 - 1 / (f.squaredNorm() + 1)) * f +
             Real(k.lambda) * (f.determinant() - Real(k.a)) * cofactors_of(f);
    }
    case Model::corotational: {
      const Matrix3<Real> r = nearest_rotation(f);
      return 2 * mu * (f - r) + lambda * (product(r, f) - 3) * r;
    }
    default: {
      const Matrix3<Real> e = (f.transpose() * f - Matrix3<Real>::Identity()) / 2;
      return f * (2 * mu * e + lambda * e.trace() * Matrix3<Real>::Identity());
    }
  }
}

template <class Real>
Matrix3<Real> discrete_stress(const ElasticLaw& law, const Matrix3<Real>& f, const Matrix3<Real>& d) {
  const Matrix3<Real> middle = f + d / 2, at_middle = stress(law, middle);
  const Matrix3<Real> dc = middle.transpose() * d + d.transpose() * middle;
  if (dc.squaredNorm() == 0) return at_middle;
  // The part of the change of energy that the stress half way does not give. By quadrature for short moves, where the
  // difference of two energies has no digits left: Gauss's seven points, exact to the 13th power of the move.
  static const Real places[4] = {Real(0), Real(0.405845151377397166906606412076961463L),
                                 Real(0.741531185599394439863864773280788407L),
                                 Real(0.949107912342758524526189684047851262L)};
  static const Real weights[4] = {
      Real(0.417959183673469387755102040816326531L), Real(0.381830050505118944950369775488975134L),
      Real(0.279705391489276667901467771423779582L), Real(0.129484966168869693270611432679082018L)};
  Real missing = 0;
  if (d.norm() < Real(0.02L)) {
    for (int k = 0; k < 4; ++k)
      for (const int side : {-1, 1}) {
        if (k == 0 && side > 0) continue;
        const Matrix3<Real> there = stress(law, Matrix3<Real>(middle + Real(side) * places[k] / 2 * d));
        missing += weights[k] / 2 * product<Real>(there - at_middle, d);
      }
  } else {
    missing = energy_density(law, Matrix3<Real>(f + d)) - energy_density(law, f) - product(at_middle, d);
  }
  return at_middle + 2 * missing / dc.squaredNorm() * (middle * dc);
}

StressSlope stress_slope(const ElasticLaw& law, const Matrix3<long double>& f) {
  StressSlope slope;
  for (int k = 0; k < 9; ++k) {
    Matrix3<long double> d = Matrix3<long double>::Zero();
    d(k % 3, k / 3) = 1;
    slope.col(k) = stress_along(law, f, d).reshaped();
  }
  return slope;
}

long double stress_size(const ElasticLaw& law, const Matrix3<long double>& f, long double summed, long double far) {
  const long double most = std::min(summed, 4 * (f.norm() + far));
  const long double size = modulus(law) * (1 + summed) * (1 + most * most);
  if (law.model != Model::corotational) return size;
  // the error of the rotation is that of F over the least sum of two stretches
  const Eigen::JacobiSVD<Matrix3<long double>> svd(f);
  const auto& s = svd.singularValues();
  const long double gap = f.determinant() < 0 ? s[1] - s[2] : s[1] + s[2];
  return size * (1 + (gap > 0 ? summed / gap : std::numeric_limits<long double>::infinity()));
}

long double discrete_stress_size(const ElasticLaw& law, const Matrix3<long double>& f, const Matrix3<long double>& d) {
  if (law.model != Model::corotational) return 0;
  const Matrix3<long double> middle = f + d / 2, dc = middle.transpose() * d + d.transpose() * middle;
  const long double strain = (f - nearest_rotation(f)).norm() + (f + d - nearest_rotation<long double>(f + d)).norm();
  return dc.norm() > 0 ? modulus(law) * strain * middle.norm() / dc.norm() : 0;
}

template Matrix3<double> nearest_rotation(const Matrix3<double>&);
template Matrix3<long double> nearest_rotation(const Matrix3<long double>&);
template double energy_density(const ElasticLaw&, const Matrix3<double>&);
template long double energy_density(const ElasticLaw&, const Matrix3<long double>&);
template Matrix3<double> stress(const ElasticLaw&, const Matrix3<double>&);
template Matrix3<long double> stress(const ElasticLaw&, const Matrix3<long double>&);
template Matrix3<double> discrete_stress(const ElasticLaw&, const Matrix3<double>&, const Matrix3<double>&);
template Matrix3<long double> discrete_stress(const ElasticLaw&, const Matrix3<long double>&,
                                              const Matrix3<long double>&);

}  // namespace dartboard::reference
