// Tables and files of `tradeoff`: every figure of a study whose figures all differ, in its own place.

#include "benchmarks/studies/tradeoff/tradeoff_tables.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "benchmarks/studies/tradeoff/tradeoff_json.h"
#include "core/base/escape.h"
#include "tests/support/tables_for_tests.h"

namespace dartboard::tradeoff_tables_test {
namespace {

using Json = nlohmann::json;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// One run of a contender, which gives its cost for every error down to its own.
WorkPoint run_of(const std::string& contender, double error, double cost, std::uint64_t evaluations, double force_s) {
  WorkPoint p;
  p.contender = contender;
  p.setting.steps = 10;
  p.h = 0.0625 * error;
  p.errors.x = error;
  p.work.force_evaluations = evaluations;
  p.cost = cost;
  p.force_s = force_s;
  p.standing = Standing::front;
  return p;
}

/// Verlet's method meets 0.1, Runge and Kutta's 0.01 too, CVODE 0.001.
WorkPrecision three_runs(double floor) {
  WorkPrecision study;
  study.scene = "chain";
  study.reference.floor = floor;
  study.points = {run_of("verlet", 0.05, 40.0, 80, 0.02), run_of("rk4", 0.005, 100.0, 400, 0.01),
                  run_of("cvode-adams", 0.0005, 250.0, 900, 0.03)};
  study.points[2].peer = true;
  return study;
}

TEST(TradeoffErrors, AreTheDecadesThatTheReferenceCanTell) {
  const auto count = [](double floor) { return decades(three_runs(floor)).size(); };
  EXPECT_EQ(count(0.2), 0u);
  EXPECT_EQ(count(5e-3), 2u);
  EXPECT_EQ(count(0.0), 13u);
  const std::vector<double> errors = decades(three_runs(5e-3));
  EXPECT_DOUBLE_EQ(errors[0], 0.1);
  EXPECT_DOUBLE_EQ(errors[1], 0.01);
}

TEST(TradeoffWinners, NameTheCheapestTheNextAndThePeerForEachError) {
  const Table table = winners_table(three_runs(5e-4));
  EXPECT_EQ(alignment(table), "llrrrrlrr");
  ASSERT_EQ(table.rows().size(), 3u);
  // seconds: of the fastest evaluation, 0.01 s
  EXPECT_EQ(labelled(table, 0), (Row{"error [edges]: 1e-01", "cheapest: verlet", "step [ms]: 3.12",
                                     "cost [evaluations' time]: 40", "force evaluations: 80", "seconds: 0.4",
                                     "runner-up: rk4", "costs: 2.50 x", "cvode-adams costs: 6.25 x"}));
  EXPECT_EQ(labelled(table, 1),
            (Row{"error [edges]: 1e-02", "cheapest: rk4", "step [ms]: 0.312", "cost [evaluations' time]: 100",
                 "force evaluations: 400", "seconds: 1", "runner-up: -", "costs: -", "cvode-adams costs: 2.50 x"}));
  EXPECT_EQ(table.rows()[2], (Row{"1e-03", "none", "-", "-", "-", "-", "-", "-", "-"}));
}

TEST(TradeoffWinners, SayNothingOfAPeerThatDidNotTakePart) {
  WorkPrecision study = three_runs(0.05);
  study.points.pop_back();
  EXPECT_EQ(winners_table(study).rows()[0].back(), "-");
}

TEST(TradeoffRegrets, AreOfEachMethodForEachError) {
  const Table table = regrets_table(three_runs(5e-3));
  EXPECT_EQ(alignment(table), "lrrr");
  ASSERT_EQ(table.rows().size(), 3u);
  EXPECT_EQ(labelled(table, 0), (Row{"always: verlet", "1e-01: 1", "1e-02: -", "worst: -"}));
  EXPECT_EQ(labelled(table, 1), (Row{"always: rk4", "1e-01: 2.5", "1e-02: 1", "worst: 2.5"}));
  EXPECT_EQ(labelled(table, 2), (Row{"always: cvode-adams (peer)", "1e-01: 6.25", "1e-02: 2.5", "worst: 6.25"}));
}

/// A point that has no two figures alike.
WorkPoint distinct_point() {
  WorkPoint p;
  p.contender = "bdf2";
  p.peer = true;
  p.setting.steps = 7;
  p.h = 0.5;
  p.h_omega = 1.5;
  p.errors = {
      .x = 0.011, .x_p95 = 0.012, .x_largest = 0.013, .v = 0.022, .energy = 0.033, .momentum = 0.044, .angular = 0.055};
  p.work = {101, 102, 103, 104, 105, 106, 107, 108, 109, 110, 111, 112, 113, 114, 115};
  p.costs = {230.0, 190.0, 200.0};
  p.cost = 201.0;
  p.cpu_s = 0.25;
  p.force_s = 0.125;
  p.standing = Standing::undecided;
  return p;
}

TEST(TradeoffPoints, HaveTheirSettingErrorsWorkAndStanding) {
  WorkPrecision study;
  study.points = {distinct_point(), distinct_point(), distinct_point()};
  study.points[1].setting = {.steps = 0, .tolerance = 0.002};
  study.points[1].under_floor = true;
  study.points[2].h_omega = nan;
  study.points[2].code = "UNSTABLE_DT";
  study.points[2].diagnosis = "it grew";
  const Table table = points_table(study);
  EXPECT_EQ(alignment(table), "lrrrrrrrrrll");
  ASSERT_EQ(table.rows().size(), 3u);
  EXPECT_EQ(labelled(table, 0),
            (Row{"integrator: bdf2", "h omega_max: 1.5", "tolerance: ", "E_x: 1.10e-02", "E_v: 2.20e-02",
                 "energy: 3.30e-02", "force evaluations: 104", "factorisations: 108", "solves: 109",
                 "cost [evaluations' time]: 201", "range: 190 .. 230", "standing: undecided"}));
  EXPECT_EQ(table.rows()[1][2], "2e-03");
  EXPECT_EQ(table.rows()[1][11], "undecided, under the floor");
  EXPECT_EQ(labelled(table, 2), (Row{"integrator: bdf2", "h omega_max: -", "tolerance: ", "E_x: ", "E_v: ", "energy: ",
                                     "force evaluations: 104", "factorisations: 108", "solves: 109",
                                     "cost [evaluations' time]: 201", "range: 190 .. 230", "standing: it grew"}));
}

// ---- JSON

Json expected_point() {
  return Json::parse(R"({"scene": "box", "integrator": "bdf2", "peer": true, "h": 0.5, "h_omega": 1.5,
    "work": {"steps": 101, "failed_steps": 102, "rejected_steps": 103, "force_evaluations": 104,
      "damping_sweeps": 105, "assemblies": 106, "analyses": 107, "factorisations": 108, "solves": 109,
      "rank_one_updates": 110, "newton_iterations": 111, "linear_iterations": 112, "line_search_trials": 113,
      "projections": 114, "factor_nonzeros": 115},
    "costs": [230.0, 190.0, 200.0], "cost": 201.0, "cpu_s": 0.25, "force_s": 0.125, "under_floor": false, "steps": 7,
    "errors": {"x": 0.011, "x_p95": 0.012, "x_largest": 0.013, "v": 0.022, "energy": 0.033, "momentum": 0.044,
      "angular": 0.055}})");
}

TEST(TradeoffSample, HoldsEveryFigureOfARun) { EXPECT_EQ(json_of("box", distinct_point()), expected_point()); }

TEST(TradeoffSample, HoldsTheToleranceOfStepsThatWereChosen) {
  WorkPoint p = distinct_point();
  p.setting = {.steps = 0, .tolerance = 0.002};
  p.under_floor = true;
  Json expected = expected_point();
  expected.erase("steps");
  expected["tolerance"] = 0.002;
  expected["under_floor"] = true;
  EXPECT_EQ(json_of("box", p), expected);
}

TEST(TradeoffSample, HoldsTheDiagnosisOfARunThatFailedAndNoErrors) {
  WorkPoint p = distinct_point();
  p.code = "UNSTABLE_DT";
  p.diagnosis = "it grew";
  p.cost = nan;
  Json expected = expected_point();
  expected.erase("errors");
  expected["code"] = "UNSTABLE_DT";
  expected["diagnosis"] = "it grew";
  expected["cost"] = nullptr;
  EXPECT_EQ(json_of("box", p), expected);
}

TEST(TradeoffSummary, HoldsTheWinnersAndWhatTheyRestOn) {
  WorkPrecision study = three_runs(0.01);
  study.reference.what = "two codes agree";
  study.omissions = {"one", "two"};
  Json summary = summary_of(study);
  ASSERT_EQ(summary.at("winners").size(), 2u);
  EXPECT_NEAR(summary["winners"][0]["error"].get<double>(), 0.1, 1e-15);
  for (Json& winner : summary["winners"]) winner.erase("error");
  EXPECT_EQ(summary, Json::parse(R"({"scene": "chain", "reference": "two codes agree", "floor": 0.01,
    "winners": [
      {"integrator": "verlet", "cost": 40.0, "force_evaluations": 80.0, "h": 0.003125, "runner_up": "rk4", "runner_up_cost": 100.0,
       "cvode_adams_cost": 250.0},
      {"integrator": "rk4", "cost": 100.0, "force_evaluations": 400.0, "h": 0.0003125, "runner_up": "", "runner_up_cost": 0.0,
       "cvode_adams_cost": 250.0}],
    "omissions": ["one", "two"]})"));
}

}  // namespace
}  // namespace dartboard::tradeoff_tables_test
