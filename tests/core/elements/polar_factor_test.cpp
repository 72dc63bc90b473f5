#include "core/elements/polar_factor.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <cmath>

#include "core/plain/random.h"

namespace dartboard::polar_factor_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Matrix3d random_matrix(SplitMix64& random) {
  Matrix3d m;
  for (double& entry : m.reshaped()) entry = random.next_signed();
  return m;
}

Matrix3d random_rotation(SplitMix64& random) {
  Vector3d axis;
  for (double& c : axis) c = random.next_signed();
  return Eigen::AngleAxisd(3.1 * random.next_signed(), axis.normalized()).toRotationMatrix();
}

/// How far R is from a rotation with R'F symmetric, relative to F.
double defect(const Matrix3d& r, const Matrix3d& f) {
  const Matrix3d s = r.transpose() * f;
  const double size = f.norm() > 0.0 ? f.norm() : 1.0;
  return (r.transpose() * r - Matrix3d::Identity()).norm() + std::abs(r.determinant() - 1.0) +
         (s - s.transpose()).norm() / size;
}

// Some hundred operations, each rounded by 1.1e-16 of numbers near 1.
constexpr double few_roundings = 2e-14;

TEST(PolarRotation, LeavesASymmetricFactorOfAnyMatrix) {
  SplitMix64 random(1);
  double worst = 0.0;
  for (int k = 0; k < 100000; ++k) {
    Matrix3d f = random_matrix(random);
    // z, the product of the sums of two stretches, loses digits as it vanishes; such matrices have a test of their own
    Eigen::JacobiSVD<Matrix3d> svd(f);
    const Vector3d s = svd.singularValues();
    const double last = f.determinant() < 0.0 ? -s[2] : s[2];
    if (s[1] + last < 0.05 * s[0]) continue;
    worst = std::max(worst, defect(polar_rotation(f), f));
  }
  EXPECT_LT(worst, 40 * few_roundings);  // 1 / 0.05 of them, and their square root of polishing left over
}

TEST(PolarRotation, IsTheNearestOfAllRotations) {
  SplitMix64 random(2);
  for (int k = 0; k < 2000; ++k) {
    const Matrix3d f = random_matrix(random), r = polar_rotation(f);
    const double distance = (f - r).norm();
    for (int trial = 0; trial < 20; ++trial) {
      const Matrix3d other =
          r *
          Eigen::AngleAxisd(0.3 * random.next_signed(),
                            Vector3d(random.next_signed(), random.next_signed(), random.next_signed()).normalized());
      EXPECT_GE((f - other).norm(), distance - 1e-12) << f;
    }
  }
}

TEST(PolarRotation, IsTheRotationThatAStretchWasTurnedBy) {
  SplitMix64 random(3);
  for (const Vector3d& stretches : {Vector3d(1, 1, 1), Vector3d(1.2, 0.9, 1), Vector3d(1e6, 1e6, 1e5),
                                    Vector3d(3, 2, 1e-9), Vector3d(1, 1, 0), Vector3d(2, 1.5, -0.5)}) {
    for (int k = 0; k < 200; ++k) {
      const Matrix3d axes = random_rotation(random), turn = random_rotation(random);
      const Matrix3d s = axes * stretches.asDiagonal() * axes.transpose();
      EXPECT_LT((polar_rotation(turn * s) - turn).norm(), 1e-13) << stretches.transpose();
    }
  }
}

TEST(PolarRotation, IsARotationWhereNoneIsNearest) {
  SplitMix64 random(4);
  for (const Vector3d& stretches :
       {Vector3d(1, 0, 0), Vector3d(1, 1e-12, 1e-13), Vector3d(1, 0.5, -0.5), Vector3d(1, 1, -1),
        Vector3d(1, 0.3, -0.3 + 1e-12), Vector3d(0, 0, 0), Vector3d(1e-8, 1e-8, -1e-8)}) {
    for (int k = 0; k < 200; ++k) {
      const Matrix3d axes = random_rotation(random), turn = random_rotation(random);
      const Matrix3d f = turn * axes * stretches.asDiagonal() * axes.transpose();
      // between two rotations R'F is symmetric to the root of rounding, the accuracy of the eigenvectors
      EXPECT_LT(defect(polar_rotation(f), f), 1e-7) << stretches.transpose();
    }
  }
  EXPECT_EQ(polar_rotation(Matrix3d::Zero()), Matrix3d::Identity());
}

TEST(PolarRotation, OfWhatIsNotFiniteIsNotFinite) {
  for (const double bad : {NAN, INFINITY}) {
    Matrix3d f = Matrix3d::Identity();
    f(1, 2) = bad;
    EXPECT_FALSE(polar_rotation(f).allFinite()) << bad;
  }
}

TEST(Cofactors, AreTheDeterminantTimesTheInverseTransposed) {
  SplitMix64 random(5);
  for (int k = 0; k < 1000; ++k) {
    const Matrix3d f = random_matrix(random);
    EXPECT_LT((cofactors(f) * f.transpose() - f.determinant() * Matrix3d::Identity()).norm(), few_roundings);
  }
}

}  // namespace
}  // namespace dartboard::polar_factor_test
