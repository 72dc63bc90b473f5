// The report of `recommend`: every figure in its own place.

#include "benchmarks/studies/tradeoff/recommend_report.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "tests/support/tables_for_tests.h"

namespace dartboard::recommend_report_test {
namespace {

using Json = nlohmann::json;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

/// A usable candidate that has no two figures alike.
Candidate usable(const std::string& name, double cost) {
  Candidate c;
  c.contender = name;
  c.order = 4;
  c.confidence = Confidence::asymptotic;
  c.observed_order = 3.875;
  c.limit_h = 0.5;
  c.steps = 71;
  c.h = 0.25;
  c.predicted_error = 0.0625;
  c.predicted_s = 0.125;
  c.predicted_cost = cost;
  c.predicted_evaluations = 285.0;
  return c;
}
Candidate adaptive_one() {
  Candidate c = usable("dormand-prince-54-adaptive", 300.0);
  c.adaptive = true;
  c.tolerance = 0.001;
  c.limit_h = infinity;
  c.full_length = true;
  return c;
}
Candidate left_out() {
  Candidate c;
  c.contender = "bdf2";
  c.implicit = true;
  c.order = 2;
  c.pruned = "no time was left";
  c.untried = true;
  return c;
}

Recommendation recommendation() {
  Recommendation r;
  r.scene = "box";
  r.error = 0.1;
  r.features = {.vertices = 81,
                .springs = 82,
                .events = 83,
                .pieces = {{"tetrahedra", 86}},
                .omega_low = 84.0,
                .omega_high = 85.0,
                .damping_ratio = 0.5,
                .phase = 86.0,
                .motion_rate = 87.0,
                .motion_size = 88.0,
                .force_s = 9e-6,
                .implicit_step_s = 90.0};
  r.candidates = {usable("rk4", 200.0), adaptive_one(), left_out()};
  r.one_more_digit = 1.75;
  r.one_more_digit_by = "blanes-moan-4";
  r.realtime_factor = 2.5;
  r.realtime_error = 0.011;
  r.realtime_by = "verlet";
  r.best_error = 1e-13;
  r.best_error_by = "verlet-compensated";
  r.pilot_s = 0.375;
  return r;
}

TEST(RecommendTable, HasARowForEachUsableCandidate) {
  Recommendation r = recommendation();
  Candidate sufficient = usable("verlet", 400.0);
  sufficient.confidence = Confidence::sufficient;
  sufficient.predicted_s = 2.0;
  r.candidates.insert(r.candidates.begin() + 2, sufficient);
  const Table table = candidates_table(r);
  EXPECT_EQ(alignment(table), "lrrrrrrrrl");
  ASSERT_EQ(table.rows().size(), 3u);
  EXPECT_EQ(labelled(table, 0), (Row{"integrator: rk4", "steps: 71", "h [ms]: 250", "limit of h [ms]: 500",
                                     "error: 6.2e-02", "cost [evaluations' time]: 200", "force evaluations: 285",
                                     "time: 125 ms", "order seen: 3.88 of 4", "confidence: asymptotic"}));
  EXPECT_EQ(labelled(table, 1),
            (Row{"integrator: dormand-prince-54-adaptive", "steps: about 71", "h [ms]: 250", "limit of h [ms]: none",
                 "error: 6.2e-02", "cost [evaluations' time]: 300", "force evaluations: 285", "time: 125 ms",
                 "order seen: 3.88 of the tolerance", "confidence: asymptotic, full length"}));
  EXPECT_EQ(table.rows()[2][7], "2 s");
  EXPECT_EQ(table.rows()[2][8], "-");
  EXPECT_EQ(table.rows()[2][9], "sufficient");
}

TEST(RecommendText, SaysWhatToTakeAndWhatElseThereIs) {
  EXPECT_EQ(
      text_of(recommendation(), nullptr, true, 16.0),
      "box with an error of at most 0.1 edges\n81 vertices, 82 springs, 86 tetrahedra, 83 events; omega_max 84 .. 85 1/s, "
      "damping ratio there 0.5, T omega_max = 86; a force evaluation takes 9 us here\n\n" +
          to_text(candidates_table(recommendation())) +
          "1 of 3 methods were not tried for want of time, and another run may pick one of them (--budget "
          "SECONDS grants more): bdf2\n"
          "\nTake rk4 with a step of 0.25 s, 71 steps: error 6.2e-02, 125 ms here (the time of 200 force evaluations; "
          "it makes 285).\n"
          "An error is the root mean square over the mass, the largest over time; single vertices are farther off.\n"
          "It is stable up to h = 0.5 s.\n"
          "One more digit costs 1.75 times as much, with blanes-moan-4.\n"
          "The pilots took 375 ms, 3 times the run.\n"
          "Real time: 16 s are simulated in 125 ms, 2.50 times real time.\n"
          "The best that real time allows: an error of 1.1e-02, with verlet.\n");
}

TEST(RecommendText, CountsOneThingInTheSingular) {
  Recommendation r = recommendation();
  r.features.events = 1;
  r.candidates = {usable("rk4", 400.0), usable("verlet", 500.0)};
  for (Candidate& c : r.candidates) c.steps = 1;
  RecommendedScene scene;
  scene.steps_for_error = 1;
  std::string text = text_of(r, nullptr, false, 16.0);
  for (const char* words : {", 1 event; omega_max", " s, 1 step: error", "Runner-up: verlet with 1 step, "})
    EXPECT_NE(text.find(words), std::string::npos) << words << " is not in\n" << text;
  r.candidates[0].steps = 2;
  text = text_of(r, &scene, false, 16.0);
  EXPECT_NE(text.find("The error takes 1 step; the events, and the times of loads and output, make them 2.\n"),
            std::string::npos)
      << text;
}

TEST(RecommendText, SaysWhyTheStepIsNoLongerAndWhatIsTooSlow) {
  Recommendation r = recommendation();
  r.candidates = {usable("rk4", 200.0)};
  r.candidates[0].limited_by_stability = r.candidates[0].fewest_steps = true;
  r.one_more_digit_by.clear();
  r.realtime_factor = 0.5;
  r.realtime_error = nan;
  std::string text = text_of(r, nullptr, true, 16.0);
  EXPECT_NE(text.find("71 steps, all that stability allows: error"), std::string::npos) << text;
  EXPECT_EQ(text.find("Runner-up"), std::string::npos) << text;
  EXPECT_NE(text.find("One more digit is beyond double precision, or takes too many steps.\n"), std::string::npos);
  EXPECT_NE(text.find("0.50 times real time: too slow.\nNo method is stable in real time.\n"), std::string::npos);
  r.candidates[0].limited_by_stability = false;
  text = text_of(r, nullptr, false, 16.0);
  EXPECT_NE(text.find("71 steps, the fewest steps tried: error"), std::string::npos) << text;
  EXPECT_EQ(text.find("eal time"), std::string::npos) << text;
  r.candidates[0].limit_h = infinity;
  text = text_of(r, nullptr, false, 16.0);
  EXPECT_EQ(text.find("It is stable up to"), std::string::npos) << text;
}

// No scene can be run with steps that are chosen within a tolerance.
TEST(RecommendText, HandsOverFixedSteps) {
  Recommendation r = recommendation();
  r.candidates = {usable("rk4", 400.0), usable("verlet", 500.0), adaptive_one()};
  const std::string text = text_of(r, nullptr, false, 16.0);
  EXPECT_NE(text.find("\nTake rk4 with a step of"), std::string::npos) << text;
  EXPECT_NE(text.find("Runner-up: verlet with 71 steps, 1.25 times the cost.\n"), std::string::npos) << text;
  EXPECT_NE(
      text.find("A program in which dormand-prince-54 chooses its steps, with a tolerance of 1.00e-03 edges, takes "
                "0.75 times the cost; scenes have one step throughout.\n"),
      std::string::npos)
      << text;
  r.candidates = {adaptive_one()};
  EXPECT_EQ(r.pick(), nullptr);
}

// 0.2 / 88 to four digits ends 2.4e-5 s late.
TEST(RecommendText, HasAllDigitsOfTheStep) {
  Recommendation r = recommendation();
  r.candidates[0].steps = 88;
  r.candidates[0].h = 0.2 / 88;
  const std::string text = text_of(r, nullptr, false, 0.2), before = "with a step of ";
  const auto at = text.find(before);
  ASSERT_NE(at, std::string::npos) << text;
  EXPECT_EQ(std::stod(text.substr(at + before.size())), 0.2 / 88);
}

TEST(RecommendText, SaysWhatItsSceneSays) {
  RecommendedScene scene;
  scene.file.integrator = "rk4";
  scene.file.step = 0.1 / 3;
  scene.json["event_times"] = "exact";
  scene.steps_for_error = 71;
  scene.choice = "What is chosen.";
  scene.trouble = "What may miss.";
  std::string text = text_of(recommendation(), &scene, false, 16.0);
  EXPECT_NE(text.find("\nIn the scene file: \"integrator\": \"rk4\", \"step\": 0.03333333333333333, \"event_times\": "
                      "\"exact\"\nWhat is chosen.\nWhat may miss.\n"),
            std::string::npos)
      << text;
  EXPECT_EQ(text.find("--write"), std::string::npos) << text;
  scene.json.clear();
  scene.names_cells = true;
  scene.steps_for_error = 64;
  text = text_of(recommendation(), &scene, false, 16.0);
  EXPECT_NE(text.find("\"step\": 0.03333333333333333\n"), std::string::npos) << text;
  EXPECT_NE(text.find("--write FILE writes names the cells"), std::string::npos) << text;
  EXPECT_NE(text.find("The error takes 64 steps; the events, and the times of loads and output, make them 71.\n"),
            std::string::npos)
      << text;
}

TEST(RecommendText, SaysHowMuchOfTheMotionIsPredicted) {
  Recommendation r = recommendation();
  r.candidates[0].seen_part = 0.0125;
  EXPECT_NE(text_of(r, nullptr, false, 1.0).find("Its pilots saw 1.2 % of the motion; the rest is predicted.\n"),
            std::string::npos)
      << text_of(r, nullptr, false, 1.0);
  r.candidates[0].full_length = true;
  EXPECT_EQ(text_of(r, nullptr, false, 1.0).find("Its pilots saw"), std::string::npos);
}

// exp(2 t) takes an error of 1/16 to an edge in ln(16) / 2.
TEST(RecommendText, WarnsOfErrorsThatGrowExponentially) {
  Recommendation r = recommendation();
  EXPECT_EQ(text_of(r, nullptr, false, 1.0).find("chaotic"), std::string::npos);
  r.candidates[0].growth_rate = 2.0;
  const std::string text = text_of(r, nullptr, false, 1.0);
  EXPECT_NE(text.find("grow e-fold in 0.5 s: the motion is chaotic"), std::string::npos) << text;
  EXPECT_NE(text.find("it takes 1.39 s.\n"), std::string::npos) << text;
}

TEST(RecommendText, SaysWhatCanBeReachedWhereNothingMeetsTheError) {
  Recommendation r = recommendation();
  r.error = 1e-15;
  r.candidates = {left_out()};
  EXPECT_TRUE(text_of(r, nullptr, false, 1.0)
                  .ends_with("\nAn error of 1e-15 edges cannot be met in double precision; about 1.0e-13 is the best "
                             "of what was tried, with "
                             "verlet-compensated.\n"));
  r.candidates[0].untried = false;
  EXPECT_TRUE(text_of(r, nullptr, false, 1.0).ends_with("about 1.0e-13 is the best, with verlet-compensated.\n"));
  r.best_error = infinity;
  EXPECT_TRUE(text_of(r, nullptr, false, 1.0).ends_with("\nNothing can be recommended.\n"));
}

TEST(RecommendJson, HoldsEveryFigure) {
  Recommendation r = recommendation();
  r.candidates[0].full_length = r.candidates[0].limited_by_stability = true;
  r.candidates[0].seen_part = 0.03125;
  r.candidates[0].growth_rate = 4.0;
  r.candidates[1].fewest_steps = true;
  r.candidates[1].full_length = false;
  r.candidates[2].least_error = 0.75;
  EXPECT_EQ(json_of(r, nullptr), Json::parse(R"({"scene": "box", "error": 0.1,
    "pick": {"integrator": "rk4", "steps": 71, "step": 0.25},
    "features": {"vertices": 81, "springs": 82, "pieces": {"tetrahedra": 86}, "events": 83, "omega_low": 84.0, "omega_high": 85.0,
      "damping_ratio": 0.5, "phase": 86.0, "motion_rate": 87.0, "motion_size": 88.0, "force_s": 9e-6,
      "implicit_step_s": 90.0},
    "candidates": [
      {"integrator": "rk4", "implicit": false, "order": 4, "confidence": "asymptotic", "full_length_pilots": true,
       "seen_part": 0.03125, "growth_rate": 4.0,
       "observed_order": 3.875, "stability_limit_h": 0.5, "limited_by_stability": true, "fewest_steps_tried": false,
       "steps": 71, "h": 0.25, "predicted_error": 0.0625, "predicted_seconds": 0.125, "predicted_cost": 200.0,
       "predicted_evaluations": 285.0},
      {"integrator": "dormand-prince-54-adaptive", "implicit": false, "order": 4, "tolerance": 0.001,
       "confidence": "asymptotic", "full_length_pilots": false, "seen_part": 1.0, "growth_rate": 0.0, "observed_order": 3.875, "stability_limit_h": null,
       "limited_by_stability": false, "fewest_steps_tried": true, "steps": 71, "h": 0.25, "predicted_error": 0.0625,
       "predicted_seconds": 0.125, "predicted_cost": 300.0, "predicted_evaluations": 285.0},
      {"integrator": "bdf2", "implicit": true, "order": 2, "pruned": "no time was left", "untried": true,
       "least_error": 0.75}],
    "untried": ["bdf2"], "best_error": {"error": 1e-13, "integrator": "verlet-compensated"},
    "one_more_digit": {"cost_ratio": 1.75, "integrator": "blanes-moan-4"},
    "realtime": {"factor": 2.5, "error": 0.011, "integrator": "verlet"}, "pilot_s": 0.375})"));
}

TEST(RecommendJson, SaysWhatItsSceneIs) {
  RecommendedScene scene;
  scene.file.exact_events = scene.names_cells = true;
  scene.choice = "chosen";
  scene.trouble = "may miss";
  EXPECT_EQ(json_of(recommendation(), &scene).at("pick"),
            Json::parse(R"({"integrator": "rk4", "steps": 71, "step": 0.25, "event_times": "exact", "names_cells": true,
              "choice": "chosen", "trouble": "may miss"})"));
}

// ---- picks that were run

Audit followed() {
  return {.error = 0.5,
          .actual_error = 0.25,
          .predicted_error = 0.375,
          .largest_error = 0.875,
          .actual_cost = 400.0,
          .predicted_cost = 300.0,
          .actual_evaluations = 401.0,
          .predicted_evaluations = 301.0,
          .actual_s = 6.0,
          .predicted_s = 5.0,
          .pilot_s = 1.0,
          .best = "verlet",
          .best_cost = 320.0};
}

TEST(RecommendFollowed, HasWhatWasPredictedBesideWhatHappened) {
  Audit missed = followed(), unknown = followed();
  missed.actual_error = 0.75;
  unknown.best.clear();
  unknown.best_cost = infinity;
  const std::vector<FollowedPick> picks{
      {"box", "rk4", followed(), true}, {"box", "rk4", missed, true}, {"box", "rk4", unknown, false}};
  EXPECT_FALSE(picks[0].misses());
  EXPECT_TRUE(picks[1].misses());
  EXPECT_FALSE((FollowedPick{"box", "rk4", missed, false}.misses()));
  const Table table = followed_table(picks);
  EXPECT_EQ(alignment(table), "lrlrrrlrrlr");
  ASSERT_EQ(table.rows().size(), 3u);
  EXPECT_EQ(labelled(table, 0),
            (Row{"scene: box", "error: 0.5", "pick: rk4", "actual: 2.50e-01", "largest of a vertex: 8.75e-01",
                 "predicted: 3.75e-01", "met: yes", "cost [evaluations' time]: 400", "predicted/actual: 0.750",
                 "best of the sweep: verlet", "regret: 1.25"}));
  EXPECT_EQ(table.rows()[1][6], "NO");
  EXPECT_EQ(table.rows()[2], (Row{"box", "0.5", "rk4", "-", "-", "3.75e-01",
                                  "not judged: below the resolution of the reference", "400", "0.750", "-", "-"}));
}

TEST(RecommendFollowed, IsInTheJsonToo) {
  EXPECT_EQ(
      json_of(followed()),
      Json::parse(R"({"error": 0.5, "actual_error": 0.25, "largest_error": 0.875, "predicted_error": 0.375, "met": true,
              "actual_cost": 400.0, "predicted_cost": 300.0, "actual_evaluations": 401.0,
              "predicted_evaluations": 301.0, "actual_s": 6.0, "best": "verlet", "best_cost": 320.0, "regret": 1.25})"));
}

}  // namespace
}  // namespace dartboard::recommend_report_test
