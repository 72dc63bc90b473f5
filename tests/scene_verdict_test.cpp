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
  for (const ExpectedRow& row : compare_with_expectation(file.expect, simulation)) holds[row.what] = row.holds;
  EXPECT_EQ(
      holds,
      (std::map<std::string, bool>{
          {"vertices", true}, {"cells", false}, {"components", true}, {"mass [kg]", true}, {"operations", true}}));
}

TEST(Verdict, TellsHashesApartByOneBit) {
  Expectation expect;
  const Simulation simulation(parse(moving_box()));
  expect.hash = simulation.body().state_hash();
  EXPECT_TRUE(compare_with_expectation(expect, simulation).at(0).holds);
  expect.hash = *expect.hash ^ 1u;
  EXPECT_FALSE(compare_with_expectation(expect, simulation).at(0).holds);
}

TEST(Scenes, OfTheProjectEndAsTheyExpect) {
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(DARTBOARD_SOURCE_DIR) / "benchmarks" / "scenes")) {
    const SceneFile scene = read_scene(entry.path());
    if (scene.accuracy) continue;  // settle_accuracy_test.cpp chooses its step
    ++count;
    EXPECT_FALSE(scene.expect.empty()) << entry.path();
    Simulation simulation(scene);
    while (simulation.steps_done() < simulation.step_count()) {
      const auto divergence = simulation.advance();
      ASSERT_FALSE(divergence) << entry.path() << ": " << to_string(*divergence);
    }
    for (const ExpectedRow& row : compare_with_expectation(scene.expect, simulation))
      EXPECT_TRUE(row.holds) << entry.path() << ": " << row.what << " is " << row.actual << ", expected "
                             << row.expected;
    EXPECT_EQ(simulation.body().violation(), "") << entry.path();
  }
  EXPECT_GE(count, 5u);
}

}  // namespace
}  // namespace dartboard
