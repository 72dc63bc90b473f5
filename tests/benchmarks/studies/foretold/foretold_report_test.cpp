// What the audit of long motions concludes from its pairs.

#include "benchmarks/studies/foretold/foretold_report.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "tests/support/tables_for_tests.h"

namespace dartboard {
namespace {

ForetoldPair good_pair() {
  ForetoldPair p;
  p.scene = "a scene";
  p.floor = 1e-9;
  p.pick = "rk4";
  p.confidence = "asymptotic";
  p.setting = {.steps = 100};
  p.seen_part = 0.0125;
  p.audit = {.error = 1e-4,
             .actual_error = 5e-5,
             .predicted_error = 1e-4,
             .actual_cost = 440.0,
             .predicted_cost = 420.0,
             .actual_evaluations = 400.0,
             .predicted_evaluations = 400.0,
             .actual_s = 2.0,
             .predicted_s = 100.0,  // at another speed of the machine: not looked at
             .printed_s = 1.9,
             .pilot_s = 0.05,
             .best = "verlet",
             .best_cost = 400.0};
  return p;
}

std::vector<Verdict> verdicts(const std::vector<ForetoldPair>& pairs) {
  std::vector<Verdict> all;
  for (const Claim& claim : foretold_claims(pairs)) all.push_back(claim.verdict);
  return all;
}

constexpr Verdict yes = Verdict::holds, no = Verdict::falls_short, untold = Verdict::not_tested,
                  open = Verdict::undecided;

TEST(ForetoldPair, IsOneWhoseRunCostsTwentyTimesItsPilots) {
  ForetoldPair p = good_pair();
  p.audit.pilot_s = 0.1;
  EXPECT_TRUE(p.foretold());
  p.audit.pilot_s = 0.101;
  EXPECT_FALSE(p.foretold());
}

// Above 2 s pilots may take a tenth of the run, which a twentieth of it is: never more than the first rule allows.
TEST(ForetoldPair, HasPilotsOfTwoSecondsOrATenthOfTheRun) {
  ForetoldPair p = good_pair();
  p.audit.actual_s = 100.0;
  p.audit.pilot_s = 4.9;
  EXPECT_TRUE(p.foretold());
  p.audit.pilot_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(p.foretold());
}

// Without a miss, 72 pairs are enough to tell that 95 % are good: 0.025^(1/72) = 0.950.
TEST(ForetoldClaims, HoldWhenEverythingIsAsForetold) {
  EXPECT_EQ(verdicts(std::vector(72, good_pair())), (std::vector{yes, yes, yes, yes}));
  EXPECT_EQ(verdicts(std::vector(71, good_pair())), (std::vector{yes, open, open, yes}));
}

TEST(ForetoldClaims, FallShortOfFortyPairsThatAreNoPredictions) {
  std::vector<ForetoldPair> pairs(40, good_pair());
  pairs[7].audit.pilot_s = 0.2;
  EXPECT_EQ(verdicts(pairs)[0], no);
  EXPECT_EQ(verdicts(std::vector(10, good_pair()))[0], untold);
}

TEST(ForetoldClaims, GoByHowManyMissTheirErrorAndTheirSeconds) {
  std::vector<ForetoldPair> pairs(72, good_pair());
  pairs[0].audit.actual_error = 2e-4;
  pairs[1].audit.printed_s = 1.6;  // 20 % too little
  EXPECT_EQ(verdicts(pairs), (std::vector{yes, open, open, yes}));
  for (std::size_t k = 0; k < 12; ++k) {
    pairs[k].audit.actual_error = 2e-4;
    pairs[20 + k].audit.printed_s = 2.4;
  }
  EXPECT_EQ(verdicts(pairs), (std::vector{yes, no, no, yes}));
}

// What nobody has run says nothing; that it was left out is told.
TEST(ForetoldClaims, LeaveOutRunsThatAreTooLongToFollow) {
  std::vector<ForetoldPair> pairs(75, good_pair());
  for (std::size_t k = 0; k < 3; ++k) {
    pairs[k].pick.clear();
    pairs[k].followed = false;
  }
  const std::vector<Claim> claims = foretold_claims(pairs);
  EXPECT_EQ(claims[0].measured, "72 of 75 pairs; 3 too long to follow");
  EXPECT_EQ(claims[1].verdict, yes);
  EXPECT_NE(to_text(foretold_table(pairs)).find("not followed"), std::string::npos);
}

TEST(ForetoldClaims, NoRecommendationIsAMiss) {
  std::vector<ForetoldPair> pairs(72, good_pair());
  for (std::size_t k = 0; k < 12; ++k) pairs[k].pick.clear();
  EXPECT_EQ(verdicts(pairs)[1], no);
}

TEST(ForetoldClaims, WhatWasNoPredictionDoesNotCount) {
  std::vector<ForetoldPair> pairs(73, good_pair());
  pairs[0].audit.pilot_s = 1.0;
  pairs[0].audit.actual_error = 1.0;
  pairs[0].audit.printed_s = 100.0;
  EXPECT_EQ(verdicts(pairs), (std::vector{yes, yes, yes, yes}));
}

TEST(ForetoldClaims, ErrorsThatTheOtherCodesCannotTellSayNothing) {
  std::vector<ForetoldPair> pairs(73, good_pair());
  pairs[0].floor = 1e-3;
  pairs[0].audit.actual_error = 1.0;
  EXPECT_EQ(verdicts(pairs)[1], yes);
}

// Six of regret 1.5 beside five that missed, whose cost is that of another error.
TEST(ForetoldClaims, APickThatMissesItsErrorIsNotCheap) {
  std::vector<ForetoldPair> pairs(11, good_pair());
  for (std::size_t k = 0; k < 6; ++k) pairs[k].audit.actual_cost = 600.0;
  for (std::size_t k = 6; k < 11; ++k) {
    pairs[k].audit.actual_cost = 10.0;
    pairs[k].audit.actual_error = 1.0;
  }
  const Claim regret = foretold_claims(pairs)[3];
  EXPECT_EQ(regret.verdict, no);
  EXPECT_TRUE(regret.measured.starts_with("1.500, 6 pairs")) << regret.measured;
}

TEST(ForetoldTable, SaysWhatWasMetMissedAndNotJudged) {
  std::vector<ForetoldPair> pairs(5, good_pair());
  pairs[1].audit.actual_error = 2e-4;
  pairs[2].floor = 1e-3;
  pairs[3].audit.pilot_s = 1.0;
  pairs[4].pick.clear();
  const std::string table = to_text(foretold_table(pairs));
  for (const char* word :
       {"yes", "NO", "not judged", "not counted", "none", "0.500", "0.950", "40.0", "1.25 %", "1.10"})
    EXPECT_NE(table.find(word), std::string::npos) << word << '\n' << table;
  EXPECT_EQ(foretold_table(pairs).rows().size(), 5u);
}

TEST(ForetoldSample, HoldsEveryFigureOfAPair) {
  const nlohmann::json sample = json_of(good_pair());
  EXPECT_EQ(sample.at("printed_s"), 1.9);
  EXPECT_EQ(sample.at("actual_s"), 2.0);
  EXPECT_EQ(sample.at("pilot_s"), 0.05);
  EXPECT_EQ(sample.at("seen_part"), 0.0125);
  EXPECT_EQ(sample.at("actual_error"), 5e-5);
  EXPECT_EQ(sample.at("best_cost"), 400.0);
  EXPECT_EQ(sample.at("foretold"), true);
  EXPECT_EQ(sample.at("told"), true);
}

TEST(ForetoldPlot, HasAPointForEachPairThatCountsWithinThePicture) {
  std::vector<ForetoldPair> pairs(3, good_pair());
  pairs[1].audit.actual_error = 1.0;  // far above
  pairs[2].audit.pilot_s = 1.0;
  const Plot plot = foretold_plot(pairs, "");
  ASSERT_EQ(plot.series.size(), 2u);  // the line, and one method
  ASSERT_EQ(plot.series[1].points.size(), 2u);
  for (const auto& point : plot.series[1].points) {
    EXPECT_GT(point.y, plot.y_low);
    EXPECT_LT(point.y, plot.y_high);
    EXPECT_EQ(point.x, 0.0125);
  }
}

}  // namespace
}  // namespace dartboard
