// The conclusions on steps of changed bodies: with one wrong figure, the claim about it falls short.

#include "benchmarks/studies/step/changed_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "benchmarks/studies/step/step_bodies.h"
#include "tests/support/claims_for_tests.h"
#include "tests/support/timings_for_tests.h"

namespace dartboard::changed_report_test {
namespace {

using Ids = std::vector<std::string>;
const std::string medium = step_box(100'000, false), large = step_box(1'000'000, false);

/// Changed bodies that take 1.1 of a fresh one.
ChangedCosts good_costs(const std::vector<std::string>& bodies = {medium, large}, int processes = 7) {
  ChangedCosts c;
  std::vector<std::pair<std::string, double>> times;
  for (const std::string& body : bodies)
    for (const double amount : {0.1, 0.5}) {
      ChangedCase one;
      one.body = body;
      one.kind = "cuts";
      one.changed = body + std::to_string(amount);
      one.asked = amount;
      one.reached = amount + 0.001;
      one.springs = 1000;
      one.steps = 2;
      times.emplace_back(one.changed + changed_task::changed, 11e6);
      times.emplace_back(one.changed + changed_task::fresh, 10e6);
      c.cases.push_back(one);
    }
  c.samples = timed_samples(times, processes);
  return c;
}

std::vector<Claim> claims_with(const std::function<void(ChangedCosts&)>& spoil) {
  ChangedCosts c = good_costs();
  spoil(c);
  return claims_of(c);
}

/// The changed body of a case takes so long in some processes.
void set_time(ChangedCosts& c, std::size_t of, double ns, int processes = 7) {
  for (Sample& s : c.samples)
    if (s.task == c.cases[of].changed + changed_task::changed && s.process < processes) s.cpu_ns = std::llround(ns);
}

TEST(ChangedClaims, HoldWhenEverythingIsAsPromised) {
  const auto claims = claims_of(good_costs());
  EXPECT_EQ(ids_of(claims, Verdict::holds),
            (Ids{"step-changed-agreement", "step-changed-medium", "step-changed-large"}));
  expect_words(claims, "step-changed-large", "<= 1.15 for each", "1.100, the largest of 2",
               "[1.1, 1.1] at 98.4 % for 10 % cuts");
}

TEST(ChangedClaims, FallShortOfOneChangeAfterWhichStepsTakeLonger) {
  const std::pair<std::size_t, const char*> cases[]{{0, "step-changed-medium"}, {3, "step-changed-large"}};
  for (const auto& [of, id] : cases) {
    const auto claims = claims_with([of = of](ChangedCosts& c) { set_time(c, of, 11.6e6); });
    EXPECT_EQ(ids_of(claims, Verdict::falls_short), Ids{id});
    EXPECT_EQ(find_claim(claims, id).measured, "1.160, the largest of 2");
    EXPECT_EQ(
        find_claim(claims, id).reason,
        "until a sixteenth is scattered, what changes add lies at the end of the columns, and what was last in the gaps "
        "of what they remove");
  }
}

TEST(ChangedClaims, AreUndecidedWhereTheIntervalLiesOnBothSides) {
  const auto claims = claims_with([](ChangedCosts& c) { set_time(c, 3, 12e6, 2); });
  EXPECT_EQ(ids_of(claims, Verdict::undecided), Ids{"step-changed-large"});
}

// As in a quick run: no body of a million, and three processes, all alike, which cannot predict others.
TEST(ChangedClaims, AreNotJudgedByAQuickRun) {
  const auto claims = claims_of(good_costs({medium}, 3));
  EXPECT_EQ(ids_of(claims, Verdict::undecided), Ids{"step-changed-medium"});
  EXPECT_EQ(ids_of(claims, Verdict::not_tested), Ids{"step-changed-large"});
}

TEST(ChangedClaims, AreNotTestedWhereBodiesDiffer) {
  const std::function<void(ChangedCosts&)> wrongs[]{[](ChangedCosts& c) { c.cases[3].differing = 1; },
                                                    [](ChangedCosts& c) { c.cases.clear(); }};
  for (const auto& wrong : wrongs) {
    const auto claims = claims_with(wrong);
    EXPECT_EQ(ids_of(claims, Verdict::falls_short), Ids{"step-changed-agreement"});
    EXPECT_EQ(ids_of(claims, Verdict::not_tested), (Ids{"step-changed-medium", "step-changed-large"}));
  }
}

TEST(ChangedTable, HasARowForEachChange) {
  const auto rows = changed_table(good_costs()).rows();
  ASSERT_EQ(rows.size(), 4u);
  // 11 and 10 ms for two steps of four evaluations of 1000 springs
  EXPECT_EQ(rows[1], (std::vector<std::string>{medium, "cuts", "50.1", "0", "1000", "1375.00", "1250.00", "1.100",
                                               "[1.1, 1.1] at 98.4 %"}));
}

}  // namespace
}  // namespace dartboard::changed_report_test
