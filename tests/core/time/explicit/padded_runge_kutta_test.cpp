#include "core/time/explicit/padded_runge_kutta.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>

#include "core/base/lanes.h"
#include "core/base/thread_team.h"
#include "core/time/explicit/classical_runge_kutta.h"
#include "tests/support/bodies/net_of_springs.h"

namespace dartboard::padded_runge_kutta_test {
namespace {

using Eigen::Vector3d;
constexpr double h = 1e-3;

/// A net that moves.
struct Moving {
  Net net;
  bool damped = true, viscous = true, held = true, pulled = true;

  SpringSystem system() const {
    SpringSystem made = net.system(damped ? SpringSpan(net.damped) : SpringSpan(net.undamped));
    if (!viscous) made.viscosity = {};
    if (!held) {
      made.fixed = {};
      made.held_axes = {};
    }
    if (!pulled) made.pull = {};
    return made;
  }
  StepResult step(Integrator& integrator) { return integrator.step(system(), {net.x, net.v}, h); }
};

::testing::AssertionResult same_bits(const Net& a, const Net& b) {
  const auto equal = [](const std::vector<Vector3d>& p, const std::vector<Vector3d>& q) {
    return std::memcmp(p.data(), q.data(), p.size() * sizeof(Vector3d)) == 0;
  };
  return equal(a.x, b.x) && equal(a.v, b.v) ? testing::AssertionSuccess() : testing::AssertionFailure();
}

class PaddedRows : public testing::Test {
 protected:
  void SetUp() override {
    use_lanes(true);
    if (!lanes_are_on()) GTEST_SKIP() << "this processor has no AVX2";
  }
  void TearDown() override {
    use_lanes(true);
    use_threads(1);
  }
  ClassicalRungeKutta padded_, by_threes_{false};
};

TEST_F(PaddedRows, HaveTheBitsOfRowsOfThreeWhateverActs) {
  for (unsigned what = 0; what < 16; ++what) {
    Moving body{Net(150, 1203), (what & 1) != 0, (what & 2) != 0, (what & 4) != 0, (what & 8) != 0};
    Moving other = body;
    ClassicalRungeKutta padded, by_threes(false);
    for (int k = 0; k < 3; ++k) {
      ASSERT_TRUE(body.step(padded).ok());
      ASSERT_TRUE(other.step(by_threes).ok());
    }
    EXPECT_TRUE(same_bits(body.net, other.net)) << "with what acts by the bits of " << what;
    EXPECT_EQ(padded.work().steps, by_threes.work().steps);
    EXPECT_NE(padded.bytes(), by_threes.bytes());
  }
}

TEST_F(PaddedRows, HaveTheSameBitsInSeveralThreads) {
  Moving body{Net()}, other = body;
  for (int k = 0; k < 2; ++k) ASSERT_TRUE(other.step(by_threes_).ok());
  use_threads(3);
  for (int k = 0; k < 2; ++k) ASSERT_TRUE(body.step(padded_).ok());
  EXPECT_TRUE(terms_of(body.system()).is_shared());
  EXPECT_TRUE(same_bits(body.net, other.net));
}

TEST_F(PaddedRows, FollowASystemThatChangesItsSize) {
  for (const std::uint32_t vertices : {150u, 90u, 170u}) {
    Moving body{Net(vertices, 1203)}, other = body;
    padded_.restart();
    by_threes_.restart();
    ASSERT_TRUE(body.step(padded_).ok());
    ASSERT_TRUE(other.step(by_threes_).ok());
    EXPECT_TRUE(same_bits(body.net, other.net)) << vertices << " vertices";
  }
}

TEST_F(PaddedRows, DiagnoseWhatIsNotFiniteAndLeaveTheMotionAsItWas) {
  for (const unsigned threads : {1u, 3u}) {
    use_threads(threads);
    Moving body{Net()};
    const Net before = body.net;
    body.net.v[1234].y() = std::numeric_limits<double>::max();
    const Net start = body.net;
    Moving other = body;
    padded_.restart();
    by_threes_.restart();
    const StepResult result = body.step(padded_), expected = other.step(by_threes_);
    EXPECT_EQ(result.code, StepCode::nonfinite);
    EXPECT_EQ(to_string(result), to_string(expected));
    EXPECT_TRUE(same_bits(body.net, start));
    EXPECT_EQ(padded_.work().failed_steps, by_threes_.work().failed_steps);
    // and nothing of it remains
    body.net = other.net = before;
    ASSERT_TRUE(body.step(padded_).ok());
    ASSERT_TRUE(other.step(by_threes_).ok());
    EXPECT_TRUE(same_bits(body.net, other.net));
  }
}

TEST_F(PaddedRows, DiagnoseEveryComponentOfPlacesAndVelocities) {
  for (const bool of_place : {true, false})
    for (int axis = 0; axis < 3; ++axis) {
      Moving body{Net(150, 1203)};
      body.net.add_vertex();
      // a sum over the stages overflows, and nothing else does
      (of_place ? body.net.v : body.net.pull).back()[axis] = std::numeric_limits<double>::max();
      Moving other = body;
      const StepResult result = body.step(padded_);
      EXPECT_EQ(result.quantity, of_place ? "position" : "velocity") << axis;
      EXPECT_EQ(to_string(result), to_string(other.step(by_threes_)));
      EXPECT_TRUE(same_bits(body.net, other.net));
    }
}

TEST_F(PaddedRows, AreForSpringsAloneAndForLanes) {
  const Moving body{Net(150, 1203)};
  SpringSystem system = body.system();
  EXPECT_TRUE(PaddedRungeKutta::can_step(system));
  use_lanes(false);
  EXPECT_FALSE(PaddedRungeKutta::can_step(system));
  use_lanes(true);
  const ForceTerm* none = nullptr;
  system.terms = ForceTerms(&none, 1);
  EXPECT_FALSE(PaddedRungeKutta::can_step(system));
}

TEST_F(PaddedRows, TakeMemoryInPlaceOfRowsOfThree) {
  Moving body{Net(150, 1203)};
  ASSERT_TRUE(body.step(padded_).ok());
  EXPECT_EQ(padded_.bytes(), 150 * 5 * sizeof(PaddedVector));
  use_lanes(false);
  ASSERT_TRUE(body.step(padded_).ok());
  EXPECT_EQ(padded_.bytes(), 150 * 5 * sizeof(Vector3d));
  use_lanes(true);
  ASSERT_TRUE(body.step(padded_).ok());
  EXPECT_EQ(padded_.bytes(), 150 * 5 * sizeof(PaddedVector));
}

}  // namespace
}  // namespace dartboard::padded_runge_kutta_test
