#include "core/elements/elastic_laws.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>

#include "core/plain/eigenvalues.h"
#include "core/plain/random.h"

namespace dartboard::elastic_laws_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Nine = Eigen::Matrix<double, 9, 1>;

const Lame lame = lame_of(3e4, 0.3);

template <class Law>
class ElasticLaw : public testing::Test {
 public:
  Law law{lame};
};
using Laws = testing::Types<NeoHookean, Corotational, StVenantKirchhoff>;
TYPED_TEST_SUITE(ElasticLaw, Laws);

Matrix3d random_matrix(SplitMix64& random, double size) {
  Matrix3d m;
  for (double& entry : m.reshaped()) entry = size * random.next_signed();
  return m;
}
Matrix3d random_rotation(SplitMix64& random) {
  return Eigen::AngleAxisd(3.0 * random.next_signed(),
                           Vector3d(random.next_signed(), random.next_signed(), 1).normalized())
      .toRotationMatrix();
}
/// Deformations up to inverted ones, well away from where rotations jump.
Matrix3d random_deformation(SplitMix64& random) {
  const Matrix3d axes = random_rotation(random), turn = random_rotation(random);
  const Vector3d stretches(1.0 + 0.5 * random.next_signed(), 1.0 + 0.4 * random.next_signed(),
                           0.4 + 0.7 * random.next_signed());
  return turn * axes * stretches.asDiagonal() * axes.transpose();
}
double product(const Matrix3d& a, const Matrix3d& b) { return a.cwiseProduct(b).sum(); }

// The energies by their principal stretches, the last negative where F is inverted: formulas of other papers' form.
double energy_by_stretches(const NeoHookean&, const Vector3d& s) {
  const double mu = 4.0 / 3.0 * lame.mu, la = lame.lambda + 5.0 / 6.0 * lame.mu;
  const double i = s.squaredNorm(), j = s.prod(), a = 1.0 + 0.75 * mu / la;
  return mu / 2 * (i - 3.0) + la / 2 * (std::pow(j - a, 2) - std::pow(1.0 - a, 2)) - mu / 2 * std::log((i + 1.0) / 4.0);
}
double energy_by_stretches(const Corotational&, const Vector3d& s) {
  const Vector3d e = s - Vector3d::Ones();
  return lame.mu * e.squaredNorm() + lame.lambda / 2 * e.sum() * e.sum();
}
double energy_by_stretches(const StVenantKirchhoff&, const Vector3d& s) {
  const Vector3d e = (s.cwiseAbs2() - Vector3d::Ones()) / 2;
  return lame.mu * e.squaredNorm() + lame.lambda / 2 * e.sum() * e.sum();
}

TYPED_TEST(ElasticLaw, HasTheEnergyOfItsPrincipalStretches) {
  SplitMix64 random(1);
  for (int k = 0; k < 500; ++k) {
    const Matrix3d f = random_deformation(random);
    Vector3d s = Eigen::JacobiSVD<Matrix3d>(f).singularValues();
    if (f.determinant() < 0.0) s[2] = -s[2];
    // the invariants that are subtracted are near 3
    EXPECT_NEAR(this->law.energy(f), energy_by_stretches(this->law, s), 1e-13 * 20 * lame.mu) << f;
  }
}

TYPED_TEST(ElasticLaw, HasNoEnergyAndNoStressWhereItIsOnlyTurned) {
  SplitMix64 random(2);
  for (int k = 0; k < 200; ++k) {
    const Matrix3d r = random_rotation(random);
    EXPECT_NEAR(this->law.energy(r), 0.0, 1e-28 * 1e2 * lame.mu);  // of squares of roundings
    EXPECT_LT(this->law.stress(r).norm(), 1e-14 * lame.mu);
  }
}

TYPED_TEST(ElasticLaw, KnowsASmallStrainToTheDigitsThatFHas) {
  SplitMix64 random(3);
  for (const double size : {1e-3, 1e-5, 1e-7}) {
    const Matrix3d g = random_matrix(random, size);
    const Matrix3d e = 0.5 * (g + g.transpose());
    const double linear = lame.mu * e.squaredNorm() + 0.5 * lame.lambda * e.trace() * e.trace();
    // third order terms, and the rounding of 1 + g
    EXPECT_NEAR(this->law.energy(Matrix3d::Identity() + g) / linear, 1.0, 20 * size + 1e-14 / size) << size;
    const Matrix3d stress = 2.0 * lame.mu * e + lame.lambda * e.trace() * Matrix3d::Identity();
    EXPECT_LT((this->law.stress(Matrix3d::Identity() + g) - stress).norm() / stress.norm(), 20 * size + 1e-14 / size);
  }
}

// A central difference of step d errs by d^2 and by rounding over d: some 1e-10 at 1e-5.
TYPED_TEST(ElasticLaw, HasTheStressThatItsEnergyGrowsBy) {
  SplitMix64 random(4);
  for (int k = 0; k < 200; ++k) {
    const Matrix3d f = random_deformation(random), d = random_matrix(random, 1e-5);
    const double slope = (this->law.energy(f + d) - this->law.energy(f - d)) / 2.0;
    EXPECT_NEAR(slope, product(this->law.stress(f), d), 1e-8 * lame.mu * d.norm()) << f;
  }
}

TYPED_TEST(ElasticLaw, HasTheHessianThatItsStressGrowsBy) {
  SplitMix64 random(5);
  for (int k = 0; k < 200; ++k) {
    const Matrix3d f = random_deformation(random), d = random_matrix(random, 1e-5);
    const Matrix3d slope = (this->law.stress(f + d) - this->law.stress(f - d)) / 2.0;
    const Nine by_hessian = this->law.hessian(f, Compression::exact) * Eigen::Map<const Nine>(d.data());
    EXPECT_LT((Eigen::Map<const Matrix3d>(by_hessian.data()) - slope).norm(), 1e-6 * lame.mu * d.norm()) << f;
  }
}

TYPED_TEST(ElasticLaw, TurnsItsStressWithTheBody) {
  SplitMix64 random(6);
  for (int k = 0; k < 200; ++k) {
    const Matrix3d f = random_deformation(random), q = random_rotation(random);
    EXPECT_NEAR(this->law.energy(q * f), this->law.energy(f), 1e-12 * lame.mu);
    EXPECT_LT((this->law.stress(q * f) - q * this->law.stress(f)).norm(), 1e-12 * lame.mu);
    const Matrix3d kirchhoff = this->law.stress(f) * f.transpose();
    EXPECT_LT((kirchhoff - kirchhoff.transpose()).norm(), 1e-12 * lame.mu);  // no torque
  }
}

TYPED_TEST(ElasticLaw, KnowsASmallChangeOfEnergyToItsOwnDigits) {
  SplitMix64 random(7);
  for (const double size : {1e-2, 1e-6, 1e-10}) {
    const Matrix3d f = random_deformation(random), d = random_matrix(random, size);
    const EnergyChange change = this->law.change(f, d);
    // by the stress half way: off by the third derivative. A law that has to find rotations knows strains to a rounding
    // of 1 and no better, and reports that in the sizes.
    const double by_stress = product(this->law.stress(f + 0.5 * d), d);
    EXPECT_NEAR(change.value, by_stress,
                20 * lame.mu * size * size * size + 4e-16 * change.sizes + 1e-14 * std::abs(by_stress))
        << size;
    EXPECT_GE(change.sizes, std::abs(change.value));
  }
}

TYPED_TEST(ElasticLaw, HasAProjectedHessianWithoutNegativeEigenvalues) {
  SplitMix64 random(8);
  int indefinite = 0;
  for (int k = 0; k < 300; ++k) {
    const Matrix3d f = k % 2 ? random_deformation(random) : random_matrix(random, 1.0);
    const Hessian exact = this->law.hessian(f, Compression::exact),
                  projected = this->law.hessian(f, Compression::projected);
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver{Eigen::MatrixXd(exact)};
    const double size = std::max(lame.mu, exact.norm());
    EXPECT_LT((projected - projected.transpose()).norm(), 1e-12 * size);
    EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(projected)).eigenvalues()[0],
              -1e-12 * size);
    // the nearest: eigenvalues that are not negative stay
    const Hessian nearest =
        solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).asDiagonal() * solver.eigenvectors().transpose();
    EXPECT_LT((projected - nearest).norm(), 1e-10 * size) << f;
    indefinite += solver.eigenvalues()[0] < -1e-9 * size;
  }
  EXPECT_GT(indefinite, 50);
}

TYPED_TEST(ElasticLaw, HasADiscreteStressThatDoesTheWorkThatTheEnergyChangesBy) {
  SplitMix64 random(9);
  for (const double size : {0.5, 1e-2, 1e-5}) {
    for (int k = 0; k < 100; ++k) {
      const Matrix3d f = random_deformation(random), d = random_matrix(random, size), middle = f + 0.5 * d;
      const Matrix3d stress = discrete_stress(this->law, f, d);
      EXPECT_NEAR(product(stress, d), this->law.change(f, d).value, 1e-12 * lame.mu * size);
      const Matrix3d kirchhoff = stress * middle.transpose();
      EXPECT_LT((kirchhoff - kirchhoff.transpose()).norm(), 1e-11 * stress.norm());
    }
  }
}

TYPED_TEST(ElasticLaw, StaysFiniteWhereAnElementIsFlatOrTurnedInsideOut) {
  for (const Vector3d& stretches :
       {Vector3d(1, 1, 0), Vector3d(1, 1, -1), Vector3d(1, 0, 0), Vector3d(0, 0, 0), Vector3d(1, 0.5, -0.5)}) {
    const Matrix3d f = stretches.asDiagonal();
    EXPECT_TRUE(std::isfinite(this->law.energy(f))) << stretches.transpose();
    EXPECT_TRUE(this->law.stress(f).allFinite()) << stretches.transpose();
    for (const Compression compression : {Compression::exact, Compression::projected})
      EXPECT_TRUE(this->law.hessian(f, compression).allFinite()) << stretches.transpose();
  }
}

// A law that resists inversion: an inverted element gains energy as it is inverted further. St. Venant-Kirchhoff's law
// does not resist.
TEST(NeoHookeanLaw, PushesBackWhatIsTurnedInsideOut) {
  for (const double last : {0.5, 0.0, -0.5, -1.0}) {
    const Matrix3d f = Vector3d(1, 1, last).asDiagonal();
    EXPECT_LT(NeoHookean(lame).stress(f)(2, 2), 0.0) << last;
    // at -1 two rotations are as near
    if (last > -1.0) {
      EXPECT_LT(Corotational(lame).stress(f)(2, 2), 0.0) << last;
    }
  }
}

TEST(LameConstants, AreThoseOfAStretchedBar) {
  for (const double poisson : {-0.5, 0.0, 0.25, 0.49}) {
    const Lame l = lame_of(7.0, poisson);
    // strain (1, -nu, -nu): stress (E, 0, 0)
    const double trace = 1.0 - 2.0 * poisson;
    EXPECT_NEAR(2.0 * l.mu + l.lambda * trace, 7.0, 1e-14 * (7.0 + std::abs(l.lambda)));
    EXPECT_NEAR(-2.0 * l.mu * poisson + l.lambda * trace, 0.0, 1e-14 * (7.0 + std::abs(l.lambda)));
  }
}

TYPED_TEST(ElasticLaw, IsNotStifferAtRestThanItsModulus) {
  for (const double nu : {-0.9, -0.4, 0.0, 0.3, 0.49}) {
    const TypeParam other(lame_of(3e4, nu));
    const Hessian h = other.hessian(Matrix3d::Identity(), Compression::exact);
    const double largest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(h)).eigenvalues()[8];
    // a solver of nine by nine is right to some roundings of the largest eigenvalue
    EXPECT_GE(other.modulus(), largest * (1.0 - 1e-14)) << nu;
    EXPECT_LE(other.modulus(), 3.0 * largest) << nu;
  }
}

}  // namespace
}  // namespace dartboard::elastic_laws_test
