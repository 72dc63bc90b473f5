#include "validation/statics/newton_matrices.h"

#include <gtest/gtest.h>

namespace dartboard::newton_matrices_test {
namespace {

// With the exact tangent residuals fall quadratically; projected, or warped, by a factor, where they fall.
TEST(NewtonRuns, AreShortestWithTheExactTangent) {
  const std::vector<NewtonRun> runs = newton_runs(2);
  ASSERT_EQ(runs.size(), 6u);
  for (std::size_t first : {0u, 3u}) {
    EXPECT_EQ(runs[first].matrix, NewtonRun::exact);
    EXPECT_EQ(runs[first + 1].matrix, NewtonRun::projected);
    EXPECT_EQ(runs[first + 2].matrix, NewtonRun::warped);
    EXPECT_LE(runs[first].iterations.value(), 10u);
    EXPECT_GT(runs[first + 1].iterations.value(), 2 * runs[first].iterations.value());
    EXPECT_NEAR(runs[first + 1].bent, runs[first].bent, 1e-7);
    EXPECT_EQ(runs[first + 2].traction, runs[first].traction);
  }
  EXPECT_EQ(runs[3].traction, 2.0 * runs[0].traction);
  EXPECT_GT(runs[2].iterations.value(), 2 * runs[0].iterations.value());
  EXPECT_NEAR(runs[2].bent, runs[0].bent, 1e-7);
  EXPECT_NEAR(runs[0].bent, 0.35, 0.02);
  EXPECT_NEAR(runs[3].bent, 0.6, 0.02);
  EXPECT_FALSE(runs[5].iterations);  // whole steps of warped stiffness diverge there
}

}  // namespace
}  // namespace dartboard::newton_matrices_test
