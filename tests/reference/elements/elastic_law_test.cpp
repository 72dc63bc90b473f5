#include "reference/elements/elastic_law.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>

#include "core/plain/random.h"

namespace dartboard::reference::elastic_law_test {
namespace {

using Matrix = Matrix3<long double>;
constexpr Model laws[] = {Model::neo_hookean, Model::corotational, Model::stvk};

ElasticLaw of(Model model, double poisson = 0.3) {
  return elastic_law({.density = 1.0, .young = 10.0, .poisson = poisson, .model = model});
}
Matrix draw(SplitMix64& random) {
  Matrix m;
  for (long double& entry : m.reshaped()) entry = random.next_signed();
  return m;
}
/// Near a rotation, far from it, and inside out.
Matrix draw_deformation(SplitMix64& random, int kind) {
  const Eigen::Quaternion<long double> turn(random.next_signed(), random.next_signed(), random.next_signed(), 1);
  Matrix f = turn.normalized().toRotationMatrix() * (Matrix::Identity() + (kind == 0 ? 0.05L : 0.3L) * draw(random));
  if (kind == 2) f.col(0) = -f.col(0);
  return f;
}

/// The least sum of two stretches, over which F may turn its rotation.
long double gap_of(const Matrix& f) {
  const Eigen::JacobiSVD<Matrix> svd(f);
  return f.determinant() < 0 ? svd.singularValues()[1] - svd.singularValues()[2]
                             : svd.singularValues()[1] + svd.singularValues()[2];
}

TEST(WitnessLaw, HasTheStressThatIsTheSlopeOfItsEnergy) {
  SplitMix64 random(1);
  for (const Model model : laws)
    for (int k = 0; k < 30; ++k) {
      const Matrix f = draw_deformation(random, k % 3), d = draw(random);
      // central differences: wrong by the third derivative, some 1e3 t^2, and by 1e-19 / t
      const long double t = 1e-7L;
      const long double slope =
          (energy_density(of(model), Matrix(f + t * d)) - energy_density(of(model), Matrix(f - t * d))) / (2 * t);
      EXPECT_NEAR(static_cast<double>((stress(of(model), f).transpose() * d).trace() - slope), 0, 1e-9) << name(model);
    }
}

TEST(WitnessLaw, HasTheSlopeOfItsStress) {
  SplitMix64 random(2);
  for (const Model model : laws)
    for (int k = 0; k < 30; ++k) {
      const Matrix f = draw_deformation(random, k % 3), d = draw(random);
      const long double t = 1e-7L;
      const Matrix by_differences =
          (stress(of(model), Matrix(f + t * d)) - stress(of(model), Matrix(f - t * d))) / (2 * t);
      const Eigen::Matrix<long double, 9, 1> along = stress_slope(of(model), f) * d.reshaped();
      // the third derivative of a rotation goes with the third power of 1 / gap
      EXPECT_LT((along - by_differences.reshaped()).norm(), 1e-9L + 100 * t * t / std::pow(gap_of(f), 3))
          << name(model) << " " << k;
    }
}

TEST(WitnessLaw, FindsTheRotationOfSingularValues) {
  SplitMix64 random(3);
  for (int k = 0; k < 100; ++k) {
    const Matrix f = draw_deformation(random, k % 3), r = nearest_rotation(f);
    EXPECT_LT((r.transpose() * r - Matrix::Identity()).norm(), 1e-17L);
    EXPECT_GT(r.determinant(), 0);
    const Eigen::JacobiSVD<Matrix> svd(f);
    const auto& s = svd.singularValues();
    const long double sum = f.determinant() < 0 ? s[0] + s[1] - s[2] : s.sum();  // the largest of tr(Q'F)
    EXPECT_LT(std::abs((r.transpose() * f).trace() - sum), 1e-17L);
    const Matrix in_double = nearest_rotation(Matrix3<double>(f.cast<double>())).cast<long double>();
    EXPECT_LT((in_double - r).norm(), 3e-15L * f.norm() / gap_of(f));  // some ten roundings of F
  }
}

// In steps by quadrature and by differences alike; the two methods meet at 0.02.
TEST(WitnessLaw, HasADiscreteGradientWhoseWorkIsTheChangeOfEnergy) {
  SplitMix64 random(4);
  for (const Model model : laws)
    for (const long double size : {1e-3L, 0.0199L, 0.0201L, 0.2L}) {
      const Matrix f = draw_deformation(random, 1);
      Matrix d = draw(random);
      d *= size / d.norm();
      const Matrix p = discrete_stress(of(model), f, d);
      const long double change = energy_density(of(model), Matrix(f + d)) - energy_density(of(model), f);
      EXPECT_LT(std::abs((p.transpose() * d).trace() - change), 1e-16L) << name(model);
      // objective: the mean of two symmetric stresses' moment about the middle vanishes
      const Matrix moment = p * (f + d / 2).transpose();
      EXPECT_LT((moment - moment.transpose()).norm(), 1e-16L) << name(model);
    }
}

TEST(WitnessLaw, OfAShortMoveIsTheStress) {
  SplitMix64 random(5);
  for (const Model model : laws) {
    const Matrix f = draw_deformation(random, 1), d = 1e-12L * draw(random);
    EXPECT_LT((discrete_stress(of(model), f, d) - stress(of(model), f)).norm(), 1e-9L) << name(model);
  }
}

TEST(WitnessLaw, BoundsWhatRestResists) {
  for (const Model model : laws) {
    const auto slope = stress_slope(of(model, 0.45), Matrix::Identity());
    // a swelling is resisted most: 2 mu + 3 lambda, or, rescaled to the same effect, their sum
    EXPECT_LE((slope * Matrix::Identity().eval().reshaped()).norm() / std::sqrt(3.0L),
              modulus(of(model, 0.45)) * (1 + 1e-15L));
  }
  EXPECT_EQ(static_cast<double>(modulus(of(Model::stvk, 0.25))), 2 * 4.0 + 3 * 4.0);
  EXPECT_NEAR(static_cast<double>(modulus(of(Model::neo_hookean, 0.25))), 2 * 16.0 / 3 + 3 * (4 + 10.0 / 3), 1e-14);
}

TEST(WitnessLaw, DoesNotKnowARotationWhereTwoStretchesAddUpToNothing) {
  const Matrix line = Eigen::Matrix<long double, 3, 1>(1, 0, 0).asDiagonal().toDenseMatrix();
  EXPECT_TRUE(std::isinf(stress_size(of(Model::corotational), line, 1)));
  EXPECT_TRUE(std::isfinite(stress_size(of(Model::neo_hookean), line, 1)));
  const Matrix flat = Eigen::Matrix<long double, 3, 1>(1, 1, 0).asDiagonal().toDenseMatrix();
  EXPECT_LT(stress_size(of(Model::corotational), flat, 1), 1e3L);
}

}  // namespace
}  // namespace dartboard::reference::elastic_law_test
