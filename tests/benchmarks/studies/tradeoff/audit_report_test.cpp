#include "benchmarks/studies/tradeoff/audit_report.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "tests/support/tables_for_tests.h"

namespace dartboard::audit_report_test {
namespace {

constexpr AuditKind scenes = AuditKind::scenes, long_motions = AuditKind::long_motions;

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
             .largest_error = 1.5e-4,
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

/// A run of 2 s; the pilots saw an eightieth of its motion.
AuditedPair good_prediction() {
  AuditedPair p = good_pair();
  p.seen_part = 0.0125;
  p.audit.actual_s = 2.0;
  p.audit.predicted_s = 100.0;  // at another speed of the machine: not used
  p.audit.printed_s = 1.9;
  p.audit.pilot_s = 0.05;
  return p;
}

std::vector<Verdict> verdicts(const std::vector<AuditedPair>& pairs, AuditKind kind = scenes) {
  std::vector<Verdict> all;
  for (const Claim& claim : audit_claims(kind, pairs)) all.push_back(claim.verdict);
  return all;
}

constexpr Verdict yes = Verdict::holds, no = Verdict::falls_short, untested = Verdict::not_tested,
                  open = Verdict::undecided;

TEST(AuditClaims, HoldWhenEverythingIsAsPromised) {
  EXPECT_EQ(verdicts(std::vector(80, good_pair())), (std::vector{yes, yes, yes, yes, yes}));
}

// By Clopper and Pearson: 0.025^(1/n) reaches 95 % at n = 72.
TEST(AuditClaims, NeedSeventyTwoPairsWithoutAMiss) {
  EXPECT_EQ(verdicts(std::vector(71, good_pair())), (std::vector{open, open, open, yes, yes}));
  EXPECT_EQ(verdicts(std::vector(72, good_pair())), (std::vector{yes, yes, yes, yes, yes}));
}

void miss_each_promise(std::vector<AuditedPair>& pairs, std::size_t times) {
  for (std::size_t k = 0; k < times; ++k) {
    pairs[3 * k].audit.actual_error = 2e-4;
    pairs[3 * k + 1].audit.predicted_evaluations = 470.0;  // 17.5 % too many
    pairs[3 * k + 2].audit.predicted_s = 5.0;              // 16.7 % too few
  }
}

// Of 200 pairs: the chance of 3 misses or fewer at a share of 5 % is 0.9 %, of 15 or more 7.0 %, of 18 or more 1.3 %.
TEST(AuditClaims, GoByTheSharesThatCouldBeWhatTheyShow) {
  for (const auto& [misses, verdict] : {std::pair(3u, yes), {15u, open}, {18u, no}}) {
    std::vector<AuditedPair> pairs(200, good_pair());
    miss_each_promise(pairs, misses);
    EXPECT_EQ(verdicts(pairs), (std::vector{verdict, verdict, verdict, yes, yes})) << misses;
  }
}

TEST(AuditClaims, ANumberThatIsNoneIsAMiss) {
  std::vector<AuditedPair> pairs(4, good_pair());
  for (AuditedPair& p : pairs) p.audit.actual_error = p.audit.predicted_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(verdicts(pairs), (std::vector{no, open, no, untested, yes}));
}

TEST(AuditClaims, NoRecommendationIsAMiss) {
  std::vector<AuditedPair> pairs(4, good_pair());
  for (AuditedPair& p : pairs) p.pick.clear();
  EXPECT_EQ(verdicts(pairs)[0], no);
  pairs.assign(72, good_prediction());
  for (std::size_t k = 0; k < 12; ++k) pairs[k].pick.clear();
  EXPECT_EQ(verdicts(pairs, long_motions)[1], no);
}

TEST(AuditClaims, PairsBelowTheFloorOfTheReferenceSayNothingAboutErrors) {
  std::vector<AuditedPair> pairs(82, good_pair());
  for (std::size_t k = 0; k < 10; ++k) {
    pairs[k].floor = 1e-3;
    pairs[k].audit.actual_error = 5e-4;
  }
  EXPECT_EQ(verdicts(pairs)[0], yes);
}

// Ten of twenty at 1.1 and ten at 1.4: the median is 1.25, and the interval from 1.1 to 1.4 decides nothing.
TEST(AuditClaims, AMedianOfRegretsDoesNotDecide) {
  std::vector<AuditedPair> pairs(20, good_pair());
  for (std::size_t k = 0; k < 10; ++k) pairs[k].audit.actual_cost = 1.4 * pairs[k].audit.best_cost;
  EXPECT_EQ(verdicts(pairs)[3], open);
  for (std::size_t k = 10; k < 15; ++k) pairs[k].audit.actual_cost = 1.4 * pairs[k].audit.best_cost;
  EXPECT_EQ(verdicts(pairs)[3], no);  // the sixth of twenty is 1.4
}

// Eleven good picks of regret 1.4, and nine that cost next to nothing because they missed, or whose error is unknown.
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
  const Claim regret = audit_claims(scenes, pairs)[3];
  EXPECT_EQ(regret.verdict, no);
  EXPECT_EQ(regret.measured, "1.400, 11 pairs; 9 left out, whose error was missed or cannot be resolved");
  pairs.resize(9);
  EXPECT_EQ(audit_claims(scenes, pairs)[3].verdict, untested);
}

TEST(AuditClaims, OnlyLongRunsTellOfThePilots) {
  std::vector<AuditedPair> pairs(3, good_pair());
  for (AuditedPair& p : pairs) p.audit.actual_s = 1.0;
  EXPECT_EQ(verdicts(pairs)[4], untested);
  pairs[1].audit.actual_s = 5.5;
  pairs[1].audit.pilot_s = 1.2;  // 22 %
  pairs[2].audit.actual_s = 6.0;
  pairs[2].audit.pilot_s = 0.6;
  EXPECT_EQ(verdicts(pairs)[4], no);
}

// ---- long motions

TEST(AuditedPair, IsLongIfItsRunCostsTwentyTimesItsPilots) {
  AuditedPair p = good_prediction();
  p.audit.pilot_s = 0.1;
  EXPECT_TRUE(p.is_long_prediction());
  p.audit.pilot_s = 0.101;
  EXPECT_FALSE(p.is_long_prediction());
}

// Above 2 s pilots may take a tenth of the run, and here take a twentieth: never more than the first rule allows.
TEST(AuditedPair, IsLongByPilotsOfTwoSecondsOrATenthOfTheRun) {
  AuditedPair p = good_prediction();
  p.audit.actual_s = 100.0;
  p.audit.pilot_s = 4.9;
  EXPECT_TRUE(p.is_long_prediction());
  p.audit.pilot_s = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(p.is_long_prediction());
}

TEST(AuditClaims, OfLongMotionsHoldWhenEverythingIsAsPredicted) {
  EXPECT_EQ(verdicts(std::vector(72, good_prediction()), long_motions), (std::vector{yes, yes, yes, yes}));
  EXPECT_EQ(verdicts(std::vector(71, good_prediction()), long_motions), (std::vector{yes, open, open, yes}));
}

TEST(AuditClaims, OfLongMotionsFallShortOfFortyPairsThatAreNoPredictions) {
  std::vector<AuditedPair> pairs(40, good_prediction());
  pairs[7].audit.pilot_s = 0.2;
  EXPECT_EQ(verdicts(pairs, long_motions)[0], no);
  EXPECT_EQ(verdicts(std::vector(10, good_prediction()), long_motions)[0], untested);
}

TEST(AuditClaims, OfLongMotionsGoByHowManyMissTheirErrorAndTheirSeconds) {
  std::vector<AuditedPair> pairs(72, good_prediction());
  pairs[0].audit.actual_error = 2e-4;
  pairs[1].audit.printed_s = 1.6;  // 20 % too little
  EXPECT_EQ(verdicts(pairs, long_motions), (std::vector{yes, open, open, yes}));
  for (std::size_t k = 0; k < 12; ++k) {
    pairs[k].audit.actual_error = 2e-4;
    pairs[20 + k].audit.printed_s = 2.4;
  }
  EXPECT_EQ(verdicts(pairs, long_motions), (std::vector{yes, no, no, yes}));
}

TEST(AuditClaims, OfLongMotionsLeaveOutRunsThatAreTooLongToFollow) {
  std::vector<AuditedPair> pairs(75, good_prediction());
  for (std::size_t k = 0; k < 3; ++k) {
    pairs[k].pick.clear();
    pairs[k].followed = false;
  }
  const std::vector<Claim> claims = audit_claims(long_motions, pairs);
  EXPECT_EQ(claims[0].measured, "72 of 75 pairs; 3 too long to follow");
  EXPECT_EQ(claims[1].verdict, yes);
  EXPECT_EQ(audit_table(long_motions, pairs).rows()[0][4], "not followed");
}

TEST(AuditClaims, OfLongMotionsLeaveOutWhatWasNoPrediction) {
  std::vector<AuditedPair> pairs(73, good_prediction());
  pairs[0].audit.pilot_s = 1.0;
  pairs[0].audit.actual_error = 1.0;
  pairs[0].audit.printed_s = 100.0;
  EXPECT_EQ(verdicts(pairs, long_motions), (std::vector{yes, yes, yes, yes}));
}

// ---- tables and pictures

TEST(AuditTable, HasARowForEachPair) {
  std::vector<AuditedPair> pairs(3, good_pair());
  pairs[0].audit.best_cost = 320.0;
  pairs[0].audit.predicted_evaluations = 410.0;
  pairs[1].audit.actual_error = 2e-4;
  pairs[1].swept = false;
  pairs[2].pick.clear();
  pairs[2].confidence.clear();
  const Table table = audit_table(scenes, pairs);
  EXPECT_EQ(alignment(table), "lrlrlrrrrrlrrll");
  ASSERT_EQ(table.rows().size(), 3u);
  EXPECT_EQ(labelled(table, 0),
            (Row{"scene: a scene", "error: 1.0e-04", "pick: rk4", "actual / asked: 0.500", "met: yes",
                 "largest of a vertex / asked: 1.500", "evaluations: 400", "predicted / counted: 1.025", "seconds: 6",
                 "predicted / measured: 0.917", "best of the sweep: verlet", "regret: 1.38", "pilots / run: 0.10",
                 "confidence: asymptotic", "reference: certified"}));
  EXPECT_EQ(table.rows()[1][4], "NO");
  EXPECT_EQ(table.rows()[1][10], "-");
  EXPECT_EQ(table.rows()[1][11], "-");
  EXPECT_EQ(table.rows()[2],
            (Row{"a scene", "1.0e-04", "none", "-", "NO", "-", "-", "-", "-", "-", "-", "-", "-", "-", "certified"}));
}

TEST(AuditTable, SaysOfLongMotionsWhatWasMetMissedAndNotJudged) {
  std::vector<AuditedPair> pairs(5, good_prediction());
  pairs[0].warned = true;
  pairs[1].audit.actual_error = 2e-4;
  pairs[2].floor = 1e-3;
  pairs[3].audit.pilot_s = 1.0;
  pairs[4].pick.clear();
  pairs[4].confidence.clear();
  const Table table = audit_table(long_motions, pairs);
  EXPECT_EQ(alignment(table), "lrlrlrrrrrrlrl");
  ASSERT_EQ(table.rows().size(), 5u);
  EXPECT_EQ(labelled(table, 0),
            (Row{"scene: a scene", "error: 1.0e-04", "pick: rk4", "actual / asked: 0.500", "met: yes",
                 "largest of a vertex / asked: 1.500", "actual / predicted error: 0.833", "seconds: 2",
                 "printed / measured: 0.950", "run / pilots: 40.0", "seen: 1.25 %", "best of the sweep: verlet",
                 "regret: 1.10", "confidence: asymptotic, errors grow exponentially"}));
  EXPECT_EQ(table.rows()[1][4], "NO");
  EXPECT_EQ(table.rows()[2][4], "not judged: the other codes differ by more");
  EXPECT_EQ(table.rows()[2][3], "-");
  EXPECT_EQ(table.rows()[3][4], "yes, but not counted");
  EXPECT_EQ(table.rows()[4],
            (Row{"a scene", "1.0e-04", "none", "-", "NO", "-", "-", "-", "-", "-", "-", "-", "-", "-"}));
}

TEST(AuditScenes, HaveARowForEachScene) {
  std::vector<AuditedPair> pairs(3, good_pair());
  pairs[0].what = pairs[1].what = "a soft box";
  pairs[0].vertices = pairs[1].vertices = 27;
  pairs[0].omega_phase = pairs[1].omega_phase = 350.0;
  pairs[2].scene = "another";
  const Table table = audited_scenes_table(scenes, pairs);
  EXPECT_EQ(alignment(table), "llrr");
  ASSERT_EQ(table.rows().size(), 2u);
  EXPECT_EQ(labelled(table, 0),
            (Row{"scene: a scene", "what was drawn: a soft box", "vertices: 27", "T omega_max: 350"}));
  EXPECT_EQ(table.rows()[1][0], "another");
  pairs[0].springs = 98;
  pairs[0].floor = 2e-9;
  EXPECT_EQ(labelled(audited_scenes_table(long_motions, pairs), 0),
            (Row{"scene: a scene", "what was drawn: a soft box", "vertices: 27", "springs: 98", "T omega_max: 350",
                 "the other codes differ by: 2.0e-10"}));
}

TEST(AuditSample, HoldsEveryFigureOfAPair) {
  AuditedPair p = good_prediction();
  p.what = "a soft box";
  p.vertices = 27;
  p.springs = 98;
  p.omega_phase = 350.0;
  p.setting.tolerance = 0.5;
  p.audit.predicted_evaluations = 410.0;
  p.audit.best_cost = 320.0;
  EXPECT_EQ(json_of(p), nlohmann::json::parse(R"({"scene": "a scene", "what": "a soft box", "vertices": 27,
    "springs": 98, "omega_phase": 350.0, "reference": "certified", "floor": 1e-12, "error": 1e-4, "pick": "rk4",
    "confidence": "asymptotic", "steps": 100, "tolerance": 0.5, "seen_part": 0.0125, "warned": false, "long_prediction": true,
    "resolved": true, "actual_error": 5e-5, "largest_error": 1.5e-4, "predicted_error": 6e-5, "actual_evaluations": 400.0,
    "predicted_evaluations": 410.0, "actual_cost": 440.0, "predicted_cost": 420.0, "actual_s": 2.0,
    "predicted_s": 100.0, "printed_s": 1.9, "pilot_s": 0.05, "swept": true, "best": "verlet", "best_cost": 320.0})"));
}

TEST(AuditTable, SaysOfAPairThatCannotBeJudgedNothingThatLooksLikeAJudgement) {
  std::vector<AuditedPair> pairs(3, good_pair());
  pairs[0].floor = 10.0;  // a chaotic scene: two references differ by that much
  pairs[0].audit.actual_error = 2.8;
  pairs[1].floor = std::numeric_limits<double>::infinity();
  pairs[1].audit.actual_error = std::numeric_limits<double>::quiet_NaN();
  const Table table = audit_table(scenes, pairs);
  EXPECT_EQ(table.rows()[0][3], "-");
  EXPECT_EQ(table.rows()[0][4], "not judged: below the resolution of the reference");
  EXPECT_EQ(table.rows()[1][3], "-");
  EXPECT_EQ(table.rows()[1][4], "not judged: followed for its cost only");
  EXPECT_EQ(table.rows()[2][3], "0.500");
  for (const auto& row : table.rows())
    for (const std::string& cell : row) EXPECT_EQ(cell.find("nan"), std::string::npos) << cell;
}

TEST(AuditPlot, PlacesEachPairByWhatItPromised) {
  std::vector<AuditedPair> pairs(2, good_pair());
  pairs[1].pick = "verlet";
  const Plot plot = audit_plot(scenes, pairs, "of today");
  EXPECT_EQ(plot.title, "recommend, promised and met");
  EXPECT_EQ(plot.subtitle, "of today");
  EXPECT_TRUE(plot.x_axis.starts_with("predicted over measured time")) << plot.x_axis;
  EXPECT_TRUE(plot.y_axis.starts_with("actual error over the requested error")) << plot.y_axis;
  ASSERT_EQ(plot.series.size(), 5u);  // the requested error and 15 % to either side as lines, then the picks by name
  const auto expect_line = [&](std::size_t k, double x1, double y1, double x2, double y2) {
    const PlotSeries& line = plot.series[k];
    ASSERT_EQ(line.points.size(), 2u);
    EXPECT_DOUBLE_EQ(line.points[0].x, x1);
    EXPECT_DOUBLE_EQ(line.points[0].y, y1);
    EXPECT_DOUBLE_EQ(line.points[1].x, x2);
    EXPECT_DOUBLE_EQ(line.points[1].y, y2);
    EXPECT_EQ(line.symbol, 0);
    EXPECT_GT(line.width, 0.0);
    EXPECT_TRUE(line.title.empty());
  };
  expect_line(0, plot.x_low, 1.0, plot.x_high, 1.0);
  expect_line(1, 0.85, plot.y_low, 0.85, plot.y_high);
  expect_line(2, 1.15, plot.y_low, 1.15, plot.y_high);
  EXPECT_EQ(plot.series[3].title, "rk4");
  EXPECT_NE(plot.series[3].colour, plot.series[4].colour);
  const PlotSeries& last = plot.series.back();
  EXPECT_EQ(last.title, "verlet");
  ASSERT_EQ(last.points.size(), 1u);
  EXPECT_DOUBLE_EQ(last.points[0].x, 5.5 / 6.0);
  EXPECT_DOUBLE_EQ(last.points[0].y, 0.5);
}

TEST(AuditPlot, KeepsWhatIsFarOffWithinThePictureAndLeavesOutWhatCannotBeTold) {
  std::vector<AuditedPair> pairs(4, good_pair());
  pairs[0].audit.predicted_s = 600.0;
  pairs[0].audit.actual_error = 1.0;
  pairs[1].audit.predicted_s = 0.06;
  pairs[1].audit.actual_error = 1e-12;
  pairs[2].floor = 1.0;
  pairs[3].pick.clear();
  const Plot plot = audit_plot(scenes, pairs, "");
  ASSERT_EQ(plot.series.size(), 4u);
  const auto& points = plot.series.back().points;
  ASSERT_EQ(points.size(), 2u);
  for (const auto& p : points) {
    EXPECT_GT(p.x, plot.x_low);
    EXPECT_LT(p.x, plot.x_high);
    EXPECT_GT(p.y, plot.y_low);
    EXPECT_LT(p.y, plot.y_high);
  }
  EXPECT_GT(points[0].x, 1.15);
  EXPECT_GT(points[0].y, 1.0);
  EXPECT_LT(points[1].x, 0.85);
  EXPECT_LT(points[1].y, 1.0);
}

TEST(AuditPlot, PlacesLongMotionsThatCountByWhatWasSeenOfThem) {
  std::vector<AuditedPair> pairs(3, good_prediction());
  pairs[1].audit.actual_error = 1.0;  // far above
  pairs[2].audit.pilot_s = 1.0;
  const Plot plot = audit_plot(long_motions, pairs, "");
  ASSERT_EQ(plot.series.size(), 2u);  // the line, and one method
  ASSERT_EQ(plot.series[1].points.size(), 2u);
  for (const auto& point : plot.series[1].points) {
    EXPECT_GT(point.y, plot.y_low);
    EXPECT_LT(point.y, plot.y_high);
    EXPECT_EQ(point.x, 0.0125);
  }
}

}  // namespace
}  // namespace dartboard::audit_report_test
