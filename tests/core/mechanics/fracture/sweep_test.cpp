#include <gtest/gtest.h>

#include <vector>

#include "core/mechanics/fracture/seam.h"

namespace dartboard::sweep_test {
namespace {

using Eigen::Vector3d;
const std::vector<Vector3d> path{{0, 0, 0}, {1, 0, 0}, {1, 2, 0}};
const Vector3d depth(0, 0, 1);

bool crosses(const Vector3d& a, const Vector3d& b) {
  const bool there = crosses_sweep(path, depth, a, b, 0.0);
  EXPECT_EQ(crosses_sweep(path, depth, b, a, 0.0), there);
  return there;
}

TEST(CrossesSweep, WhereASegmentMeetsAParallelogramOfALeg) {
  EXPECT_TRUE(crosses({0.5, -1, 0.5}, {0.5, 1, 0.5}));
  EXPECT_TRUE(crosses({0.5, 1, 0.5}, {1.5, 1, 0.5}));  // the second leg
  EXPECT_TRUE(crosses({0, -1, 1}, {0, 1, 1}));         // its border is part of it
}

TEST(CrossesSweep, NotBesideItsEndsNorAboveNorBelow) {
  EXPECT_FALSE(crosses({-0.25, -1, 0.5}, {-0.25, 1, 0.5}));
  EXPECT_FALSE(crosses({0.5, 3, 0.5}, {1.5, 3, 0.5}));
  EXPECT_FALSE(crosses({0.5, -1, 1.25}, {0.5, 1, 1.25}));
  EXPECT_FALSE(crosses({0.5, -1, -0.25}, {0.5, 1, -0.25}));
}

TEST(CrossesSweep, NotByASegmentThatEndsBeforeIt) {
  EXPECT_FALSE(crosses({0.5, -2, 0.5}, {0.5, -1, 0.5}));
  EXPECT_FALSE(crosses({0.25, 0.5, 0.5}, {0.75, 1.5, 0.5}));
}

// The ends are on different sides of the plane of a leg, and level with the leg, but the segment passes by.
TEST(CrossesSweep, NotByASegmentThatPassesByALeg) { EXPECT_FALSE(crosses({0.5, -1, 0.5}, {2.5, 0.5, 0.5})); }

}  // namespace
}  // namespace dartboard::sweep_test
