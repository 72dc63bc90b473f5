// Scenes and errors drawn by an audit of `recommend`.

#include "benchmarks/studies/tradeoff/audit_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

#include "benchmarks/checkout/source_folder.h"

namespace dartboard::audit_plan_test {
namespace {

std::vector<AuditCase> quick_cases(AuditKind kind, std::uint64_t seed) {
  AuditCases cases(kind, seed, true);
  std::vector<AuditCase> all;
  for (std::uint64_t k = 0; k < cases.size(); ++k) all.push_back(cases.next());
  return all;
}

constexpr AuditKind kinds[]{AuditKind::scenes, AuditKind::long_motions};

std::pair<std::string, double> start_of(const AuditCase& drawn) { return {drawn.scene.what, drawn.scene.duration}; }

TEST(AuditSweep, GoesBeyondTheDearestPickByMoreThanOneHalvingAndHasTimeForTheShortest) {
  EXPECT_GT(longest_sweep_run(1.0), 2.0);
  EXPECT_LT(longest_sweep_run(1.0), 4.0);
  EXPECT_DOUBLE_EQ(longest_sweep_run(10.0), 10.0 * longest_sweep_run(1.0));
  EXPECT_GT(longest_sweep_run(0.0), 0.0);
  EXPECT_LT(longest_sweep_run(0.0), 0.1);
}

TEST(AuditCases, AreTheSameForTheSameSeedAndOthersForAnother) {
  for (const AuditKind kind : kinds) {
    const auto once = quick_cases(kind, 5), again = quick_cases(kind, 5), other = quick_cases(kind, 6);
    ASSERT_FALSE(once.empty());
    for (std::size_t k = 0; k < once.size(); ++k) {
      EXPECT_EQ(start_of(once[k]), start_of(again[k])) << k;
      EXPECT_EQ(once[k].errors, again[k].errors) << k;
      EXPECT_NE(start_of(once[k]), start_of(other[k])) << k;
      EXPECT_NE(once[k].errors, other[k].errors) << k;
    }
  }
}

TEST(AuditCases, AreAllDifferent) {
  const auto all = quick_cases(AuditKind::scenes, 5);
  std::set<std::vector<double>> errors;
  for (std::size_t k = 0; k < all.size(); ++k) {
    EXPECT_TRUE(errors.insert(all[k].errors).second) << k;
    for (std::size_t other = 0; other < k; ++other) EXPECT_NE(start_of(all[k]), start_of(all[other])) << k;
  }
}

/// One in each of `parts` equal parts of the decades between two bounds.
void expect_errors(const std::vector<double>& errors, std::size_t parts, double largest, double smallest) {
  ASSERT_EQ(errors.size(), parts);
  const auto bound = [&](std::size_t k) {
    return largest * std::pow(smallest / largest, static_cast<double>(k) / static_cast<double>(parts));
  };
  for (std::size_t k = 0; k < parts; ++k) {
    EXPECT_LE(errors[k], 1.01 * bound(k)) << k;
    EXPECT_GE(errors[k], 0.99 * bound(k + 1)) << k;
  }
}

TEST(AuditCases, AskForErrorsOfEverySizeBetweenTheirBounds) {
  for (const AuditCase& drawn : quick_cases(AuditKind::scenes, 5)) expect_errors(drawn.errors, 2, 1e-2, 1e-5);
  for (const AuditCase& drawn : quick_cases(AuditKind::long_motions, 5)) expect_errors(drawn.errors, 5, 3e-5, 3e-7);
}

TEST(AuditCases, EndWithThoseOfTheGallery) {
  const auto file = source_folder() / "benchmarks/scenes/vertex_tear.json";
  AuditCases cases(AuditKind::scenes, 5, true, {file});
  ASSERT_EQ(cases.size(), 3u);
  cases.next();
  cases.next();
  const AuditCase last = cases.next();
  EXPECT_EQ(last.scene.name, "vertex_tear");
  EXPECT_EQ(last.check, AuditCheck::reference);
  EXPECT_EQ(last.budget_s, 0.0);
  expect_errors(last.errors, 2, 1e-2, 1e-5);
}

TEST(AuditCases, LimitPilotsThatAreWholeRunsOfTheGallery) {
  AuditCases cases(AuditKind::scenes, 5, true, {source_folder() / "benchmarks/scenes/balls_roll.json"});
  cases.next();
  cases.next();
  EXPECT_GT(cases.next().budget_s, 0.0);
}

TEST(AuditCases, OfLongMotionsHaveNoEventsAndAreMoreThanFortyPairs) {
  for (const AuditCase& drawn : quick_cases(AuditKind::long_motions, 5)) {
    EXPECT_TRUE(drawn.scene.motion.events.empty());
    EXPECT_EQ(drawn.check, AuditCheck::reference_and_sweep);
    EXPECT_GT(drawn.budget_s, 0.0);
    EXPECT_LE(drawn.budget_s, 2.0);
  }
  EXPECT_GE(5 * AuditCases(AuditKind::long_motions, 1, false).size(), 40u);
}

}  // namespace
}  // namespace dartboard::audit_plan_test
