// Tables and files of `validate order`: every figure of results whose figures all differ, in its own place.

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "benchmarks/studies/order/order_report.h"
#include "tests/support/claims_for_tests.h"
#include "tests/support/tables_for_tests.h"

namespace dartboard::order_tables_test {
namespace {

using Json = nlohmann::ordered_json;

OrderPoint point(std::uint64_t steps, double h_omega, Regime regime, double p_x, double p_v) {
  OrderPoint p;
  p.steps = steps;
  p.h_omega = h_omega;
  p.errors = {
      .x = 0.5, .x_p95 = 9.0, .x_largest = 9.0, .v = 0.25, .energy = 0.125, .momentum = 0.0625, .angular = 0.03125};
  p.p_x = p_x;
  p.p_v = p_v;
  p.has_order = true;
  p.regime = regime;
  return p;
}

OrderStudy study() {
  OrderStudy s;
  s.integrator = "rk4";
  s.which = OrderCase::aligned_cut;
  s.theory = 4;
  s.points = {point(24, 0.75, Regime::large, 1.25, 1.5), point(48, 0.5, Regime::pre_asymptotic, 2.25, 2.5),
              point(96, 0.375, Regime::asymptotic, 3.75, 3.5), point(192, 0.25, Regime::floor, 4.25, 4.5),
              point(384, 0.125, Regime::failed, 5.25, 5.5)};
  s.points[0].has_order = false;
  s.holds = true;
  s.p_x = 4.0625;
  s.p_v = 3.875;
  return s;
}

OrderResults results() {
  OrderResults r;
  reference::CertifiedMotion certified;
  certified.accepted = true;
  certified.independent = false;
  certified.self_difference = 1e-15;
  certified.agreement = 2e-14;
  certified.floor = 3e-13;
  certified.gain = {4.0, 5.0};
  certified.codes = {{"odeint", 6e-15, 71, 0.125, ""}, {"arkode", 8e-14, 72, 0.25, "gave up"}};
  r.references = {{OrderCase::damped, certified}};
  r.studies = {study()};
  r.discrete = {{"verlet", 0.01, 0.25, 1000, 3e-12, ""}, {"rk4", 0.0, 0.5, 1000, 5e-12, "it failed"}};
  r.no_discrete = {"local-global"};
  r.force = {.ratio = 0.5, .deviation = 3e-15, .bound = 4e-14, .largest_force = 2.5};
  r.jumps = {{0.75, 27, 30, 1e-16, 2e-16, 3e-16}};
  r.drift = {1001, 20.0, 27, 30, 5e-13, "stopped"};
  r.factor = {100, 205, 3, 6e-9, 7e-3, "no factor"};
  return r;
}

TEST(OrderTables, HaveTheOrdersOfEachHalvingAndWhereTheyAre) {
  OrderResults r = results();
  r.studies.push_back(study());
  r.studies[1].holds = false;
  r.studies[1].reason = "of order 3";
  r.studies[1].points = {point(24, 0.75, Regime::failed, 0.0, 0.0)};
  r.studies[1].points[0].has_order = false;
  r.studies[1].points[0].diagnosis = "it grew";
  r.studies.push_back(study());
  r.studies[2].points.clear();
  const Table table = order_table(r);
  EXPECT_EQ(alignment(table), "llrrlll");
  ASSERT_EQ(table.rows().size(), 3u);
  EXPECT_EQ(labelled(table, 0),
            (Row{"integrator: rk4", "scene: aligned cut", "theory: 4", "h omega: 0.75 .. 0.12",
                 "p in x, by halving: 2.25~ 3.75  4.25_ 5.25!", "p in v: 2.50~ 3.50  4.50_ 5.50!", "holds: yes"}));
  EXPECT_EQ(table.rows()[1][4], "!");
  EXPECT_EQ(table.rows()[1][6], "NO: of order 3");
  EXPECT_EQ(table.rows()[2][3], "-");
  r.studies[0].points[1].regime = Regime::large;
  EXPECT_EQ(order_table(r).rows()[0][4], "2.25^ 3.75  4.25_ 5.25!");
}

TEST(OrderTables, HaveEachCodeOfTheReferences) {
  const Table table = oracle_table(results());
  EXPECT_EQ(alignment(table), "llrrr");
  ASSERT_EQ(table.rows().size(), 2u);
  EXPECT_EQ(labelled(table, 0),
            (Row{"scene: damped", "code: odeint", "distance / edges: 6.0e-15", "evaluations: 71", "CPU s: 0.125"}));
  EXPECT_EQ(table.rows()[1], (Row{"damped", "arkode", "gave up", "72", "0.250"}));
}

TEST(OrderTables, HaveTheDeviationFromEachExactMap) {
  const Table table = discrete_table(results());
  EXPECT_EQ(alignment(table), "lrrrr");
  ASSERT_EQ(table.rows().size(), 2u);
  EXPECT_EQ(labelled(table, 0),
            (Row{"integrator: verlet", "zeta: 0.01", "h omega: 0.25", "steps: 1000", "deviation: 3.0e-12"}));
  EXPECT_EQ(table.rows()[1].back(), "it failed");
}

TEST(OrderTables, NameWhoAgreesOnTheReferences) {
  OrderResults r = results();
  EXPECT_EQ(references_heading(r), "by two methods of one library");
  r.references[0].certified.independent = true;
  EXPECT_EQ(references_heading(r), "by independent codes");
}

TEST(OrderClaimsInWords, SayWhatIsAskedWhatWasMeasuredAndWhatItRestsOn) {
  OrderResults r = results();
  r.references[0].certified.codes[1].distance = 7e-14;
  r.studies.push_back(study());
  r.studies[1].holds = false;
  r.studies[1].p_x = 0.0;
  const auto claims = claims_of(r);
  const auto expect = [&](const std::string& id, const std::string& asked, const std::string& measured,
                          const std::string& rests_on, const std::string& reason) {
    const Claim& c = find_claim(claims, id);
    EXPECT_EQ(c.paper_value, asked) << id;
    EXPECT_EQ(c.measured, measured) << id;
    EXPECT_EQ(c.bound_or_interval, rests_on) << id;
    EXPECT_EQ(c.reason, reason) << id;
    EXPECT_FALSE(c.text.empty()) << id;
  };
  expect("order-aligned-cut", "three successive halvings within 0.1", "1 of 2 integrators, farthest 0.125", "",
         "rk4: ");
  expect("oracle-agreement", "<= 2e-13; each code <= 1e-12",
         "2.0e-14 in extended precision, 7.0e-14 the farthest of all", "", "");
  expect("discrete-exact", "<= 1e-10", "5.0e-12", "after 1000 steps, the farthest: rk4",
         "local-global states no amplification; rk4: it failed");
  expect("force-is-gradient", "within the rounding bound", "3.0e-15 N of 2.5 N", "bound 4.0e-14 N", "");
  expect("cut-jump", "<= 1e-14 relative", "3.0e-16", "", "");
  expect("energy-momentum-drift", "<= 1e-11 relative", "5.0e-13 in 1001 steps", "", "stopped");
  expect("kept-factor", ">= 10 times fewer", "3 instead of 205 in 100 steps",
         "6.0e-09 edges apart; the error of the step is 7.0e-03", "no factor");
  EXPECT_NE(find_claim(claims, "energy-momentum-drift").text.find("h omega = 20"), std::string::npos);
  EXPECT_NE(find_claim(claims, "oracle-agreement").text.find("two methods of one library"), std::string::npos);
}

TEST(OrderJson, HoldsEveryFigure) {
  OrderResults r = results();
  r.studies[0].points = {point(24, 0.75, Regime::asymptotic, 1.25, 1.5), point(48, 0.5, Regime::failed, 0.0, 0.0)};
  r.studies[0].points[1].has_order = false;
  r.studies[0].points[1].diagnosis = "it grew";
  r.studies[0].reason = "why";
  r.references[0].certified.agreement = std::numeric_limits<double>::infinity();
  std::vector<Claim> claims(1);
  claims[0].id = "one";
  claims[0].verdict = Verdict::holds;
  Json json = to_json(r, claims);
  EXPECT_EQ(json.at("holds"), true);
  EXPECT_EQ(json.at("claims"), Json(nlohmann::json(claims)));
  json.erase("claims");
  EXPECT_EQ(json, Json::parse(R"({"holds": true,
    "orders": [{"integrator": "rk4", "scene": "aligned cut", "theory": 4, "holds": true, "p_x": 4.0625, "p_v": 3.875,
      "reason": "why", "points": [
        {"steps": 24, "h_omega": 0.75, "regime": "asymptotic", "error_x": 0.5, "error_v": 0.25, "error_energy": 0.125,
         "error_momentum": 0.0625, "error_angular": 0.03125, "p_x": 1.25, "p_v": 1.5},
        {"steps": 48, "h_omega": 0.5, "regime": "failed", "diagnosis": "it grew"}]}],
    "references": [{"scene": "damped", "accepted": true, "independent": false, "self_difference": 1e-15,
      "agreement": null, "floor": 3e-13, "gain": 5.0, "codes": [
        {"code": "odeint", "distance": 6e-15, "evaluations": 71, "cpu_s": 0.125, "failure": ""},
        {"code": "arkode", "distance": 8e-14, "evaluations": 72, "cpu_s": 0.25, "failure": "gave up"}]}],
    "discrete": [
      {"integrator": "verlet", "zeta": 0.01, "h_omega": 0.25, "steps": 1000, "deviation": 3e-12, "diagnosis": ""},
      {"integrator": "rk4", "zeta": 0.0, "h_omega": 0.5, "steps": 1000, "deviation": 5e-12, "diagnosis": "it failed"}],
    "force": {"deviation": 3e-15, "bound": 4e-14, "ratio": 0.5, "largest_force": 2.5},
    "energy_drift": {"steps": 1001, "h_omega": 20.0, "drift": 5e-13, "diagnosis": "stopped"},
    "kept_factor": {"steps": 100, "fresh": 205, "kept": 3, "difference": 6e-9, "step_error": 7e-3,
      "diagnosis": "no factor"},
    "jumps": [{"time": 0.75, "vertices_before": 27, "vertices_after": 30, "energy": 1e-16, "momentum": 2e-16,
      "angular": 3e-16}]})"));
  claims[0].verdict = Verdict::falls_short;
  EXPECT_EQ(to_json(r, claims).at("holds"), false);
}

}  // namespace
}  // namespace dartboard::order_tables_test
