// The point of a triangle nearest to a place: by corners, edges and the inside, and against many others.

#include "core/places/nearest_on_triangle.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>

#include "core/plain/random.h"

namespace dartboard::nearest_on_triangle_test {
namespace {

using Eigen::Vector3d;

const Vector3d a(0, 0, 0), b(2, 0, 0), c(0, 2, 0);

NearestOnTriangle nearest_to(const Vector3d& y) { return nearest_on_triangle(a - y, b - y, c - y); }

void expect_near(const NearestOnTriangle& found, const Vector3d& way, const std::array<double, 3>& weight) {
  EXPECT_LE((found.way - way).norm(), 1e-15) << found.way.transpose();
  for (std::size_t k = 0; k < 3; ++k) EXPECT_NEAR(found.weight[k], weight[k], 1e-15) << k;
}

TEST(NearestOnTriangle, IsWithinOnAnEdgeOrACorner) {
  expect_near(nearest_to({0.5, 0.5, 3}), {0, 0, -3}, {0.5, 0.25, 0.25});
  expect_near(nearest_to({0.5, 0.5, -1e-9}), {0, 0, 1e-9}, {0.5, 0.25, 0.25});
  expect_near(nearest_to({0.5, -1, 2}), {0, 1, -2}, {0.75, 0.25, 0});
  expect_near(nearest_to({-1, 1.5, 0}), {1, 0, 0}, {0.25, 0, 0.75});
  expect_near(nearest_to({2, 2, 1}), {-1, -1, -1}, {0, 0.5, 0.5});
  expect_near(nearest_to({-1, -1, 0}), {1, 1, 0}, {1, 0, 0});
  expect_near(nearest_to({5, -1, 0}), {-3, 1, 0}, {0, 1, 0});
  expect_near(nearest_to({-1, 4, 1}), {1, -2, -1}, {0, 0, 1});
}

// No other point of the triangle is nearer, and its weights give the same point.
TEST(NearestOnTriangle, IsNearerThanAnyOther) {
  SplitMix64 random(3);
  const auto some = [&random] {
    const double x = random.next_signed(), y = random.next_signed(), z = random.next_signed();
    return Vector3d(x, y, z);
  };
  for (int k = 0; k < 500; ++k) {
    const Vector3d p = some(), q = some(), r = some();
    const NearestOnTriangle found = nearest_on_triangle(p, q, r);
    double sum = 0.0;
    for (const double w : found.weight) {
      EXPECT_GE(w, 0.0);
      sum += w;
    }
    EXPECT_NEAR(sum, 1.0, 1e-15);
    // the normal of a sliver is less accurate
    EXPECT_LE((found.weight[0] * p + found.weight[1] * q + found.weight[2] * r - found.way).norm(), 1e-12);
    const int n = 20;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; i + j <= n; ++j) {
        const Vector3d other = (i * p + j * q + (n - i - j) * r) / n;
        ASSERT_LE(found.way.norm(), other.norm() + 1e-12);
      }
  }
}

// However short the way is, it is straight along the normal.
TEST(NearestOnTriangle, KeepsTheDirectionOfAShortWay) {
  const Vector3d n = Vector3d(1, 2, 3).normalized(), along = n.unitOrthogonal(), across = n.cross(along);
  const Vector3d y = 1e-12 * n;
  const NearestOnTriangle found = nearest_on_triangle(-along - y, 2 * along + across - y, -2 * across - y);
  EXPECT_LE((found.way.normalized() + n).norm(), 1e-3);  // 1e-12 of places of 1 that are rounded
  EXPECT_NEAR(found.way.norm(), 1e-12, 1e-15);
}

TEST(NearestOnTriangle, OfOneWithoutAreaIsOnItsEdges) {
  expect_near(nearest_on_triangle({-1, 1, 0}, {3, 1, 0}, {1, 1, 0}), {0, 1, 0}, {0.75, 0.25, 0});
  expect_near(nearest_on_triangle({1, 1, 0}, {1, 1, 0}, {1, 1, 0}), {1, 1, 0}, {1, 0, 0});
}

// A floor, and a wall on it along x from 0 to 2, at y = 3.
TEST(NearestOnTriangle, OfTwoIsOnTheLineWhereTheyCross) {
  const TriangleCorners floor{{{-9, -9, 1}, {9, -9, 1}, {0, 18, 1}}}, wall{{{0, 3, 0}, {2, 3, 0}, {1, 3, 2}}};
  const auto seen_from = [](TriangleCorners t, const Vector3d& y) {
    for (Vector3d& corner : t) corner -= y;
    return t;
  };
  for (const auto& [y, nearest] : {std::pair<Vector3d, Vector3d>{{1, 0, 0}, {1, 3, 1}},
                                   {{1.2, 5, 7}, {1.2, 3, 1}},
                                   {{8, 0, 0}, {1.5, 3, 1}},
                                   {{-8, 3, 1}, {0.5, 3, 1}}}) {
    const auto found = nearest_on_both(seen_from(wall, y), seen_from(floor, y));
    ASSERT_TRUE(found);
    EXPECT_LE((found->way - (nearest - y)).norm(), 1e-14);
    Vector3d there(0, 0, 0);
    for (std::size_t k = 0; k < 3; ++k) there += found->weight[k] * wall[k];
    EXPECT_LE((there - nearest).norm(), 1e-14);
  }
  EXPECT_FALSE(nearest_on_both(wall, seen_from(floor, {0, 0, -2})));  // above the wall
  EXPECT_FALSE(nearest_on_both(floor, seen_from(floor, {1, 0, 0})));  // in one plane
}

}  // namespace
}  // namespace dartboard::nearest_on_triangle_test
