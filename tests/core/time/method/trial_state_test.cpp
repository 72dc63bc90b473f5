#include "core/time/method/trial_state.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace dartboard::trial_state_test {
namespace {

using Eigen::Vector3d;

constexpr double huge = std::numeric_limits<double>::max();
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

// 3 to 33 numbers in a column: none to four blocks of eight, and every remainder.
TEST(CheckFinite, FindsTheFirstNumberThatIsNone) {
  for (std::size_t n = 1; n <= 11; ++n)
    for (std::size_t bad = 0; bad < n; ++bad)
      for (int axis = 0; axis < 3; ++axis)
        for (const double value : {infinity, -infinity, no_number, -no_number}) {
          TrialState state{std::vector(n, Vector3d(1, -huge, 0)), std::vector(n, Vector3d(huge, -0.0, 5e-324))};
          ASSERT_TRUE(check_finite(state.x, state.v).ok());
          state.v[bad][axis] = value;
          StepResult result = check_finite(state.x, state.v);
          EXPECT_EQ(result.code, StepCode::nonfinite);
          EXPECT_EQ(result.number, bad);
          EXPECT_EQ(result.quantity, "velocity");
          state.x[bad][axis] = value;
          result = check_finite(state.x, state.v);
          EXPECT_EQ(result.code, StepCode::nonfinite);
          EXPECT_EQ(result.number, bad);
          EXPECT_EQ(result.quantity, "position");
        }
}

TEST(CheckFinite, FindsNothingInNothing) { EXPECT_TRUE(check_finite({}, {}).ok()); }

TEST(TrialState, IsCommittedWholeOrNotAtAll) {
  std::vector<Vector3d> x(2, Vector3d(1, 2, 3)), v(2, Vector3d(4, 5, 6));
  TrialState state{{{0, 0, 0}, {0, 0, 1}}, {{7, 7, 7}, {7, 7, 8}}};
  WorkCounters work;
  EXPECT_TRUE(state.commit({x, v}, work).ok());
  EXPECT_EQ(x, state.x);
  EXPECT_EQ(v, state.v);
  const auto kept = v;
  state.x[0][0] = 9;
  state.v[1][2] = no_number;
  EXPECT_FALSE(state.commit({x, v}, work).ok());
  EXPECT_EQ(x[0][0], 0);
  EXPECT_EQ(v, kept);
  EXPECT_EQ(work.steps, 1u);
  EXPECT_EQ(work.failed_steps, 1u);
}

TEST(StepResult, IsWrittenWithItsWitness) {
  EXPECT_EQ(to_string(StepResult{}), "OK");
  EXPECT_EQ(to_string(StepResult{StepCode::nonfinite, Witness::vertex, 12, "velocity", -infinity}),
            "NONFINITE at vertex 12: velocity = -inf");
  EXPECT_EQ(to_string(StepResult{StepCode::zero_length, Witness::edge, 3, "length", 0.0}),
            "ZERO_LENGTH at edge 3: length = 0");
  EXPECT_EQ(to_string(StepResult{StepCode::newton_stalled, Witness::none, 0, "residual", 0.5}),
            "NEWTON_STALLED: residual = 0.5");
}

TEST(StepCode, HasANameOfItsOwn) {
  std::vector<std::string_view> names;
  for (int code = 0; code <= static_cast<int>(StepCode::budget); ++code) {
    const auto name = to_string(static_cast<StepCode>(code));
    EXPECT_NE(name, "?");
    for (const auto other : names) EXPECT_NE(name, other);
    names.push_back(name);
  }
}

}  // namespace
}  // namespace dartboard::trial_state_test
