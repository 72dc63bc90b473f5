// The conclusions on bodies that change in every step: with one wrong figure, the claim about it falls short.

#include "benchmarks/studies/step/changing_report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "benchmarks/studies/step/step_bodies.h"
#include "tests/support/claims_for_tests.h"
#include "tests/support/timings_for_tests.h"

namespace dartboard::changing_report_test {
namespace {

using namespace changing_task;
using Ids = std::vector<std::string>;
const std::string liver = paper_step_body(true), large = step_box(1'000'000, false);

/// A graph of 10 ms, steps of 4 ms alone and 4.4 ms with a dissociation.
ChangingCosts good_costs(const std::vector<std::string>& bodies = {liver, large}, int processes = 7) {
  ChangingCosts c;
  std::vector<std::pair<std::string, double>> times;
  for (const std::string& body : bodies) {
    c.bodies.push_back({.changing = body, .tetrahedra = 6, .springs = 19, .steps = 2});
    times.emplace_back(body + followed, 4.4e6);
    times.emplace_back(body + alone, 4e6);
    times.emplace_back(body + ends_anew, 5.5e6);
    times.emplace_back(body + all_anew, 6.6e6);
    times.emplace_back(body + naive, 10e6);
  }
  c.samples = timed_samples(times, processes);
  return c;
}

std::vector<Claim> claims_with(const std::function<void(ChangingCosts&)>& spoil) {
  ChangingCosts c = good_costs();
  spoil(c);
  return claims_of(c);
}

void set_time(ChangingCosts& c, const std::string& task, double ns, int processes = 7) {
  for (Sample& s : c.samples)
    if (s.task == task && s.process < processes) s.cpu_ns = std::llround(ns);
}

TEST(ChangingClaims, HoldWhenEverythingIsAsPromised) {
  const auto claims = claims_of(good_costs());
  EXPECT_EQ(ids_of(claims, Verdict::holds),
            (Ids{"step-changing-agreement", "step-changing-liver", "step-changing-large"}));
  expect_words(claims, "step-changing-large", "<= 0.5", "0.440", "[0.44, 0.44] at 98.4 %");
}

TEST(ChangingClaims, ReportTheGainOfFollowingWithoutATarget) {
  const auto claims = claims_of(good_costs());
  EXPECT_EQ(ids_of(claims, Verdict::not_tested), Ids{"step-changing-anew"});
  expect_words(claims, "step-changing-anew", "none; published 1.37 to 1.61", "1.50 / 1.50",
               "[1.5, 1.5] at 98.4 % / [1.5, 1.5] at 98.4 %");
}

TEST(ChangingClaims, FallShortOfStepsThatTakeLongerThanTheirShareOfTheGraph) {
  const auto slow = [](const std::string& body, double share) {
    return ids_of(claims_with([&](ChangingCosts& c) { set_time(c, body + followed, 10e6 * share); }),
                  Verdict::falls_short);
  };
  EXPECT_EQ(slow(liver, 0.59), Ids{"step-changing-liver"});
  EXPECT_EQ(slow(large, 0.51), Ids{"step-changing-large"});
}

TEST(ChangingClaims, AreUndecidedWhereTheIntervalLiesOnBothSides) {
  const auto claims = claims_with([](ChangingCosts& c) { set_time(c, large + followed, 5.1e6, 2); });
  EXPECT_EQ(ids_of(claims, Verdict::undecided), Ids{"step-changing-large"});
}

// As in a quick run: no body of a million, and three processes, all alike, which cannot predict others.
TEST(ChangingClaims, AreNotJudgedByAQuickRun) {
  const auto claims = claims_of(good_costs({liver}, 3));
  EXPECT_EQ(ids_of(claims, Verdict::undecided), Ids{"step-changing-liver"});
  EXPECT_EQ(ids_of(claims, Verdict::not_tested), (Ids{"step-changing-large", "step-changing-anew"}));
}

TEST(ChangingClaims, AreNotTestedWhereTheMotionsDoNotAgree) {
  const auto other_bits = [](const char* task) {
    return [task](ChangingCosts& c) {
      for (Sample& s : c.samples)
        if (s.task == large + task && s.process == 6) s.hash = 1;
    };
  };
  const std::function<void(ChangingCosts&)> wrongs[]{[](ChangingCosts& c) { c.bodies[1].differing = 1; },
                                                     [](ChangingCosts& c) { c.bodies.clear(); }, other_bits(followed),
                                                     other_bits(ends_anew), other_bits(all_anew)};
  for (const auto& wrong : wrongs) {
    const auto claims = claims_with(wrong);
    EXPECT_EQ(ids_of(claims, Verdict::falls_short), Ids{"step-changing-agreement"});
    EXPECT_EQ(ids_of(claims, Verdict::not_tested),
              (Ids{"step-changing-liver", "step-changing-large", "step-changing-anew"}));
  }
}

TEST(ChangingTable, HasARowForEachBody) {
  const auto rows = changing_table(good_costs()).rows();
  ASSERT_EQ(rows.size(), 2u);
  const std::string at = " at 98.4 %";
  EXPECT_EQ(rows[0], (std::vector<std::string>{liver, "6", "2000.0", "1.100", "[1.1, 1.1]" + at, "0.440",
                                               "[0.44, 0.44]" + at, "1.25", "1.50", "[1.5, 1.5]" + at}));
}

}  // namespace
}  // namespace dartboard::changing_report_test
