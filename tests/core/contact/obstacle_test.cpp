#include "core/contact/obstacle.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "core/plain/error.h"
#include "core/plain/random.h"

namespace dartboard::obstacle_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

std::vector<ObstacleShape> shapes() {
  return {HalfSpace{{0.1, -0.2, 0.3}, Vector3d(1, 2, 2) / 3.0}, Ball{{0.2, 0.1, -0.3}, 0.8},
          Block{{-0.5, -0.6, -0.7}, {0.5, 0.4, 0.9}}};
}

TEST(Penetration, OfAHalfSpaceIsTheDistanceToItsPlane) {
  const HalfSpace plane{{0, 0, 1}, {0, 0, 1}};
  EXPECT_EQ(penetration(plane, {5, -7, 0.75}).depth, 0.25);
  EXPECT_EQ(penetration(plane, {5, -7, 1.25}).depth, -0.25);
  EXPECT_EQ(penetration(plane, {5, -7, 0.75}).normal, Vector3d(0, 0, 1));
}

TEST(Penetration, OfABallLeadsAwayFromItsCentre) {
  const Ball ball{{1, 0, 0}, 2.0};
  const Penetration in = penetration(ball, {1, -1.5, 0});
  EXPECT_EQ(in.depth, 0.5);
  EXPECT_EQ(in.normal, Vector3d(0, -1, 0));
  EXPECT_EQ(in.curvature, Matrix3d(Vector3d(1 / 1.5, 0, 1 / 1.5).asDiagonal()));
  EXPECT_EQ(penetration(ball, {4, 0, 0}).depth, -1.0);
  const Penetration centre = penetration(ball, {1, 0, 0});
  EXPECT_EQ(centre.depth, 2.0);
  EXPECT_EQ(centre.normal, Vector3d(0, 0, 0));
}

TEST(Penetration, OfABlockIsTheDistanceToItsNearestFace) {
  const Block block{{0, 0, 0}, {4, 2, 1}};
  const auto expect = [&](const Vector3d& x, double depth, const Vector3d& normal) {
    const Penetration in = penetration(block, x);
    EXPECT_EQ(in.depth, depth);
    EXPECT_EQ(in.normal, normal);
    EXPECT_TRUE(in.curvature.isZero(0.0));
  };
  expect({0.25, 1, 0.5}, 0.25, {-1, 0, 0});
  expect({3.75, 1, 0.5}, 0.25, {1, 0, 0});
  expect({2, 0.25, 0.5}, 0.25, {0, -1, 0});
  expect({2, 1.75, 0.5}, 0.25, {0, 1, 0});
  expect({2, 1, 0.25}, 0.25, {0, 0, -1});
  expect({2, 1, 0.75}, 0.25, {0, 0, 1});
  expect({2, 1, 1.5}, -0.5, {0, 0, 1});         // outside
  expect({-3, 1, 1.5}, -3, {-1, 0, 0});         // beyond two of its planes
  expect({0.25, 0.25, 0.5}, 0.25, {-1, 0, 0});  // two faces as near: the lower axis
  expect({2, 1, 0.5}, 0.5, {0, 0, -1});         // the lower side
}

// Central differences of step 1e-6: right to 1e-12 of third derivatives and 1e-10 of rounding; 1e-4 for second ones.
TEST(Penetration, HasTheNormalAndTheCurvatureOfItsDepth) {
  SplitMix64 random(4);
  for (const ObstacleShape& shape : shapes())
    for (int k = 0; k < 50; ++k) {
      const Vector3d x(random.next_signed(), random.next_signed(), random.next_signed());
      const Penetration in = penetration(shape, x);
      const double step = 1e-6;
      Vector3d slope;
      Matrix3d bend;
      for (int c = 0; c < 3; ++c) {
        const Penetration up = penetration(shape, x + step * Vector3d::Unit(c)),
                          down = penetration(shape, x - step * Vector3d::Unit(c));
        slope[c] = (up.depth - down.depth) / (2 * step);
        bend.col(c) = (up.normal - down.normal) / (2 * step);
      }
      EXPECT_LE((slope + in.normal).norm(), 1e-8) << shape.index();
      EXPECT_LE((bend - in.curvature).norm(), 1e-4) << shape.index();
      EXPECT_NEAR(in.normal.norm(), 1.0, 4e-16);
    }
}

TEST(Obstacle, MovesFromOneTimeUntilAnother) {
  Obstacle o{Ball{}, {1, -2, 0.5}, 1.0, 3.0};
  EXPECT_EQ(o.moved_by(0.5), Vector3d(0, 0, 0));
  EXPECT_EQ(o.moved_by(2.0), Vector3d(1, -2, 0.5));
  EXPECT_EQ(o.moved_by(3.0), Vector3d(2, -4, 1));
  EXPECT_EQ(o.moved_by(9.0), Vector3d(2, -4, 1));
  EXPECT_EQ(o.velocity_at(0.5), Vector3d(0, 0, 0));
  EXPECT_EQ(o.velocity_at(1.0), Vector3d(1, -2, 0.5));
  EXPECT_EQ(o.velocity_at(3.0), Vector3d(1, -2, 0.5));
  EXPECT_EQ(o.velocity_at(3.5), Vector3d(0, 0, 0));
  EXPECT_EQ(Obstacle{Ball{}}.moved_by(1e9), Vector3d(0, 0, 0));
}

TEST(Obstacle, IsHalfAsThickAsItsLeastThickness) {
  EXPECT_EQ((Obstacle{HalfSpace{}}.half_thickness()), INFINITY);
  EXPECT_EQ((Obstacle{Ball{{0, 0, 0}, 0.75}}.half_thickness()), 0.75);
  EXPECT_EQ((Obstacle{Block{{0, 0, 0}, {4, 1, 2}}}.half_thickness()), 0.5);
}

// Places 3 m from others: a ball of 5 m has a circle of 3 m one metre below its top.
TEST(Obstacle, ComesBetweenPlacesThatAreFarApart) {
  EXPECT_EQ((Obstacle{HalfSpace{}}.depth_between(3.0)), 0.0);
  EXPECT_EQ((Obstacle{Ball{{0, 0, 0}, 5.0}}.depth_between(3.0)), 1.0);
  EXPECT_EQ((Obstacle{Ball{{0, 0, 0}, 3.0}}.depth_between(3.0)), INFINITY);
  EXPECT_EQ((Obstacle{Block{{0, 0, 0}, {100, 1, 7}}}.depth_between(3.0)), 0.0);
  EXPECT_EQ((Obstacle{Block{{0, 0, 0}, {100, 1, 6}}}.depth_between(3.0)), INFINITY);
}

TEST(Obstacle, IsRefusedWhereItHasNoInside) {
  const auto message = [](const Obstacle& obstacle) {
    try {
      obstacle.require_valid();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const ObstacleShape& shape : shapes()) EXPECT_EQ(message({shape}), "");
  EXPECT_EQ(message({HalfSpace{{0, 0, 0}, {0, 0, 2}}}), "the normal of an obstacle is 2 long, expected 1");
  EXPECT_EQ(message({Ball{{0, 0, 0}, 0.0}}), "the radius of an obstacle is 0, expected more than 0");
  EXPECT_EQ(message({Block{{0, 0, 0}, {1, 0, 1}}}),
            "an obstacle reaches from 0 to 0 along axis 1, expected some thickness");
  EXPECT_EQ(message({Ball{}, {1, 0, 0}, 2.0, 1.0}),
            "an obstacle moves from 2 s until 1 s, expected an end after its beginning");
}

}  // namespace
}  // namespace dartboard::obstacle_test
