// What the audit of long motions draws.

#include "benchmarks/studies/foretold/foretold_plan.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dartboard {
namespace {

std::vector<ForetoldCase> cases_of(std::uint64_t seed) {
  ForetoldCases cases(seed, true);
  std::vector<ForetoldCase> all;
  for (std::uint64_t k = 0; k < cases.size(); ++k) all.push_back(cases.next());
  return all;
}

TEST(ForetoldCases, AreTheSameForTheSameSeedAndOthersForAnother) {
  const auto once = cases_of(5), again = cases_of(5), other = cases_of(6);
  ASSERT_FALSE(once.empty());
  for (std::size_t k = 0; k < once.size(); ++k) {
    EXPECT_EQ(once[k].scene.motion.start.x, again[k].scene.motion.start.x) << k;
    EXPECT_EQ(once[k].errors, again[k].errors) << k;
    EXPECT_NE(once[k].scene.motion.start.x, other[k].scene.motion.start.x) << k;
    EXPECT_NE(once[k].errors, other[k].errors) << k;
  }
}

TEST(ForetoldCases, AskForErrorsOfEverySizeBetweenTheirBounds) {
  for (const ForetoldCase& drawn : cases_of(5)) {
    ASSERT_EQ(drawn.errors.size(), 5u);
    // one in each fifth of the decades between 3e-5 and 3e-7
    for (int k = 0; k < 5; ++k) {
      EXPECT_LE(drawn.errors[static_cast<std::size_t>(k)], 1.01 * 3e-5 * std::pow(10.0, -2.0 * k / 5.0)) << k;
      EXPECT_GE(drawn.errors[static_cast<std::size_t>(k)], 0.99 * 3e-5 * std::pow(10.0, -2.0 * (k + 1) / 5.0)) << k;
    }
  }
}

TEST(ForetoldCases, HaveNoEventsAndAreMoreThanFortyPairs) {
  for (const ForetoldCase& drawn : cases_of(5)) EXPECT_TRUE(drawn.scene.motion.events.empty());
  const ForetoldCases full(1, false);
  EXPECT_GE(5 * full.size(), 40u);
  EXPECT_LE(full.budget_s(), 2.0);
}

}  // namespace
}  // namespace dartboard
