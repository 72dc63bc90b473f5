#include "validation/extremes/motion_truth.h"

#include <gtest/gtest.h>

#include "core/time/integrators.h"
#include "validation/extremes/extreme_run.h"

namespace dartboard::motion_truth_test {
namespace {

SpringColumns after(const char* integrator, SpringColumns body, double h, int steps) {
  const auto method = make_integrator(integrator);
  for (int k = 0; k < steps; ++k) EXPECT_TRUE(method->step(body.system(), body.motion(), h).ok());
  return body;
}

TEST(MotionTruth, IsOffByTheWholeMotionWhereNothingWasDone) {
  for (const auto scene : extreme_bodies) {
    const SpringColumns body = moving_body(scene);
    const auto found = distance_from_truth(body, body, 10 / highest_frequency(body));
    ASSERT_TRUE(found.has_value());
    EXPECT_GT(found->moved, 0.0);
    EXPECT_DOUBLE_EQ(found->distance, found->moved);
    EXPECT_FALSE(found->resolved());
  }
}

// Runge and Kutta's error at h omega 0.1 over 10 / omega is some 1e-5 of the motion; explicit Euler's a third of it.
TEST(MotionTruth, IsWhereAnAccurateRunEnds) {
  const SpringColumns body = moving_body("box");
  const double h = 0.1 / highest_frequency(body);
  const auto good = distance_from_truth(body, after("rk4", body, h, 100), 100 * h);
  const auto bad = distance_from_truth(body, after("explicit-euler", body, h, 100), 100 * h);
  ASSERT_TRUE(good && bad);
  EXPECT_LT(good->distance, 1e-4 * good->moved);
  EXPECT_TRUE(good->resolved());
  EXPECT_FALSE(bad->resolved());
}

TEST(MotionTruth, IsThatOfTheBodyAndOfTheTimeAskedFor) {
  SpringColumns body = moving_body("chain");
  const double time = 5 / highest_frequency(body);
  const double moved = distance_from_truth(body, body, time)->moved;
  EXPECT_NE(distance_from_truth(body, body, 2 * time)->moved, moved);
  EXPECT_EQ(distance_from_truth(body, body, time)->moved, moved);
  SpringColumns other = body;
  other.springs[3].stiffness *= 2;
  EXPECT_NE(distance_from_truth(other, other, time)->moved, moved);
  EXPECT_EQ(distance_from_truth(body, body, time)->moved, moved);
  other = body;
  other.v[3].x() += 0.1;
  EXPECT_NE(distance_from_truth(other, other, time)->moved, moved);
  EXPECT_EQ(distance_from_truth(body, body, time)->moved, moved);
}

TEST(MotionTruth, OfOneSolidIsNotThatOfAnother) {
  const Material soft{.density = 1.0, .young = 100.0, .poisson = 0.3, .model = Model::neo_hookean};
  Material stiff = soft;
  stiff.young *= 2;
  SpringColumns one = elastic_body("tetrahedra", soft), other = elastic_body("tetrahedra", stiff);
  const double time = 1 / highest_frequency(one);
  for (SpringColumns* body : {&one, &other})
    for (std::size_t i = 0; i < body->x.size(); ++i) body->v[i] = {0.01 * static_cast<double>(i), 0, 0};
  const double moved = distance_from_truth(one, one, time)->moved;
  EXPECT_NE(distance_from_truth(other, other, time)->moved, moved);
  EXPECT_EQ(distance_from_truth(one, one, time)->moved, moved);
}

TEST(MotionTruth, IsNotSoughtWhereItIsFarAway) {
  const SpringColumns body = moving_body("oscillator");
  EXPECT_TRUE(distance_from_truth(body, body, 200 / highest_frequency(body)).has_value());
  EXPECT_FALSE(distance_from_truth(body, body, 400 / highest_frequency(body)).has_value());
}

TEST(MotionTruth, IsResolvedWhereNothingMovesAndNothingShould) {
  SpringColumns body = moving_body("box");
  body.fixed.assign(body.fixed.size(), 1);
  for (auto& v : body.v) v.setZero();
  const auto still = distance_from_truth(body, body, 1.0);
  ASSERT_TRUE(still.has_value());
  EXPECT_TRUE(still->resolved());
  SpringColumns moved = body;
  moved.x[2].y() += 1e-9;
  EXPECT_FALSE(distance_from_truth(body, moved, 1.0)->resolved());
}

}  // namespace
}  // namespace dartboard::motion_truth_test
