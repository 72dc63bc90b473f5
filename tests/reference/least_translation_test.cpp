#include "reference/least_translation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace dartboard::reference::least_translation_test {
namespace {

using Eigen::Vector3d;

// Corners here are no farther apart than 6: ten roundings of that, and as many in the test's own computation.
constexpr double rounding = 20 * 6 * std::numeric_limits<double>::epsilon();

/// A flat roof, the triangle z = 0, above one corner.
const TetrahedronCorners table{Vector3d(-1, -1, 0), Vector3d(2, -1, 0), Vector3d(-1, 2, 0), Vector3d(0, 0, -2)};
/// A corner that points down, by d below z = 0, well within the roof.
TetrahedronCorners spike(double d) {
  // no edge of it is level, so that only that face is
  return {Vector3d(0.1, 0.1, -d), Vector3d(-1, -1, 2 - d), Vector3d(1, -1, 2.25 - d), Vector3d(0, 1, 1.75 - d)};
}
/// An edge along x on top, one along y below it.
const TetrahedronCorners ridge{Vector3d(-1, 0, 0), Vector3d(1, 0, 0), Vector3d(0, -1, -1), Vector3d(0, 1, -1)};
/// An edge along y below, at z = -d, one along x above it.
TetrahedronCorners keel(double d) {
  return {Vector3d(0, -1, -d), Vector3d(0, 1, -d), Vector3d(-1, 0, 1 - d), Vector3d(1, 0, 1 - d)};
}

TetrahedronCorners moved(const TetrahedronCorners& t, const Eigen::Isometry3d& by) {
  return {by * t[0], by * t[1], by * t[2], by * t[3]};
}

class Random {
 public:
  explicit Random(unsigned seed) : bits_(seed) {}
  Vector3d point() {
    const double x = number(), y = number(), z = number();
    return {x, y, z};
  }
  TetrahedronCorners tetrahedron() { return {point(), point(), point(), point()}; }
  Eigen::Isometry3d motion() {
    const Vector3d angles = 3.0 * point();
    return Eigen::Translation3d(point()) * Eigen::AngleAxisd(angles.x(), Vector3d::UnitX()) *
           Eigen::AngleAxisd(angles.y(), Vector3d::UnitY()) * Eigen::AngleAxisd(angles.z(), Vector3d::UnitZ());
  }

 private:
  double number() { return static_cast<double>(bits_()) / 2147483648.0 - 1.0; }
  std::mt19937 bits_;
};

/// The overlap of two shadows on an axis of length 1: a translation along it that separates them is no shorter.
double shared(const TetrahedronCorners& a, const TetrahedronCorners& b, const Vector3d& axis) {
  double high = -1e300, low = 1e300;
  for (const Vector3d& x : a) high = std::max(high, x.dot(axis));
  for (const Vector3d& x : b) low = std::min(low, x.dot(axis));
  return high - low;
}

void expect_translation(const TetrahedronCorners& a, const TetrahedronCorners& b, double depth, const Vector3d& along) {
  Random random(7);
  for (int k = 0; k < 100; ++k) {
    const Eigen::Isometry3d way = k == 0 ? Eigen::Isometry3d::Identity() : random.motion();
    const Translation t = least_translation(moved(a, way), moved(b, way));
    EXPECT_NEAR(t.depth, depth, rounding);
    EXPECT_LE((t.along - way.linear() * along).norm(), rounding);
  }
}

TEST(LeastTranslation, OfACornerInAFaceIsHowFarItIsBelowThatFace) {
  expect_translation(table, spike(0.125), 0.125, Vector3d::UnitZ());
}

TEST(LeastTranslation, MovesTheSecondOfTheTwo) { expect_translation(spike(0.125), table, 0.125, -Vector3d::UnitZ()); }

TEST(LeastTranslation, OfTwoEdgesThatCrossIsAlongTheirCommonNormal) {
  expect_translation(ridge, keel(0.25), 0.25, Vector3d::UnitZ());
}

TEST(LeastTranslation, IsNothingWhereTheyTouch) {
  expect_translation(table, spike(0.0), 0.0, Vector3d::UnitZ());
  expect_translation(ridge, keel(0.0), 0.0, Vector3d::UnitZ());
}

TEST(LeastTranslation, IsBelowNothingWhereTheyAreApart) {
  expect_translation(table, spike(-0.5), -0.5, Vector3d::UnitZ());
  expect_translation(ridge, keel(-0.5), -0.5, Vector3d::UnitZ());
}

TEST(LeastTranslation, OfOneInTheMiddleOfTheOtherGoesOutOfTheNearestFace) {
  // a regular tetrahedron around the origin whose faces are at 1/sqrt(3), and a third of it: the farthest corner of
  // that is on the other side, 1/sqrt(3) away
  const TetrahedronCorners big{Vector3d(1, 1, 1), Vector3d(-1, 1, -1), Vector3d(1, -1, -1), Vector3d(-1, -1, 1)};
  TetrahedronCorners small = big;
  for (Vector3d& x : small) x = x / 3.0;
  EXPECT_NEAR(least_translation(big, small).depth, 2.0 / std::sqrt(3.0), rounding);
}

TEST(LeastTranslation, DoesNotDependOnTheOrderOfCornersNorOnAnyInsideOut) {
  TetrahedronCorners a = table;
  std::sort(a.begin(), a.end(), [](const auto& p, const auto& q) { return p.x() + 2 * p.y() < q.x() + 2 * q.y(); });
  do {
    EXPECT_NEAR(least_translation(a, spike(0.125)).depth, 0.125, rounding);
  } while (std::next_permutation(a.begin(), a.end(),
                                 [](const auto& p, const auto& q) { return p.x() + 2 * p.y() < q.x() + 2 * q.y(); }));
}

TEST(LeastTranslation, OfTwoFlatOnesInOnePlaneIsNothing) {
  const TetrahedronCorners flat{Vector3d(0, 0, 1), Vector3d(1, 0, 1), Vector3d(0, 1, 1), Vector3d(1, 1, 1)};
  const Translation t = least_translation(flat, flat);
  EXPECT_EQ(t.depth, 0.0);
  EXPECT_EQ(t.along.cwiseAbs(), Vector3d::UnitZ());
}

TEST(LeastTranslation, KeepsAllItsDigitsFarFromTheOrigin) {
  // multiples of 2^-20 that move by 2^22: no place and no difference of two is rounded
  const Eigen::Isometry3d far(Eigen::Translation3d(4194304.0, -4194304.0, 4194304.0));
  const auto on_grid = [](TetrahedronCorners t) {
    for (Vector3d& x : t) x = (x * 1048576.0).array().round() / 1048576.0;
    return t;
  };
  Random random(5);
  for (int k = 0; k < 20; ++k) {
    const TetrahedronCorners a = on_grid(random.tetrahedron()), b = on_grid(random.tetrahedron());
    const Translation here = least_translation(a, b), there = least_translation(moved(a, far), moved(b, far));
    EXPECT_EQ(there.depth, here.depth);
    EXPECT_EQ(there.along, here.along);
  }
}

TEST(LeastTranslation, OfRandomPairsIsNoLongerThanAlongAnyDirectionAndPartsThem) {
  Random random(11);
  int overlapping = 0, by_edges = 0;
  for (int k = 0; k < 2000; ++k) {
    const TetrahedronCorners a = random.tetrahedron(), b = random.tetrahedron();
    const Translation t = least_translation(a, b);
    EXPECT_NEAR(t.along.norm(), 1.0, rounding);
    EXPECT_NEAR(shared(a, b, t.along), t.depth, rounding);
    if (!(t.depth > 0.0)) continue;  // if two are apart, their corners may be nearest: there is no axis for that here
    ++overlapping;
    for (int j = 0; j < 200; ++j) EXPECT_GE(shared(a, b, random.point().normalized()), t.depth - rounding);
    // where two corners of each end their shadows, it is that of two edges
    const auto ends = [&](const TetrahedronCorners& c, double sign) {
      double most = -1e300;
      for (const Vector3d& x : c) most = std::max(most, sign * x.dot(t.along));
      return std::ranges::count_if(c, [&](const Vector3d& x) { return sign * x.dot(t.along) > most - rounding; });
    };
    if (ends(a, 1.0) == 2 && ends(b, -1.0) == 2) ++by_edges;
  }
  EXPECT_GT(overlapping, 300);
  EXPECT_GT(by_edges, 100);
}

}  // namespace
}  // namespace dartboard::reference::least_translation_test
