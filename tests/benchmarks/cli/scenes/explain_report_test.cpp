// The report of `explain` on a plan: every figure in its own place.

#include "benchmarks/cli/scenes/explain_report.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "benchmarks/harness/table.h"

namespace dartboard::explain_report_test {
namespace {

using Json = nlohmann::ordered_json;

SceneFile scene() {
  SceneFile s;
  s.name = "box";
  s.integrator = "rk4";
  s.step = 0.125;
  return s;
}

ScenePlan plan() {
  ScenePlan p;
  p.map = "general 3-g-map";
  p.counts.vertices = 11;
  p.counts.edges = 12;
  p.counts.faces = 13;
  p.counts.cells = 14;
  p.darts = 15;
  p.steps = 16;
  p.items = {{.part = Part::map, .what = "alphas", .why = "/events", .bytes = 100},
             {.part = Part::marks, .what = "stamps", .why = "/output", .bytes = 20}};
  p.left_out = {{"viscosity", "there is none"}};
  p.selections = {{.path = "/fixed/0", .of_what = "vertices", .selected = 3, .all = 11, .just_outside = 1}};
  p.remarks = {"the mesh leans"};
  return p;
}

ScenePlan with_unplanned_springs() {
  ScenePlan p = plan();
  p.unplanned = {{Part::springs, 8}};
  return p;
}

const std::string heading =
    "box\ngeneral 3-g-map; 11 vertices, 12 edges, 13 faces, 14 cells, 15 darts; 16 steps of "
    "0.125 s\n/fixed/0: 3 of 11 vertices\nthe mesh leans\n\n";

std::string left_out_table() {
  Table table({{"left out"}, {"because"}});
  table.add_row({"viscosity", "there is none"});
  return to_text(table);
}

TEST(ExplainText, HasARowForEachPartAndOneForAll) {
  Table table({{"part"}, {"bytes", Align::right}, {"what"}, {"why"}});
  table.add_row({"map", "100", "alphas", "/events"});
  table.add_row({"marks", "20", "stamps", "/output"});
  table.add_row({"in all", "120", "", ""});
  const std::string text = to_text(scene(), plan(), std::nullopt);
  EXPECT_TRUE(text.starts_with(heading + to_text(table) + "\n" + left_out_table() + "\nBytes are those")) << text;
  EXPECT_TRUE(text.ends_with("of a factor, its numbers.\n")) << text;
}

TEST(ExplainText, CountsOneThingInTheSingular) {
  ScenePlan p = plan();
  p.counts.edges = p.counts.faces = p.counts.cells = 1;
  p.darts = p.steps = 1;
  const std::string text = to_text(scene(), p, MeasuredSteps{1, 50.0});
  EXPECT_TRUE(
      text.starts_with("box\ngeneral 3-g-map; 11 vertices, 1 edge, 1 face, 1 cell, 1 dart; 1 step of 0.125 s\n"))
      << text;
  EXPECT_NE(text.find("over all of 1 step; the median"), std::string::npos) << text;
}

TEST(ExplainText, HasWhatNoItemPlans) {
  Table table({{"part"}, {"bytes", Align::right}, {"what"}, {"why"}});
  table.add_row({"map", "100", "alphas", "/events"});
  table.add_row({"marks", "20", "stamps", "/output"});
  table.add_row({"springs", "8", "NOT PLANNED", ""});
  table.add_row({"in all", "128", "", ""});
  const std::string text = to_text(scene(), with_unplanned_springs(), std::nullopt);
  EXPECT_TRUE(text.starts_with(heading + to_text(table) + "\n" + left_out_table() + "\nBytes")) << text;
}

TEST(ExplainText, EndsWithTheTimeThatWasMeasured) {
  const auto ends_with = [](const MeasuredSteps& measured, const std::string& words) {
    const std::string text = to_text(scene(), plan(), measured);
    EXPECT_TRUE(text.ends_with("\nMeasured: 50 ns of processor time per step, with events and output, over " + words +
                               "; the median of three runs.\n"))
        << text;
  };
  ends_with({16, 50.0}, "all of 16 steps");
  ends_with({12, 50.0}, "the first 12 of 16 steps");
}

SceneFile with_floor() {
  SceneFile s = scene();
  SceneObstacle floor{.obstacle = {}, .law = {}, .path = "/contact/obstacles/0"};
  floor.law.pressure = 2000;
  floor.law.depth = 0.002;
  s.obstacles = {floor};
  return s;
}
ScenePlan touching() {
  ScenePlan p = plan();
  p.contact = {
      .expected =
          {{{.mass_behind = 100, .depth_at_rest = 0.0014, .speed = 3, .depth_at_impact = 0.0035, .share = 1.75}}, {}},
      .body_rate = 900,
      .contact_rate = 1000,
      .body_step = 0.002,
      .stable_step = 0.001};
  return p;
}

/// One contact as in `touching`.
std::string contact_table(const std::string& key, const std::string& path) {
  Table table({{key},
               {"carries"},
               {"mass behind kg/m^2", Align::right},
               {"depth at rest m", Align::right},
               {"impact m/s", Align::right},
               {"depth at impact m", Align::right},
               {"over that of its law", Align::right}});
  table.add_row({path, "2000 Pa at 0.002 m", "100", "0.0014", "3", "0.0035", "1.75"});
  return to_text(table);
}

TEST(ExplainText, TellsHowDeepContactsWillBeAndWhichStepTheyAllow) {
  const std::string text = to_text(with_floor(), touching(), std::nullopt);
  const auto has = [&text](const std::string& words) { return text.find(words) != std::string::npos; };
  EXPECT_TRUE(has(contact_table("obstacle", "/contact/obstacles/0") +
                  "The longest stable step at these depths is 0.001 s, which the stiffness of the "
                  "contact limits; of the body alone 0.002 s. Depths are those of a column"))
      << text;
  ScenePlan stiff = touching();
  stiff.contact->body_rate = 1100;
  EXPECT_NE(to_text(with_floor(), stiff, std::nullopt).find("0.001 s, which the body limits"), std::string::npos);
  stiff.contact->body_step = stiff.contact->stable_step = std::numeric_limits<double>::infinity();
  EXPECT_NE(to_text(with_floor(), stiff, std::nullopt).find("Every step is stable with rk4."), std::string::npos);
}

/// With bodies that touch in place of the floor.
ScenePlan touching_bodies() {
  ScenePlan p = touching();
  p.contact->expected.obstacles.clear();
  TouchForecast touch{.path = "/contact/pairs/1", .law = {}, .first = 0, .second = 2, .contact = {}};
  touch.law.pressure = 2000;
  touch.law.depth = 0.002;
  touch.contact = touching().contact->expected.obstacles[0];
  p.contact->expected.bodies = {touch};
  return p;
}

TEST(ExplainText, TellsOfBodiesThatTouchByTheirKey) {
  const std::string text = to_text(scene(), touching_bodies(), std::nullopt);
  EXPECT_NE(text.find(contact_table("key", "/contact/pairs/1") + "The longest stable step"), std::string::npos) << text;
}

TEST(ExplainJson, HoldsTheFiguresOfBodiesThatTouch) {
  const Json contact = to_json(scene(), touching_bodies(), std::nullopt).at("contact");
  EXPECT_FALSE(contact.contains("obstacles"));
  EXPECT_EQ(contact.at("bodies"), Json::parse(R"([{"path": "/contact/pairs/1", "of": [0, 2], "mass_behind": 100.0,
    "depth_at_rest": 0.0014, "speed": 3.0, "depth_at_impact": 0.0035, "allowed_depth": 0.002}])"));
}

SceneFile with_sleep() {
  SceneFile s = scene();
  s.sleep = {.speed = 0.5, .time = 0.25};
  return s;
}

TEST(ExplainText, SaysWhenComponentsArePutToSleepAndWhatThatRemoves) {
  const std::string text = to_text(with_sleep(), plan(), std::nullopt);
  EXPECT_NE(
      text.find(left_out_table() +
                "\nA component is put to sleep when none of its vertices has been faster than 0.5 m/s for 0.25 s; "
                "at most 0.125 J of kinetic energy per kg are removed each time.\n\nBytes are those"),
      std::string::npos)
      << text;
}

TEST(ExplainJson, HoldsWhenComponentsArePutToSleep) {
  EXPECT_EQ(to_json(with_sleep(), plan(), std::nullopt).at("sleep"),
            Json::parse(R"({"speed": 0.5, "time": 0.25, "removed_per_kg_at_most": 0.125})"));
}

Json expected() {
  return Json::parse(R"({"scene": "box", "map": "general 3-g-map", "integrator": "rk4", "steps": 16,
    "counts": {"vertices": 11, "edges": 12, "faces": 13, "cells": 14, "darts": 15}, "bytes": 120,
    "selections": [{"path": "/fixed/0", "of_what": "vertices", "selected": 3, "all": 11, "just_outside": 1, "along": ""}],
    "remarks": ["the mesh leans"],
    "left_out": [{"what": "viscosity", "why": "there is none"}],
    "plan": [{"part": "map", "what": "alphas", "why": "/events", "bytes": 100},
      {"part": "marks", "what": "stamps", "why": "/output", "bytes": 20}]})");
}

TEST(ExplainJson, HoldsEveryFigureOfThePlan) { EXPECT_EQ(to_json(scene(), plan(), std::nullopt), expected()); }

TEST(ExplainJson, HoldsTheFiguresOfContact) {
  EXPECT_EQ(to_json(with_floor(), touching(), std::nullopt).at("contact"), Json::parse(R"({"stable_step": 0.001,
    "stable_step_of_body": 0.002, "contact_rate": 1000.0, "body_rate": 900.0,
    "obstacles": [{"path": "/contact/obstacles/0", "mass_behind": 100.0, "depth_at_rest": 0.0014, "speed": 3.0,
                   "depth_at_impact": 0.0035, "allowed_depth": 0.002}]})"));
  ScenePlan implicit = touching();
  implicit.contact->stable_step = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(to_json(with_floor(), implicit, std::nullopt).at("contact").at("stable_step").is_null());
}

TEST(ExplainJson, HoldsWhatWasMeasuredAndWhatNoItemPlans) {
  Json json = expected();
  json["bytes"] = 128;
  json["unplanned"] = Json::parse(R"([{"part": "springs", "bytes": 8}])");
  json["measured"] = Json::parse(R"({"ns_per_step": 50.0, "steps": 12})");
  EXPECT_EQ(to_json(scene(), with_unplanned_springs(), MeasuredSteps{12, 50.0}), json);
}

}  // namespace
}  // namespace dartboard::explain_report_test
