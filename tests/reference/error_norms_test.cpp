// Error norms on states whose errors can be computed by hand.

#include "reference/error_norms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/plain/error.h"

namespace dartboard::reference::error_norms_test {
namespace {

// Two masses on a spring of length 2, and one checkpoint; the reference moves.
struct ErrorNorms : testing::Test {
  ErrorNorms() {
    motion.network.mass = {1.0, 3.0};
    motion.network.fixed = {0, 0};
    motion.network.springs = {{0, 1, 8.0, 0.0, 2.0}};
    motion.network.gravity = {0, 0, -1};
    motion.checkpoints = {1.0};
    exact = {{{0, 0, 0}, {3, 0, 0}}, {{0, 1, 0}, {0, -1, 0}}};
    motion.start = exact;
    found = exact;
  }
  MotionErrors errors() const { return motion_errors(motion, std::span(&found, 1), std::span(&exact, 1)); }

  NetworkMotion motion;
  PointState exact, found;
};

TEST_F(ErrorNorms, AreZeroForTheReferenceItself) {
  const MotionErrors e = errors();
  for (const double error : {e.x, e.x_p95, e.x_largest, e.v, e.energy, e.momentum, e.angular}) EXPECT_EQ(error, 0.0);
}

TEST_F(ErrorNorms, WeighPositionsByMassInUnitsOfAnEdge) {
  found.x[0] += Eigen::Vector3d(0, 0, 0.5);
  const MotionErrors e = errors();
  EXPECT_EQ(e.x, 0.125);         // sqrt(1 * 0.25 / 4) / 2
  EXPECT_EQ(e.x_largest, 0.25);  // 0.5 / 2
  EXPECT_EQ(e.x_p95, 0.25);      // 95 % of two points are two
  EXPECT_EQ(e.v, 0.0);
  EXPECT_EQ(e.momentum, 0.0);
}

TEST_F(ErrorNorms, TakeVelocitiesAndMomentumRelativeToTheReferences) {
  found.v[0] += Eigen::Vector3d(0, 0, 0.5);
  const MotionErrors e = errors();
  EXPECT_EQ(e.v, 0.25);          // sqrt(1 * 0.25) / sqrt(1 + 3)
  EXPECT_EQ(e.momentum, 0.125);  // 0.5 / (1 + 3)
  EXPECT_EQ(e.x, 0.0);
}

// T = 2, V = 8 (3 - 2)^2 / 2 = 4. Lifting the heavy mass by 0.5 adds 1.5 of gravity; the length is sqrt(9.25) then.
TEST_F(ErrorNorms, CompareTheWholeEnergy) {
  found.x[1] += Eigen::Vector3d(0, 0, 0.5);
  const double longer = std::sqrt(9.25) - 2.0;
  // a few roundings of 1.5
  EXPECT_NEAR(errors().energy, std::abs(4.0 * longer * longer - 4.0 + 1.5) / 6.0, 1e-15);
}

// The centre of mass is at 9/4; arms are 9/4 and 3/4, so the scale is 9/4 + 3 * 3/4 = 9/2.
TEST_F(ErrorNorms, TakeSpinAboutTheReferencesCentreOfMass) {
  found.v[0] += Eigen::Vector3d(0, 0.5, 0);
  EXPECT_EQ(errors().angular, 2.25 * 0.5 / 4.5);
}

TEST_F(ErrorNorms, TakeTheWorstCheckpointAndItsOwnNetwork) {
  NetworkEvent event{1.5, motion.network, {0, 0, 1}};
  event.network.mass = {0.5, 0.5, 3.0};
  event.network.fixed = {0, 0, 0};
  motion.events.push_back(event);
  motion.checkpoints = {1.0, 2.0};
  const PointState later{{{0, 0, 0}, {0, 0, 0}, {3, 0, 0}}, {{0, 1, 0}, {0, 1, 0}, {0, -1, 0}}};
  const std::vector<PointState> references{exact, later};
  std::vector<PointState> states = references;
  states[0].x[0][2] += 0.25;
  states[1].x[1][2] += 1.0;
  EXPECT_EQ(motion_errors(motion, states, references).x, std::sqrt(0.5 / 4.0) / 2.0);
  states[1].x.pop_back();
  EXPECT_THROW(motion_errors(motion, states, references), InputError);
  states.pop_back();
  EXPECT_THROW(motion_errors(motion, states, references), InputError);
}

TEST_F(ErrorNorms, PassOverOnePointInTwentyInTheirPercentile) {
  motion.network.mass.assign(40, 1.0);
  motion.network.fixed.assign(40, 0);
  exact.x.assign(40, {0, 0, 0});
  for (int i = 0; i < 40; ++i) exact.x[static_cast<std::size_t>(i)][0] = i;
  exact.v.assign(40, {0, 1, 0});
  found = exact;
  for (std::size_t i = 0; i < 40; ++i) found.x[i][2] = static_cast<double>(i + 1);
  EXPECT_EQ(errors().x_p95, 19.0);  // 38 of 40 are at most 38, and an edge is 2
  EXPECT_EQ(errors().x_largest, 20.0);
}

TEST_F(ErrorNorms, DoNotHideWhatIsNotANumber) {
  found.x[0][0] = std::numeric_limits<double>::quiet_NaN();
  MotionErrors e = errors();
  for (const double error : {e.x, e.x_p95, e.x_largest, e.energy, e.angular}) EXPECT_TRUE(std::isnan(error));
  found = exact;
  found.v[1][2] = std::numeric_limits<double>::quiet_NaN();
  e = errors();
  for (const double error : {e.v, e.energy, e.momentum, e.angular}) EXPECT_TRUE(std::isnan(error));
  EXPECT_EQ(e.x, 0.0);
}

TEST_F(ErrorNorms, OfNoPointsAreZero) {
  motion.network = {};
  motion.start = exact = found = {};
  const MotionErrors e = errors();
  for (const double error : {e.x, e.x_p95, e.x_largest, e.v, e.energy, e.momentum, e.angular}) EXPECT_EQ(error, 0.0);
}

TEST_F(ErrorNorms, OfABodyAtRestAreInfiniteOnceItMoves) {
  exact.v = {{0, 0, 0}, {0, 0, 0}};
  found = exact;
  EXPECT_EQ(errors().v, 0.0);
  found.v[0][0] = 0.5;
  EXPECT_TRUE(std::isinf(errors().v));
}

}  // namespace
}  // namespace dartboard::reference::error_norms_test
