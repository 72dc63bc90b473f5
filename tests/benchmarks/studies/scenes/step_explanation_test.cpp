// Limits of the step for bodies whose fastest oscillation is known.

#include "benchmarks/studies/scenes/step_explanation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "benchmarks/harness/table.h"
#include "core/scene/run/simulation.h"
#include "tests/support/moving_box.h"

namespace dartboard::step_explanation_test {
namespace {

using namespace moving;

/// Four equal links between two walls. Along the line its matrix over the three free masses is 2 on the diagonal and -1
/// next to it, in units of k / m: the fastest mode is (1, -sqrt 2, 1), of 2 + sqrt 2.
SceneFile chain(const char* integrator = "verlet", double step = 1e-3) {
  Json scene = Json::parse(R"({"name": "chain", "duration": 10.0,
    "body": {"generate": {"chain": {"links": 4, "spacing": 0.5}}},
    "fixed": [{"ids": [0, 4]}], "material": {"density": 2.0, "stiffness": 100.0}})");
  scene["integrator"] = integrator;
  scene["step"] = step;
  return parse(scene);
}

double remedy(const StepExplanation& e, const std::string& what) {
  for (const StepRemedy& r : e.remedies)
    if (r.what == what) return r.step;
  ADD_FAILURE() << what;
  return std::nan("");
}

TEST(StepExplanation, NamesTheSpringsAndVerticesThatTakeMostOfTheEnergyFirst) {
  const StepExplanation e = explain_step(chain());
  // the links are stretched by 1, 1 + sqrt 2, 1 + sqrt 2 and 1: shares of 0.427 and 0.073
  ASSERT_EQ(e.springs.size(), 4u);
  EXPECT_EQ(e.springs[0].number + e.springs[1].number, 1u + 2u);
  EXPECT_EQ(e.springs[2].number + e.springs[3].number, 0u + 3u);
  const double inner = std::pow(1 + std::sqrt(2.0), 2), all = 2 * inner + 2;
  for (std::size_t k = 0; k < 4; ++k) EXPECT_NEAR(e.springs[k].share, (k < 2 ? inner : 1.0) / all, 1e-9) << k;
  ASSERT_GE(e.vertices.size(), 3u);
  EXPECT_EQ(e.vertices[0].number, 2u);
  EXPECT_EQ(e.vertices[1].number + e.vertices[2].number, 1u + 3u);
  EXPECT_NEAR(e.vertices[0].share, 0.5, 1e-9);
  EXPECT_NEAR(e.vertices[1].share, 0.25, 1e-9);
}

// The remaining matrix has another largest eigenvalue, and steps vary as its inverse root. The limit of a run of N
// steps is above the 2 of Verlet's method by (ln 2 / 2 N)^2, as growth goes with the root of the excess: 92 steps of
// ten seconds are 1.4e-5, or 7e-6 of it.
TEST(StepExplanation, GivesTheStepThatEachRemedyMakesStable) {
  const StepExplanation e = explain_step(chain());
  const double before = 2.0 + std::sqrt(2.0);
  const auto expect_eigenvalue = [&](const std::string& what, double after) {
    EXPECT_NEAR(remedy(e, what) / e.limit.stable, std::sqrt(before / after), 1e-5) << what;
  };
  EXPECT_NEAR(e.limit.stable, 2.0 / std::sqrt(before * 100.0 / 1.0), 1e-5 * e.limit.stable);
  expect_eigenvalue("halve all stiffnesses", before / 2);
  expect_eigenvalue("halve the stiffness of the 4 springs", before / 2);
  expect_eigenvalue("double the mass of the 3 vertices", before / 2);
  // the other two masses, each between a wall and a wall
  expect_eigenvalue("hold the first vertex", 2.0);
  // two masses on one wall: x^2 - 3 x + 1
  expect_eigenvalue("remove the first spring", (3.0 + std::sqrt(5.0)) / 2.0);
  // the antisymmetric mode has 2; the symmetric ones (2 - x) (1 - x) = 1
  expect_eigenvalue("double the mass of the first vertex", (3.0 + std::sqrt(5.0)) / 2.0);
  EXPECT_TRUE(std::isinf(remedy(e, "remove the 4 springs")));
}

TEST(StepExplanation, CountsOneSpringAndOneVertexInTheSingular) {
  const StepExplanation e = explain_step(parse(Json::parse(R"({"name": "chain", "step": 1e-3, "duration": 10.0,
    "body": {"generate": {"chain": {"links": 1, "spacing": 0.5}}}, "integrator": "verlet",
    "fixed": [{"ids": [0]}], "material": {"density": 2.0, "stiffness": 100.0}})")));
  ASSERT_EQ(e.springs.size(), 1u);
  ASSERT_EQ(e.vertices.size(), 1u);
  for (const char* what :
       {"halve the stiffness of the 1 spring", "remove the 1 spring", "double the mass of the 1 vertex"})
    remedy(e, what);
}

TEST(StepExplanation, GoesByTheLimitOfTheSimulation) {
  const SceneFile scene = chain("rk4", 1.0);
  const Simulation simulation(scene);
  const StepExplanation e = explain_step(scene);
  EXPECT_EQ(e.limit.stable, simulation.step_limit().stable);
  EXPECT_EQ(e.limit.unstable, simulation.step_limit().unstable);
  ASSERT_TRUE(simulation.step_warning());
  EXPECT_EQ(e.limit.stable, simulation.step_warning()->stable);
  EXPECT_EQ(to_json(e, scene).at("stable_step"), e.limit.stable);
  EXPECT_EQ(to_json(e, scene).at("stable"), false);
  EXPECT_NE(to_text(e, scene).find("TOO LONG"), std::string::npos);
}

TEST(StepExplanation, IsNoneWhereThereIsNoLimit) {
  const SceneFile scene = chain("backward-euler");
  const StepExplanation e = explain_step(scene);
  EXPECT_TRUE(std::isinf(e.limit.stable));
  EXPECT_TRUE(to_json(e, scene).at("stable_step").is_null());
  EXPECT_NE(to_text(e, scene).find("stable in any"), std::string::npos);
}

/// Every field has another number.
StepExplanation distinct() {
  StepExplanation e;
  e.limits.lower = 10.0;
  e.limits.upper = 12.5;
  e.limits.any_state = 20.0;
  e.limits.damping_time = {0.01, 0.02};
  e.limits.viscous_rate = {0.0, 0.0};
  e.limit.stable = 0.25;
  e.limit.unstable = 0.5;
  e.quick = 0.125;
  e.body.add_vertex(2.0, {1, 2, 3});
  e.body.add_vertex(4.0, {1, 2, 8});
  e.body.add_vertex(6.0, {1, 4, 8});
  e.body.add_spring(0, 1, 70.0, 1.0);
  e.body.add_spring(1, 2, 80.0, 1.0);
  e.springs = {{1, 0.75}, {0, 0.25}};
  e.cells = {{9, {20, 30, 10}, 0.75, 0.125}};
  e.names = {10, 20, 30};
  e.vertices = {{2, 0.625}, {1, 0.375}};
  e.remedies = {{"cut it", 0.375}, {"cut all", Scheme::unlimited}};
  return e;
}
SceneFile scene_with(double step) {
  SceneFile scene;
  scene.name = "box";
  scene.integrator = "rk4";
  scene.step = step;
  return scene;
}

TEST(StepExplanationText, HasEveryFigureInItsPlace) {
  const StepExplanation e = distinct();
  const Bounds ratio = e.limits.damping_ratio();
  Table springs({{"spring", Align::right},
                 {"between"},
                 {"stiffness [N/m]", Align::right},
                 {"length [m]", Align::right},
                 {"share", Align::right}});
  springs.add_row({"1", "20 and 30", "80", "2", "75.0 %"});
  springs.add_row({"0", "10 and 20", "70", "5", "25.0 %"});
  Table cells({{"cell", Align::right}, {"corners"}, {"least width [m]", Align::right}, {"share", Align::right}});
  cells.add_row({"9", "20, 30, 10", "0.75", "12.5 %"});
  Table vertices({{"vertex", Align::right}, {"mass [kg]", Align::right}, {"at [m]"}, {"share", Align::right}});
  vertices.add_row({"30", "6", "1, 4, 8", "62.5 %"});
  vertices.add_row({"20", "4", "1, 2, 8", "37.5 %"});
  Table remedies({{"if one would"}, {"stable step", Align::right}, {"gain", Align::right}});
  remedies.add_row({"cut it", "0.375 s", "+50.0 %"});
  remedies.add_row({"cut all", "any", ""});
  EXPECT_LT(ratio.lower, ratio.upper);
  EXPECT_EQ(to_text(e, scene_with(0.0625)),
            "box\nrk4, h = 0.0625 s\n\nhighest frequency: 10 to 12.5 1/s (in any state at most 20)\n" +
                fmt::format("damping ratio there: {:.3g} to {:.3g}\n", ratio.lower, ratio.upper) +
                "longest stable step in the state at the start: 0.25 s (certainly below 0.5 s), in any state at least "
                "0.125 s; the scene's is stable in any\n\nShares of the energy of the fastest oscillation:\n\n" +
                to_text(springs) + "\n" + to_text(cells) + "\n" + to_text(vertices) + "\n" + to_text(remedies));
}

TEST(StepExplanationText, CallsTheStepStableWhereItIs) {
  const auto verdict = [](double step) {
    const std::string text = to_text(distinct(), scene_with(step));
    const std::size_t start = text.find("the scene's is ") + 15;
    return text.substr(start, text.find('\n', start) - start);
  };
  EXPECT_EQ(verdict(0.125), "stable in any");
  EXPECT_EQ(verdict(0.126), "stable at the start");
  EXPECT_EQ(verdict(0.25), "stable at the start");
  EXPECT_EQ(verdict(0.251), "TOO LONG");
}

TEST(StepExplanationText, SaysNothingOfACertainLimitWhereThereIsNone) {
  StepExplanation e = distinct();
  e.limit.unstable = Scheme::unlimited;
  e.vertices.clear();
  const std::string text = to_text(e, scene_with(1.0));
  EXPECT_NE(text.find("at the start: 0.25 s, in any state"), std::string::npos) << text;
  EXPECT_EQ(text.find("Shares"), std::string::npos) << text;
}

TEST(StepExplanationJson, HoldsEveryFigure) {
  const StepExplanation e = distinct();
  const Bounds ratio = e.limits.damping_ratio();
  nlohmann::ordered_json expected = nlohmann::ordered_json::parse(R"({"scene": "box", "integrator": "rk4",
    "step": 0.0625, "stable": true, "stable_step": 0.25, "unstable_step": 0.5, "stable_step_quick": 0.125,
    "omega_max": {"lower": 10.0, "upper": 12.5, "any_state": 20.0}, "damping_ratio": {},
    "springs": [{"spring": 1, "ends": [20, 30], "stiffness": 80.0, "share": 0.75},
      {"spring": 0, "ends": [10, 20], "stiffness": 70.0, "share": 0.25}],
    "cells": [{"cell": 9, "corners": [20, 30, 10], "least_width": 0.75, "share": 0.125}],
    "vertices": [{"vertex": 30, "mass": 6.0, "share": 0.625}, {"vertex": 20, "mass": 4.0, "share": 0.375}],
    "remedies": [{"what": "cut it", "stable_step": 0.375}, {"what": "cut all", "stable_step": null}]})");
  expected["damping_ratio"] = {{"lower", ratio.lower}, {"upper", ratio.upper}};
  EXPECT_EQ(to_json(e, scene_with(0.0625)), expected);
  EXPECT_EQ(to_json(e, scene_with(0.251)).at("stable"), false);
}

// Five cubes in a row, the middle one a thousand times as stiff as the others.
TEST(StepExplanation, NamesTheElementThatTakesMostOfTheEnergyAndItsCornersAsTheMeshDoes) {
  for (const char* kind : {"hexahedra", "tetrahedra"}) {
    Json json = Json::parse(R"({"name": "bar", "duration": 1.0, "step": 1e-4, "integrator": "verlet",
      "body": {"generate": {"box": {"cells": [5, 1, 1], "spacing": 0.1}}},
      "material": {"density": 1000, "young": 1e4, "poisson": 0.3},
      "regions": [{"cells": {"box": {"min": [0.2, 0, 0], "max": [0.3, 0.1, 0.1]}},
                   "material": {"density": 1000, "young": 1e7, "poisson": 0.3}}]})");
    json["body"]["generate"]["box"]["kind"] = kind;
    const StepExplanation e = explain_step(parse(json));
    ASSERT_FALSE(e.cells.empty()) << kind;
    EXPECT_TRUE(e.springs.empty()) << kind;
    double sum = 0.0;
    for (const CellStepShare& cell : e.cells) {
      sum += cell.share;
      if (cell.share < 0.01) continue;
      for (const std::uint32_t corner : cell.corners) EXPECT_TRUE(corner % 6 == 2 || corner % 6 == 3) << kind;
    }
    EXPECT_GT(sum, 0.9) << kind;  // five of six tetrahedra are named
    EXPECT_LE(sum, 1.0 + 1e-12) << kind;
    // each of the six tetrahedra of a cube has two sides of half the section along a diagonal: 3 V / A
    EXPECT_NEAR(e.cells[0].width, kind == std::string("hexahedra") ? 0.1 : 0.1 / std::sqrt(2.0), 1e-9) << kind;
    EXPECT_GT(remedy(e, "double the mass of the first vertex"), e.limit.stable) << kind;
  }
}

// A vertex with a spring along each axis: the mode along the stiffest is gone if that axis is held.
TEST(StepExplanation, KnowsOfHeldAxes) {
  Json json = Json::parse(R"({"name": "chain", "duration": 10.0, "step": 1e-3, "integrator": "verlet",
    "body": {"generate": {"chain": {"links": 2, "spacing": 0.5}}},
    "fixed": [{"ids": [0, 2]}], "material": {"density": 2.0, "stiffness": 100.0}})");
  const StepExplanation free = explain_step(parse(json));
  EXPECT_EQ(free.vertices.size(), 1u);
  json["fixed"].push_back({{"ids", {1}}, {"axes", {"x"}}});  // nothing holds it across the links
  EXPECT_GT(explain_step(parse(json)).limit.stable, 1e3 * free.limit.stable);
}

TEST(StepExplanation, IsOfAStepThatTheSceneRefuses) {
  SceneFile scene = chain("rk4", 1.0);
  scene.unstable_step = UnstableStep::refuse;
  EXPECT_LT(explain_step(scene).limit.stable, 1.0);
}

TEST(StepExplanation, RefusesContactWhichNoSpringIsToBlameFor) {
  Json scene = moving_box();
  scene["contact"] = Json::parse(R"({"pressure": 1, "depth": 1,
                                     "obstacles": [{"sphere": {"centre": [9, 9, 9], "radius": 1}}]})");
  try {
    explain_step(parse(scene));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string(error.what()).starts_with("file: /contact: a body that touches something is stiffer there"))
        << error.what();
  }
}

}  // namespace
}  // namespace dartboard::step_explanation_test
