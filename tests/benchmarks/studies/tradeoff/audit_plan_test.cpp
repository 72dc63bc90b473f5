// What an audit of `recommend` draws.

#include "benchmarks/studies/tradeoff/audit_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace dartboard {
namespace {

std::vector<AuditCase> quick_cases(std::uint64_t seed) {
  AuditCases cases(seed, true);
  std::vector<AuditCase> all;
  for (std::uint64_t k = 0; k < cases.size(); ++k) all.push_back(cases.next());
  return all;
}

const std::vector<Eigen::Vector3d>& start_of(const AuditCase& drawn) { return drawn.scene.motion.start.x; }

TEST(AuditSweep, GoesBeyondTheDearestPickByMoreThanOneHalvingAndHasTimeForTheShortest) {
  EXPECT_GT(longest_sweep_run(1.0), 2.0);
  EXPECT_LT(longest_sweep_run(1.0), 4.0);
  EXPECT_DOUBLE_EQ(longest_sweep_run(10.0), 10.0 * longest_sweep_run(1.0));
  EXPECT_GT(longest_sweep_run(0.0), 0.0);
  EXPECT_LT(longest_sweep_run(0.0), 0.1);
}

TEST(AuditCases, AreTheSameForTheSameSeed) {
  const auto once = quick_cases(5), again = quick_cases(5);
  for (std::size_t k = 0; k < once.size(); ++k) {
    EXPECT_EQ(start_of(once[k]), start_of(again[k])) << k;
    EXPECT_EQ(once[k].errors, again[k].errors) << k;
  }
}

TEST(AuditCases, AreOtherScenesAndOtherErrorsForAnotherSeed) {
  const auto one = quick_cases(5), other = quick_cases(6);
  for (std::size_t k = 0; k < one.size(); ++k) {
    EXPECT_NE(start_of(one[k]), start_of(other[k])) << k;
    EXPECT_NE(one[k].errors, other[k].errors) << k;
  }
}

TEST(AuditCases, AreAllDifferent) {
  const auto all = quick_cases(5);
  std::set<std::vector<double>> errors;
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_TRUE(errors.insert(all[k].errors).second) << k;
    for (std::size_t other = 0; other < k; ++other) EXPECT_NE(start_of(all[k]), start_of(all[other])) << k;
  }
}

TEST(AuditCases, AskForErrorsOfEverySizeBetweenAHundredthAndAHundredMillionth) {
  for (const AuditCase& drawn : quick_cases(5)) {
    ASSERT_EQ(drawn.errors.size(), 2u);
    // one in each half of the decades
    EXPECT_LE(drawn.errors[0], 1e-2);
    EXPECT_GT(drawn.errors[0], 0.99e-5);
    EXPECT_LE(drawn.errors[1], 1.01e-5);
    EXPECT_GT(drawn.errors[1], 0.99e-8);
  }
}

}  // namespace
}  // namespace dartboard
