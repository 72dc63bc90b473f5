// The report of `simulate` on a run: every figure in its own place.

#include "benchmarks/cli/scenes/simulate_report.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "benchmarks/cli/scenes/simulation_json.h"
#include "core/scene/run/body_in_words.h"
#include "tests/support/bodies/surveys_for_tests.h"
#include "tests/support/moving_box.h"
#include "tests/support/tables_for_tests.h"

namespace dartboard::simulate_report_test {
namespace {

/// A box that has moved three steps, and a result that has no two figures alike.
class SimulateReport : public ::testing::Test {
 protected:
  SimulateReport() {
    for (int k = 0; k < 3; ++k) EXPECT_FALSE(simulation_.advance());
    result_.first = {.time = 0.5,
                     .kinetic = 2,
                     .elastic = 3,
                     .gravitational = 4,
                     .mass = 16,
                     .counts = {.vertices = 12, .edges = 13, .faces = 14, .cells = 15, .components = 1},
                     .boundary = 17,
                     .largest_stress = 18,
                     .operations = 19};
    result_.last = {.time = 0.75,
                    .kinetic = 22,
                    .elastic = 23,
                    .gravitational = std::numeric_limits<double>::quiet_NaN(),
                    .mass = 31,
                    .counts = {.vertices = 32, .edges = 33, .faces = 34, .cells = 35, .components = 36},
                    .boundary = 37,
                    .largest_stress = 38,
                    .operations = 39};
  }
  SimulationReport report() {
    return {.scene = scene_,
            .survey = survey_,
            .simulation = simulation_,
            .result = result_,
            .settled = std::nullopt,
            .expected = {{"vertices", "27", "28", false}, {"cells", "48", "48", true}},
            .unjudged = "",
            .wall_s = 1.5,
            .cpu_s = 0.75,
            .folder = "",
            .frames = 5,
            .picture = ""};
  }
  void diverge() {
    Divergence d;
    d.step = 3;
    d.time = 0.003;
    d.quantity = "energy";
    d.value = 1e30;
    d.vertex = 7;
    d.taken_back = 2;
    result_.divergence = d;
  }
  void expect_words(const SimulationReport& r, const std::string& words) {
    EXPECT_NE(to_text(r).find(words), std::string::npos) << words << " is not in\n" << to_text(r);
  }

  SceneFile scene_ = moving::parse(moving::moving_box());
  SceneSurvey survey_ = survey_of(scene_);
  Simulation simulation_{scene_};
  RunResult result_;
};

TEST_F(SimulateReport, SetsTheStartBesideTheEnd) {
  const Table table = summary_of(report());
  EXPECT_EQ(alignment(table), "lrr");
  EXPECT_EQ(labelled(table, 0), (Row{"quantity: time [s]", "start: 0.5", "end: 0.75"}));
  const std::vector<Row> expected{{"time [s]", "0.5", "0.75"},
                                  {"steps", "0", "3"},
                                  {"operations", "19", "39"},
                                  {"vertices", "12", "32"},
                                  {"edges", "13", "33"},
                                  {"faces", "14", "34"},
                                  {"cells", "15", "35"},
                                  {"components", "1", "36"},
                                  {"mass [kg]", "16", "31"},
                                  {"kinetic energy [J]", "2", "22"},
                                  {"elastic energy [J]", "3", "23"},
                                  {"gravitational energy [J]", "4", "-"},
                                  {"boundary [m^2]", "17", "37"},
                                  {"largest principal stress [Pa]", "18", "38"}};
  EXPECT_EQ(table.rows(), expected);
}

TEST_F(SimulateReport, SaysWhatTheRunTookAndWhatItWasToCome) {
  const SimulationReport r = report();
  EXPECT_TRUE(to_text(r).starts_with(to_text(summary_of(r)) + "\nwall 1.5 s")) << to_text(r);
  expect_words(r, "\nwall 1.5 s, processor 0.75 s, 2.5e+05 microseconds per step, events and output included\n");
  expect_words(r, fmt::format("\nhash of the last state {:016x}\n", simulation_.body().state_hash()));
  Table expected({{"expected"}, {"by the scene", Align::right}, {"found", Align::right}, {"holds"}});
  expected.add_row({"vertices", "27", "28", "NO"});
  expected.add_row({"cells", "48", "48", "yes"});
  EXPECT_TRUE(to_text(r).ends_with("\n\n" + to_text(expected))) << to_text(r);
  EXPECT_EQ(to_text(r).find("unaccounted"), std::string::npos);  // nothing was removed
  EXPECT_EQ(to_text(r).find("jump"), std::string::npos);         // nor cut
}

TEST_F(SimulateReport, BeginsWithWhatIsSimulatedAndWhatItsSelectionsHold) {
  SceneFile scene = scene_;
  scene.fixed = {{IdSelection{{0, 1, 2}}}, {BoxSelection{{0, 0, 0}, {0, 1, 1}}, 1}};
  const Simulation simulation(scene);
  EXPECT_EQ(opening_of(scene, survey_of(scene), simulation, "short enough"),
            "box\nno map is needed, " + scene.integrator + ", h = 0.001 s (short enough)\nsprings: " +
                in_words(simulation.body()) + "\n/fixed/0: 3 of 27 vertices\n/fixed/1: 9 of 27 vertices, along x\n\n");
  scene.material = {.density = 768, .young = 2e4, .poisson = 0.3, .model = Model::stvk};
  EXPECT_NE(opening_of(scene, survey_of(scene), Simulation(scene), "").find("\nstvk elements: "), std::string::npos);
}

TEST_F(SimulateReport, SaysWhereTheResultsAreAndWhyThereIsNoVerdict) {
  SimulationReport r = report();
  r.folder = "out";
  r.picture = "drawn";
  r.unjudged = "cut short";
  r.expected.clear();
  EXPECT_TRUE(to_text(r).ends_with("\n\ncut short\n\n5 frames, frames.pvd, diagnostics.csv written to out.\ndrawn\n"))
      << to_text(r);
  scene_.probes.resize(1);
  expect_words(r, "diagnostics.csv, probes.csv written to out.");
}

TEST_F(SimulateReport, HoldsWhereNothingDivergedAndAllExpectationsDo) {
  SimulationReport r = report();
  EXPECT_FALSE(r.holds());
  r.expected.erase(r.expected.begin());
  EXPECT_TRUE(r.holds());
  diverge();
  EXPECT_FALSE(r.holds());
}

TEST_F(SimulateReport, OfADivergenceSaysWhatIsKept) {
  diverge();
  const SimulationReport r = report();
  EXPECT_EQ(r.kept_step(), 1u);
  EXPECT_EQ(summary_of(r).rows()[1], (Row{"steps", "0", "1"}));
  expect_words(r, "\nThe motion " + to_string(*result_.divergence) +
                      ". The state of step 1, t = 0.75 s is kept, and what was written until then.\n");
  nlohmann::ordered_json json = to_json(r).at("divergence");
  EXPECT_EQ(json.at("value"), 1e30);
  EXPECT_TRUE(json.at("stable").is_null());
  json.erase("value");
  json.erase("stable");
  EXPECT_EQ(json, nlohmann::ordered_json::parse(R"({"step": 3, "time": 0.003, "quantity": "energy", "vertex": 7,
    "taken_back": 2, "kept_step": 1, "kept_time": 0.75})"));
}

TEST_F(SimulateReport, OfADivergenceComparesTheStepWithTheLongestStableOne) {
  diverge();
  result_.divergence->stable = 0.0005;
  expect_words(report(), " A step of 0.001 s is too long for that state: at most 0.0005 s is stable.\n");
  result_.divergence->stable = 0.002;
  expect_words(report(), " The longest stable step of that state is 0.002 s.\n");
  survey_.models = {Model::stvk};
  expect_words(
      report(),
      " The longest stable step of that state is 0.002 s, and a shorter one where elements are deformed further.\n");
  EXPECT_EQ(to_json(report()).at("divergence").at("stable"), 0.002);
}

TEST_F(SimulateReport, OfARefusedStepSaysWhyAndDoesNotHold) {
  SimulationReport r = report();
  r.expected.clear();
  EXPECT_TRUE(r.holds());
  result_.refusal = StepRefusal{4, 0.003, "a step of 0.001 s is too long for rk4", 0.0005};
  expect_words(r,
               "\nThe motion stopped before step 4, t = 0.003 s: a step of 0.001 s is too long for rk4; at most "
               "0.0005 s is stable. What was written until then is kept.\n");
  EXPECT_FALSE(r.holds());
  const nlohmann::ordered_json json = to_json(r);
  EXPECT_EQ(json.at("refusal"),
            nlohmann::ordered_json::parse(
                R"({"step": 4, "time": 0.003, "why": "a step of 0.001 s is too long for rk4", "stable": 0.0005})"));
  EXPECT_EQ(json.at("holds"), false);
  EXPECT_TRUE(json.at("divergence").is_null());
}

TEST_F(SimulateReport, InJsonHasEveryFigure) {
  SimulationReport r = report();
  r.folder = "out";
  r.unjudged = "cut short";
  result_.interrupted = true;
  nlohmann::ordered_json expected = nlohmann::ordered_json::parse(R"({"scene": "box", "map": "", "integrator": "",
    "selections": [], "steps": 3, "first": {}, "last": {}, "hash": "", "wall_s": 1.5, "cpu_s": 0.75, "mass_drift": 0.0,
    "jumps": {}, "holds": false, "divergence": null, "refusal": null, "warnings": [], "idle_events": [],
    "expected": [{"what": "vertices", "expected": "27", "actual": "28", "holds": false},
      {"what": "cells", "expected": "48", "actual": "48", "holds": true}],
    "unjudged": "cut short", "interrupted": true, "folder": "out"})");
  expected["map"] = simulation_.body().map_name();
  expected["integrator"] = scene_.integrator;
  expected["first"] = to_json(result_.first, 3);
  expected["last"] = to_json(result_.last, 3);
  expected["hash"] = fmt::format("{:016x}", simulation_.body().state_hash());
  expected["mass_drift"] = mass_unaccounted_for(16.0, 0.0, simulation_.body().mass());
  expected["jumps"] = to_json(simulation_.jumps());
  EXPECT_EQ(to_json(r), expected);
}

TEST_F(SimulateReport, InJsonHoldsNothingWhereNothingWasExpected) {
  SimulationReport r = report();
  r.expected.clear();
  EXPECT_TRUE(to_json(r).at("holds").is_null());
  diverge();
  EXPECT_EQ(to_json(r).at("holds"), false);
}

}  // namespace
}  // namespace dartboard::simulate_report_test
