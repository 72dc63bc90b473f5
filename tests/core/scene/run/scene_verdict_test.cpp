#include "core/scene/run/scene_verdict.h"
#include "benchmarks/checkout/source_folder.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "tests/support/moving_box.h"

namespace dartboard::scene_verdict_test {
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

bool holds(const Json& scene, const std::string& key, const Json& value) {
  Json expect;
  expect[key] = value;
  return only_row(scene, expect.dump().c_str()).holds;
}

// A lattice of 2 x 2 x 2 cubes: edges along the axes, across squares and across cubes; faces by Euler's formula, V - E
// + F - C = 1.
TEST(Verdict, CountsEachKindOfCellByItself) {
  constexpr int vertices = 27, edges = 3 * 2 * 9 + 3 * 3 * 4 + 8, cells = 48, faces = 1 - vertices + edges + cells;
  const std::pair<const char*, int> expected[] = {{"vertices", vertices}, {"edges", edges},  {"faces", faces},
                                                  {"cells", cells},       {"components", 1}, {"operations", 0}};
  for (const auto& [key, number] : expected) {
    EXPECT_TRUE(holds(moving_box(), key, number)) << key;
    EXPECT_FALSE(holds(moving_box(), key, number + 1)) << key;
  }
}

TEST(Verdict, CountsOperations) {
  const Json scene = with_events(moving_box(), R"([{"at": 0.001, "remove": {"ids": [0, 1, 2]}}])");
  EXPECT_TRUE(holds(scene, "operations", 3));
  EXPECT_FALSE(holds(scene, "operations", 0));
}

TEST(Verdict, MayAskForAtLeastSoManyComponents) {
  const Json scene = with_events(
      moving_box(), R"([{"at": 0, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}])");
  for (const int number : {1, 2}) EXPECT_TRUE(holds(scene, "components_at_least", number)) << number;
  EXPECT_FALSE(holds(scene, "components_at_least", 3));
}

// 48 cells of a quarter of a kilogram
TEST(Verdict, TakesAMassForAnotherFromTheTwelfthDigitOn) {
  EXPECT_TRUE(holds(moving_box(), "mass", 12.0));
  for (const double sign : {-1.0, 1.0}) {
    EXPECT_TRUE(holds(moving_box(), "mass", 12.0 * (1 + sign * 4e-12)));
    EXPECT_FALSE(holds(moving_box(), "mass", 12.0 * (1 + sign * 6e-12)));
  }
  const Json scene = with_events(moving_box(), R"([{"at": 0.001, "remove": {"ids": [7]}}])");
  EXPECT_FALSE(holds(scene, "mass", 12.0));
  EXPECT_TRUE(holds(scene, "mass", 11.75));
}

TEST(Verdict, OfNothingExpectsNoMassAtAll) {
  const Json scene =
      with_events(moving_box(), R"([{"at": 0, "remove": {"sphere": {"centre": [0, 0, 0], "radius": 9}}}])");
  EXPECT_TRUE(holds(scene, "mass", 0.0));
  EXPECT_FALSE(holds(scene, "mass", 0.25));
}

TEST(Verdict, ShowsWhatWasExpectedBesideWhatWasFound) {
  const ExpectedRow cells = only_row(moving_box(), R"({"cells": 47})");
  EXPECT_EQ(cells.expected, "47");
  EXPECT_EQ(cells.actual, "48");
  const ExpectedRow mass = only_row(moving_box(), R"({"mass": 12.5})");
  EXPECT_EQ(mass.expected, "12.5");
  EXPECT_EQ(mass.actual, "12");
}

TEST(Verdict, HasOneRowForEachThingExpectedAndNoOther) {
  Json scene = moving_box();
  scene["material"]["damping"] = scene["material"]["viscosity"] = 0;
  scene["output"]["probes"] = Json::parse(R"([{"name": "a", "vertex": 0}])");
  scene["expect"] = Json::parse(R"({"vertices": 1, "edges": 1, "faces": 1, "cells": 1, "components": 1, "operations": 1,
    "mass": 1, "kinetic_at_most": 1, "energy_drift_at_most": 1, "hash": "0000000000000001",
    "places": [{"probe": "a", "position": [0, 0, 0], "within": 1}, {"probe": "a", "position": [0, 0, 1], "within": 1}]})");
  const SceneFile file = parse(scene);
  const Simulation simulation(file);
  std::vector<std::string> what;
  for (const ExpectedRow& row : compare_with_expectation(file, simulation, {})) what.push_back(row.what);
  EXPECT_EQ(what, (std::vector<std::string>{"vertices", "edges", "faces", "cells", "components", "operations",
                                            "mass [kg]", "kinetic energy [J]", "energy drift", "place of a [m]",
                                            "place of a [m]", "hash"}));
  EXPECT_TRUE(compare_with_expectation(parse(moving_box()), simulation, {}).empty());
}

TEST(Verdict, LooksAtThePlaceOfTheProbeThatIsNamed) {
  Json scene = moving_box();
  scene["gravity"] = {0, 0, 0};
  scene.erase("initial_velocity");
  scene["output"]["probes"] = Json::parse(R"([{"name": "low", "vertex": 0}, {"name": "high", "vertex": 26}])");
  EXPECT_TRUE(
      only_row(scene, R"({"places": [{"probe": "high", "position": [0.25, 0.25, 0.5], "within": 0.25}]})").holds);
  EXPECT_FALSE(
      only_row(scene, R"({"places": [{"probe": "low", "position": [0.25, 0.25, 0.5], "within": 0.25}]})").holds);
  EXPECT_FALSE(
      only_row(scene, R"({"places": [{"probe": "high", "position": [0.25, 0.25, 0.5], "within": 0.2499}]})").holds);
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
  scene["output"]["diagnostics_every"]["steps"] = 1;
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

// The box is cut at x = 0.125 into halves of 6 kg, whose centres of mass are 0.0625 m on either side by symmetry, and
// flies on at 3 m/s for 0.01 s.
TEST(Verdict, LooksWhereTheCentreOfThePartIsThatAProbeIsIn) {
  Json scene = with_events(moving_box(),
                           R"([{"at": 0, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}])");
  scene["gravity"] = {0, 0, 0};
  scene["initial_velocity"] = {3, 0, 0};
  scene["material"]["viscosity"] = 0;
  scene["output"]["probes"] = Json::parse(R"([{"name": "left", "vertex": 0}, {"name": "right", "vertex": 26}])");
  const auto place = [&scene](const char* probe, double x, const char* of) {
    Json expect;
    expect["places"] = {{{"probe", probe}, {"position", {x, 0.125, 0.125}}, {"within", 1e-12}, {"of", of}}};
    return only_row(scene, expect.dump().c_str());
  };
  EXPECT_TRUE(place("left", 0.0925, "part").holds) << place("left", 0.0925, "part").actual;
  EXPECT_TRUE(place("right", 0.2175, "part").holds) << place("right", 0.2175, "part").actual;
  EXPECT_FALSE(place("left", 0.155, "part").holds);  // the centre of both parts
  EXPECT_FALSE(place("left", 0.0925, "vertex").holds);
  EXPECT_EQ(place("left", 0.0925, "part").what, "place of the part of left [m]");
  scene["events"][1] = Json::parse(R"({"at": 0, "remove": {"sphere": {"centre": [0, 0, 0], "radius": 9}}})");
  EXPECT_EQ(place("left", 0.0925, "part").actual, "removed");
}

// Masses of one to six cells: a vertex at a corner weighs less than the one in the middle.
TEST(Verdict, WeighsTheVerticesOfAPart) {
  Json json = moving_box();
  json["output"]["probes"] = Json::parse(R"([{"name": "corner", "vertex": 0}])");
  json["body"]["generate"]["box"]["cells"] = {1, 1, 2};
  json["events"] = Json::parse(R"([{"at": 0, "remove": {"ids": [0]}}])");
  const SceneFile scene = parse(json);
  Simulation simulation(scene);
  ASSERT_FALSE(simulation.advance());
  const SimulatedBody& body = simulation.body();
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double mass = 0.0;
  for (std::uint32_t v = 0; v < body.vertices().size(); ++v) {
    mass += body.system().mass[v];
    moment += body.system().mass[v] * body.vertices().position[v];
  }
  const auto centre = centre_of_part(body, 0);
  ASSERT_TRUE(centre);
  EXPECT_NEAR((*centre - moment / mass).norm(), 0.0, 1e-15);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& x : body.vertices().position) mean += x / static_cast<double>(body.vertices().size());
  EXPECT_GT((mean - *centre).norm(), 1e-3);
}

std::vector<std::string> names_of_gallery() {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(source_folder() / "benchmarks" / "scenes"))
    names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

class JudgedScene : public ::testing::TestWithParam<std::string> {};

TEST_P(JudgedScene, EndsAsItExpects) {
  const SceneFile scene = read_scene(source_folder() / "benchmarks" / "scenes" / (GetParam() + ".json"));
  EXPECT_FALSE(scene.expect.empty());
  if (scene.accuracy) return;  // settle_accuracy_test.cpp chooses the step of these
  Simulation simulation(scene);
  RunWatcher watcher;
  const RunResult result = run_scene(simulation, scene.output, watcher);
  ASSERT_FALSE(result.divergence) << to_string(*result.divergence);
  for (const ExpectedRow& row : compare_with_expectation(scene, simulation, result))
    EXPECT_TRUE(row.holds) << row.what << " is " << row.actual << ", expected " << row.expected;
  EXPECT_EQ(simulation.body().violation(), "");
}
INSTANTIATE_TEST_SUITE_P(Gallery, JudgedScene, ::testing::ValuesIn(names_of_gallery()),
                         [](const auto& scene) { return scene.param; });

}  // namespace
}  // namespace dartboard::scene_verdict_test
