#include "benchmarks/audit_report.h"

#include <gtest/gtest.h>

#include <limits>

namespace dartboard {
namespace {

AuditedPair good_pair() {
  AuditedPair p;
  p.scene = "a scene";
  p.reference = "certified";
  p.floor = 1e-12;
  p.pick = "rk4";
  p.confidence = "asymptotic";
  p.setting = {.steps = 100};
  p.swept = true;
  p.audit = {.error = 1e-4,
             .actual_error = 5e-5,
             .predicted_error = 6e-5,
             .actual_cost = 440.0,
             .predicted_cost = 420.0,
             .actual_evaluations = 400.0,
             .predicted_evaluations = 400.0,
             .actual_s = 6.0,
             .predicted_s = 5.5,
             .pilot_s = 0.6,
             .best = "verlet",
             .best_cost = 400.0};
  return p;
}

std::vector<Verdict> verdicts(const std::vector<AuditedPair>& pairs) {
  std::vector<Verdict> all;
  for (const Claim& claim : audit_claims(pairs)) all.push_back(claim.verdict);
  return all;
}

constexpr Verdict yes = Verdict::holds, no = Verdict::falls_short, untold = Verdict::not_tested;

TEST(AuditClaims, HoldWhenEverythingIsAsPromised) {
  EXPECT_EQ(verdicts(std::vector(20, good_pair())), (std::vector{yes, yes, yes, yes, yes}));
}

TEST(AuditClaims, AllowOneMissInTwentyAndNotTwo) {
  std::vector<AuditedPair> pairs(20, good_pair());
  pairs[3].audit.actual_error = 2e-4;
  pairs[4].audit.predicted_evaluations = 470.0;  // 17.5 % too many
  pairs[5].audit.predicted_s = 5.0;              // 16.7 % too few
  EXPECT_EQ(verdicts(pairs), (std::vector{yes, yes, yes, yes, yes}));
  pairs[6] = pairs[3];
  pairs[7] = pairs[4];
  pairs[8] = pairs[5];
  EXPECT_EQ(verdicts(pairs), (std::vector{no, no, no, yes, yes}));
}

TEST(AuditClaims, ANumberThatIsNoneIsAMiss) {
  std::vector<AuditedPair> pairs(1, good_pair());
  pairs[0].audit.actual_error = pairs[0].audit.predicted_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(verdicts(pairs), (std::vector{no, yes, no, untold, yes}));
}

TEST(AuditClaims, NoRecommendationIsAMiss) {
  std::vector<AuditedPair> pairs(2, good_pair());
  pairs[0].pick.clear();
  EXPECT_EQ(verdicts(pairs)[0], no);
}

TEST(AuditClaims, PairsBelowTheFloorOfTheReferenceSayNothingAboutErrors) {
  std::vector<AuditedPair> pairs(2, good_pair());
  pairs[0].floor = 1e-3;
  pairs[0].audit.actual_error = 5e-4;
  EXPECT_EQ(verdicts(pairs)[0], yes);
}

// Eleven good picks of regret 1.4, and nine that cost next to nothing because they missed, or nobody knows.
TEST(AuditClaims, APickThatMissesItsErrorIsNotCheap) {
  std::vector<AuditedPair> pairs(20, good_pair());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    Audit& a = pairs[k].audit;
    a.actual_cost = k < 9 ? 40.0 : 1.4 * a.best_cost;
    if (k < 5)
      a.actual_error = 2.0 * a.error;
    else if (k < 9)
      pairs[k].floor = 10.0 * a.error;
  }
  const Claim regret = audit_claims(pairs)[3];
  EXPECT_EQ(regret.verdict, no);
  EXPECT_EQ(regret.measured, "1.400, 11 pairs; 9 left out, whose error was missed or cannot be told");
  pairs.resize(9);
  EXPECT_EQ(audit_claims(pairs)[3].verdict, untold);
}

TEST(AuditClaims, OnlyLongRunsTellOfThePilots) {
  std::vector<AuditedPair> pairs(3, good_pair());
  for (AuditedPair& p : pairs) p.audit.actual_s = 1.0;
  EXPECT_EQ(verdicts(pairs)[4], untold);
  pairs[1].audit.actual_s = 5.5;
  pairs[1].audit.pilot_s = 1.2;  // 22 %
  pairs[2].audit.actual_s = 6.0;
  pairs[2].audit.pilot_s = 0.6;
  EXPECT_EQ(verdicts(pairs)[4], no);
}

TEST(AuditTable, HasARowForEachPair) { EXPECT_EQ(audit_table(std::vector(3, good_pair())).rows().size(), 3u); }

TEST(AuditTable, SaysOfAPairThatCannotBeJudgedNothingThatLooksLikeAJudgement) {
  std::vector<AuditedPair> pairs(3, good_pair());
  pairs[0].floor = 10.0;  // of a chaotic scene: two references are as far apart as that
  pairs[0].audit.actual_error = 2.8;
  pairs[1].floor = std::numeric_limits<double>::infinity();
  pairs[1].audit.actual_error = std::numeric_limits<double>::quiet_NaN();
  const Table table = audit_table(pairs);
  EXPECT_EQ(table.rows()[0][3], "-");
  EXPECT_EQ(table.rows()[0][4], "not judged: the reference is no better than that");
  EXPECT_EQ(table.rows()[1][3], "-");
  EXPECT_EQ(table.rows()[1][4], "not judged: followed for its cost only");
  EXPECT_EQ(table.rows()[2][3], "0.500");
  for (const auto& row : table.rows())
    for (const std::string& cell : row) EXPECT_EQ(cell.find("nan"), std::string::npos) << cell;
}

TEST(AuditPlot, PlacesEachPairByWhatItPromised) {
  std::vector<AuditedPair> pairs(2, good_pair());
  pairs[1].pick = "verlet";
  const Plot plot = audit_plot(pairs, "");
  const PlotSeries& last = plot.series.back();
  EXPECT_EQ(last.title, "verlet");
  ASSERT_EQ(last.points.size(), 1u);
  EXPECT_DOUBLE_EQ(last.points[0].x, 5.5 / 6.0);
  EXPECT_DOUBLE_EQ(last.points[0].y, 0.5);
}

}  // namespace
}  // namespace dartboard
