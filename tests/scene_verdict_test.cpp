#include "core/scene/scene_verdict.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <map>

#include "tests/moving_box.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;
using namespace moving;

TEST(Verdict, HoldsWhereTheEndIsAsExpectedAndNotElsewhere) {
  Json scene = moving_box();
  scene["expect"] = Json::parse(R"({"vertices": 27, "cells": 47, "components": 1, "mass": 12, "operations": 0})");
  const SceneFile file = parse(scene);
  const Simulation simulation(file);
  std::map<std::string, bool> holds;
  for (const ExpectedRow& row : compare_with_expectation(file, simulation, {})) holds[row.what] = row.holds;
  EXPECT_EQ(
      holds,
      (std::map<std::string, bool>{
          {"vertices", true}, {"cells", false}, {"components", true}, {"mass [kg]", true}, {"operations", true}}));
}

TEST(Verdict, TellsHashesApartByOneBit) {
  SceneFile scene = parse(moving_box());
  const Simulation simulation(scene);
  scene.expect.hash = simulation.body().state_hash();
  EXPECT_TRUE(compare_with_expectation(scene, simulation, {}).at(0).holds);
  scene.expect.hash = *scene.expect.hash ^ 1u;
  EXPECT_FALSE(compare_with_expectation(scene, simulation, {}).at(0).holds);
}

ExpectedRow only_row(Json scene, const char* expect) {
  scene["expect"] = Json::parse(expect);
  const SceneFile file = parse(scene);
  Simulation simulation(file);
  RunWatcher watcher;
  const RunResult result = run_scene(simulation, file.output, watcher);
  return compare_with_expectation(file, simulation, result).at(0);
}

TEST(Verdict, BoundsTheKineticEnergyAtTheEnd) {
  Json scene = moving_box();
  scene["gravity"] = {0, 0, 0};
  scene["initial_velocity"] = {3, 0, 0};
  scene["material"]["viscosity"] = 0;
  // 12 kg at 3 m/s, undisturbed: 54 J, masses and velocity without rounding
  EXPECT_TRUE(only_row(scene, R"({"kinetic_at_most": 54.001})").holds);
  EXPECT_FALSE(only_row(scene, R"({"kinetic_at_most": 53.999})").holds);
}

TEST(Verdict, BoundsTheDriftOfTheEnergyInAnyRowOfTheDiagnostics) {
  Json scene = moving_box();
  scene["material"]["viscosity"] = scene["material"]["damping"] = 0;
  scene["output"]["diagnostics_every_steps"] = 1;
  scene["duration"] = 0.2;
  // explicit Euler multiplies the energy of an oscillation by 1 + (h omega)^2 in each step, Verlet keeps it
  scene["integrator"] = "explicit-euler";
  const ExpectedRow euler = only_row(scene, R"({"energy_drift_at_most": 1e-3})");
  EXPECT_FALSE(euler.holds) << euler.actual;
  scene["integrator"] = "blanes-moan-4";
  const ExpectedRow symplectic = only_row(scene, R"({"energy_drift_at_most": 1e-3})");
  EXPECT_TRUE(symplectic.holds) << symplectic.actual;
}

TEST(Verdict, LooksWhereProbesAre) {
  Json scene = moving_box();
  scene["gravity"] = {0, 0, 0};
  scene["initial_velocity"] = {3, 0, 0};
  scene["material"]["viscosity"] = 0;
  scene["output"]["probes"] = Json::parse(R"([{"name": "corner", "vertex": 0}])");
  // a free flight of 0.01 s
  EXPECT_TRUE(only_row(scene, R"({"places": [{"probe": "corner", "position": [0.03, 0, 0], "within": 1e-12}]})").holds);
  EXPECT_FALSE(
      only_row(scene, R"({"places": [{"probe": "corner", "position": [0.03, 0.1, 0], "within": 0.09}]})").holds);
  scene["events"] = Json::parse(R"([{"at": 0, "remove": {"sphere": {"centre": [0, 0, 0], "radius": 9}}}])");
  EXPECT_EQ(only_row(scene, R"({"places": [{"probe": "corner", "position": [0, 0, 0], "within": 9}]})").actual,
            "removed");
}

TEST(Scenes, OfTheProjectEndAsTheyExpect) {
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(DARTBOARD_SOURCE_DIR) / "benchmarks" / "scenes")) {
    const SceneFile scene = read_scene(entry.path());
    if (scene.accuracy) continue;  // settle_accuracy_test.cpp chooses its step
    ++count;
    EXPECT_FALSE(scene.expect.empty()) << entry.path();
    Simulation simulation(scene);
    RunWatcher watcher;
    const RunResult result = run_scene(simulation, scene.output, watcher);
    ASSERT_FALSE(result.divergence) << entry.path() << ": " << to_string(*result.divergence);
    for (const ExpectedRow& row : compare_with_expectation(scene, simulation, result))
      EXPECT_TRUE(row.holds) << entry.path() << ": " << row.what << " is " << row.actual << ", expected "
                             << row.expected;
    EXPECT_EQ(simulation.body().violation(), "") << entry.path();
  }
  EXPECT_GE(count, 5u);
}

}  // namespace
}  // namespace dartboard
