// Components at rest that are not stepped: what falls asleep, what wakes it, and what is left unchanged.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tests/support/moving_box.h"
#include "tests/support/run_in_memory.h"

namespace dartboard::sleeping_test {
namespace {

using namespace moving;
using Eigen::Vector3d;

constexpr std::uint32_t points_of_one = 27;

/// Two cubes of 0.1 m and 1 kg, one at rest and one at a distance to the right of it. Nothing pulls at them.
Json two_cubes(double apart) {
  Json scene = Json::parse(R"({"name": "two cubes", "step": 0.0002, "duration": 0.02, "integrator": "verlet",
    "bodies": [{"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.05, "pattern": "kuhn"}}},
               {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.05, "pattern": "kuhn"}}}],
    "material": {"density": 1000, "young": 200000, "damping": 0, "viscosity": 0}, "gravity": [0, 0, 0],
    "sleep": {"speed": 1e-3, "time": 0.002}})");
  scene["bodies"][1]["translate"] = {0.1 + apart, 0.01, 0.012};
  return scene;
}
Json with_velocity(Json scene, int body, const Vector3d& v) {
  scene["bodies"][body]["initial_velocity"] = {v.x(), v.y(), v.z()};
  return scene;
}
Json touching(Json scene) {
  scene["contact"] = {{"pressure", 4000}, {"depth", 0.002}, {"bodies", "others"}};
  return scene;
}
/// A cube that vibrates, far from one at rest.
Json beside_a_vibrating_one() {
  Json scene = two_cubes(1.0);
  scene["bodies"][1]["initial_velocity"] =
      Json::parse(R"({"linear": [[1, 0.2, 0], [0, -1, 0], [0, 0.3, 0.5]], "centre": [1.15, 0.06, 0.062]})");
  return scene;
}
/// A cube on a floor, with drag.
Json on_a_floor() {
  Json scene = two_cubes(1.0);
  scene["bodies"].erase(1);
  scene["material"]["viscosity"] = 30;
  scene["gravity"] = {0, 0, -9.81};
  scene["step"] = 0.0005;
  scene["duration"] = 1.5;
  scene["sleep"] = Json::parse(R"({"speed": 1e-4, "time": 0.02})");
  scene["contact"] = Json::parse(R"({"pressure": 4000, "depth": 0.002,
    "obstacles": [{"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}]})");
  return scene;
}

std::vector<Vector3d> places_of(const Simulation& simulation, std::uint32_t body) {
  std::vector<Vector3d> places;
  const VertexColumns& v = simulation.body().vertices();
  for (std::uint32_t k = 0; k < v.size(); ++k)
    if (v.point[k] / points_of_one == body) places.push_back(v.position[k]);
  return places;
}
std::size_t asleep(const Simulation& simulation) { return simulation.diagnostics().sleep->asleep; }
void take_steps(Simulation& simulation, int steps) {
  for (int k = 0; k < steps; ++k) ASSERT_FALSE(simulation.advance());
}
double lowest(const std::vector<Vector3d>& places) {
  double z = places[0].z();
  for (const Vector3d& p : places) z = std::min(z, p.z());
  return z;
}

// ---- falling asleep

// 0.002 s are ten steps: the eleventh boundary at which it is slow is as long after the first.
TEST(Sleeping, BeginsOnceAComponentHasBeenSlowForTheTime) {
  Simulation simulation(parse(beside_a_vibrating_one()));
  take_steps(simulation, 10);
  EXPECT_EQ(asleep(simulation), 0u);
  take_steps(simulation, 1);
  EXPECT_EQ(asleep(simulation), 1u);
}

TEST(Sleeping, IsNotForOneThatIsFasterThanTheSpeed) {
  Simulation simulation(parse(with_velocity(beside_a_vibrating_one(), 0, {1.001e-3, 0, 0})));
  run(simulation);
  EXPECT_EQ(asleep(simulation), 0u);
}

TEST(Sleeping, KeepsThePlacesOfASleeper) {
  Simulation simulation(parse(with_velocity(beside_a_vibrating_one(), 0, {5e-4, 0, 0})));
  take_steps(simulation, 11);
  const auto places = places_of(simulation, 0);
  run(simulation);
  EXPECT_EQ(places_of(simulation, 0), places);
  for (std::uint32_t k = 0; k < points_of_one; ++k)
    EXPECT_EQ(simulation.body().vertices().velocity[k], Vector3d(0, 0, 0));
}

TEST(Sleeping, ReportsTheKineticEnergyThatItRemoves) {
  Simulation simulation(parse(with_velocity(beside_a_vibrating_one(), 0, {5e-4, 0, 0})));
  run(simulation);
  EXPECT_NEAR(simulation.diagnostics().sleep->removed, 0.5 * 1.0 * 2.5e-7, 1e-15);
  EXPECT_EQ(simulation.diagnostics().sleep->slept, 1u);
}

TEST(Sleeping, IsOfAllThatAreNearEachOtherOrOfNone) {
  Json scene = touching(beside_a_vibrating_one());
  scene["bodies"][1]["translate"] = {0.101, 0, 0};
  scene["bodies"][1]["initial_velocity"]["centre"] = {0.151, 0.05, 0.05};
  Simulation near(parse(scene));
  take_steps(near, 20);
  EXPECT_EQ(near.diagnostics().sleep->slept, 0u);
  scene["contact"]["bodies"] = "themselves";  // the two do not touch each other
  Simulation apart(parse(scene));
  take_steps(apart, 20);
  EXPECT_EQ(asleep(apart), 1u);
}

// At the top of its flight a body is slower than 0.001 m/s for 0.000204 s.
TEST(Sleeping, IsNotForABodyAtTheTopOfItsFlight) {
  Json scene = with_velocity(two_cubes(1.0), 0, {0, 0, 0.05});
  scene["bodies"].erase(1);
  scene["gravity"] = {0, 0, -9.81};
  scene["sleep"]["time"] = 0.000205;
  scene["step"] = 1e-5;
  scene["duration"] = 0.008;
  Simulation simulation(parse(scene));
  run(simulation);
  EXPECT_EQ(simulation.diagnostics().sleep->slept, 0u);
}

TEST(Sleeping, IsNotForABodyThatIsDrivenSlowly) {
  Json scene = two_cubes(1.0);
  scene["driven"] =
      Json::parse(R"([{"plane": {"point": [0, 0, 0.1], "normal": [0, 0, 1]}, "velocity": [0, 0, 5e-4]}])");
  scene["bodies"].erase(1);
  Simulation simulation(parse(scene));
  run(simulation);
  EXPECT_EQ(simulation.diagnostics().sleep->slept, 0u);
  EXPECT_NEAR(simulation.body().vertices().position[26].z(), 0.1 + 5e-4 * 0.02, 1e-12);
}

TEST(Sleeping, IsNotForABodyOnAFloorThatRisesSlowly) {
  Json scene = on_a_floor();
  scene["contact"]["obstacles"][0]["velocity"] = {0, 0, 5e-5};
  Simulation simulation(parse(scene));
  run(simulation);
  EXPECT_EQ(simulation.diagnostics().sleep->slept, 0u);
}

TEST(Sleeping, OfAllThatThereIsTakesNoForceEvaluation) {
  Json scene = on_a_floor();
  Simulation simulation(parse(scene));
  while (asleep(simulation) == 0) ASSERT_FALSE(simulation.advance());
  const auto evaluations = simulation.work().force_evaluations;
  const std::uint64_t hash = simulation.body().state_hash();
  run(simulation);
  EXPECT_EQ(simulation.work().force_evaluations, evaluations);
  EXPECT_EQ(simulation.body().state_hash(), hash);
}

// ---- what is awake

TEST(Sleeping, LeavesTheBitsOfWhatIsAwake) {
  for (const char* integrator : {"rk4", "verlet", "symplectic-euler", "blanes-moan-4", "explicit-euler"})
    for (const char* model : {"springs", "neo-hookean"}) {
      Json scene = beside_a_vibrating_one();
      scene["integrator"] = integrator;
      if (model == std::string("neo-hookean"))
        scene["material"] = Json::parse(R"({"density": 1000, "young": 200000, "poisson": 0.3, "viscosity": 0})");
      Simulation with(parse(scene));
      run(with);
      EXPECT_EQ(asleep(with), 1u);
      scene.erase("sleep");
      Simulation without(parse(scene));
      run(without);
      EXPECT_EQ(places_of(with, 1), places_of(without, 1)) << integrator << ", " << model;
    }
}

// Friction starts from the forces of the step before, whatever number a place of the surface has then.
TEST(Sleeping, LeavesTheBitsOfABodyThatSlides) {
  Json scene = with_velocity(two_cubes(1.0), 1, {0.5, 0.1, 0});
  scene["bodies"][1]["translate"][2] = -0.0005;
  scene["gravity"] = {0, 0, -9.81};
  scene["fixed"] = Json::parse(R"([{"box": {"min": [-1, -1, -1], "max": [0.5, 1, 1]}}])");
  scene["contact"] = Json::parse(R"({"pressure": 4000, "depth": 0.002, "restitution": 0.5, "friction": 0.3,
    "bodies": "others", "obstacles": [{"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}]})");
  Simulation with(parse(scene));
  run(with);
  EXPECT_EQ(asleep(with), 1u);
  EXPECT_GT(with.diagnostics().contact->rubbed, 0.0);
  scene.erase("sleep");
  Simulation without(parse(scene));
  run(without);
  EXPECT_EQ(places_of(with, 1), places_of(without, 1));
}

TEST(Sleeping, LeavesTheBitsOfABodyThatSlidesOnAnother) {
  Json scene = two_cubes(1.0);
  scene["bodies"][2] = scene["bodies"][1];  // under the second, which is pressed into it
  scene["bodies"][2]["translate"][2] = 0.012 - 0.0995;
  scene = with_velocity(scene, 1, {0.02, 0.01, 0});
  scene["gravity"] = {0, 0, -9.81};
  scene["fixed"] = Json::parse(R"([{"box": {"min": [-1, -1, -1], "max": [0.5, 1, 1]}},
                                   {"box": {"min": [0.5, -1, -1], "max": [2, 1, -0.08]}}])");
  scene["contact"] = Json::parse(R"({"pressure": 4000, "depth": 0.002, "friction": 2.0, "bodies": "others"})");
  Simulation with(parse(scene));
  run(with);
  EXPECT_EQ(asleep(with), 1u);
  EXPECT_GT(with.diagnostics().contact->rubbed, 0.0);
  scene.erase("sleep");
  Simulation without(parse(scene));
  run(without);
  EXPECT_EQ(places_of(with, 1), places_of(without, 1));
}

// Implicit methods order their unknowns by the whole system, and end within rounding. One of several steps starts anew
// with a step of a lower order.
TEST(Sleeping, LeavesTheMotionOfWhatIsAwakeWithEveryIntegrator) {
  for (const char* integrator : {"backward-euler", "implicit-midpoint", "bdf2", "sdirk2", "ros2", "baraff-witkin",
                                 "energy-momentum", "local-global", "verlet-compensated", "dormand-prince-54"}) {
    Json scene = beside_a_vibrating_one();
    scene["integrator"] = integrator;
    Simulation with(parse(scene));
    run(with);
    EXPECT_EQ(asleep(with), 1u) << integrator;
    scene.erase("sleep");
    Simulation without(parse(scene));
    run(without);
    const auto one = places_of(with, 1), other = places_of(without, 1);
    for (std::size_t k = 0; k < one.size(); ++k)
      EXPECT_LT((one[k] - other[k]).norm(), integrator == std::string("bdf2") ? 5e-6 : 1e-9) << integrator;
  }
}

// ---- waking

// One at rest has no speed to lose: the collision is that of a run without sleep.
TEST(Sleeping, EndsBeforeABodyTouches) {
  Json scene = touching(with_velocity(two_cubes(0.02), 1, {-1, 0, 0}));
  scene["duration"] = 0.05;
  Simulation with(parse(scene));
  take_steps(with, 20);
  EXPECT_EQ(asleep(with), 1u);
  run(with);
  EXPECT_EQ(with.diagnostics().sleep->woken, 1u);
  scene.erase("sleep");
  Simulation without(parse(scene));
  run(without);
  for (std::uint32_t body : {0u, 1u}) {
    const auto one = places_of(with, body), other = places_of(without, body);
    for (std::size_t k = 0; k < one.size(); ++k) EXPECT_LT((one[k] - other[k]).norm(), 1e-12);
  }
  EXPECT_GT(places_of(with, 0)[0].norm(), 1e-3);  // it has been pushed
}

TEST(Sleeping, EndsForAllThatRestOnEachOther) {
  Json scene = touching(two_cubes(0.0005));
  scene["bodies"].push_back(scene["bodies"][0]);
  scene["bodies"][1]["translate"] = {0.1005, 0, 0};
  scene["bodies"][2]["translate"] = {0.221, 0, 0};
  scene = with_velocity(scene, 2, {-1, 0, 0});
  scene["duration"] = 0.05;
  Simulation simulation(parse(scene));
  take_steps(simulation, 11);
  EXPECT_EQ(asleep(simulation), 2u);
  while (asleep(simulation) == 2) ASSERT_FALSE(simulation.advance());
  EXPECT_EQ(asleep(simulation), 0u);
}

TEST(Sleeping, EndsWithTheLossOfASupport) {
  Json scene = on_a_floor();
  scene["bodies"].push_back(scene["bodies"][0]);
  scene["bodies"][1]["translate"] = {0, 0, 0.1};
  scene["contact"]["bodies"] = "others";
  scene["duration"] = 2.5;
  scene["events"] = Json::parse(R"([{"at": 2.4, "remove": {"box": {"min": [-1, -1, -1], "max": [1, 1, 0.09]}}}])");
  Simulation simulation(parse(scene));
  take_steps(simulation, 4790);
  ASSERT_EQ(asleep(simulation), 2u);
  const double before = lowest(places_of(simulation, 1));
  run(simulation);
  EXPECT_EQ(simulation.body().counts().components, 1u);
  EXPECT_LT(lowest(places_of(simulation, 1)), before - 0.02);
}

/// How far up the lowest vertex of a cube has come at the end that slept until shortly before 1.4 s [m].
double risen_since_asleep(const Json& scene) {
  Simulation simulation(parse(scene));
  take_steps(simulation, 2790);
  EXPECT_EQ(asleep(simulation), 1u);
  const double before = lowest(places_of(simulation, 0));
  run(simulation);
  return lowest(places_of(simulation, 0)) - before;
}

TEST(Sleeping, EndsWhenItsFloorIsTakenAway) {
  Json scene = on_a_floor();
  scene["contact"]["obstacles"][0]["velocity"] = {0, 0, -0.3};
  scene["contact"]["obstacles"][0]["from"] = 1.4;
  EXPECT_LT(risen_since_asleep(scene), -0.01);
}

TEST(Sleeping, EndsWhenAForceBegins) {
  Json scene = on_a_floor();
  scene["forces"] =
      Json::parse(R"([{"plane": {"point": [0, 0, 0.1], "normal": [0, 0, 1]}, "force": [0, 0, 30], "from": 1.4}])");
  EXPECT_GT(risen_since_asleep(scene), 0.01);
}

TEST(Sleeping, EndsWhenAForceEnds) {
  Json scene = on_a_floor();
  scene.erase("contact");
  scene["forces"] = Json::parse(
      R"([{"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}, "acceleration": [0, 0, 9.81], "until": 1.4}])");
  EXPECT_LT(risen_since_asleep(scene), -0.01);
}

// Slow long enough at the very boundary at which the force begins: a body that fell asleep there would never feel it.
TEST(Sleeping, DoesNotBeginWhenAForceDoes) {
  for (const int step : {11, 12, 13, 14, 15}) {
    Json scene = two_cubes(1.0);
    scene["bodies"].erase(1);
    scene["sleep"] = {{"speed", 1e-3}, {"time", 12 * scene["step"].get<double>()}};
    scene["forces"] = Json::array({{{"plane", {{"point", {0, 0, 0}}, {"normal", {0, 0, 1}}}},
                                    {"force", {0, 0, 30}},
                                    {"from", step * scene["step"].get<double>()}}});
    Simulation simulation(parse(scene));
    take_steps(simulation, 25);
    EXPECT_GT(simulation.diagnostics().momentum.z(), 0.0) << step;
  }
}

TEST(Sleeping, EndsWhenADriveBegins) {
  Json scene = on_a_floor();
  scene["driven"] =
      Json::parse(R"([{"plane": {"point": [0, 0, 0.1], "normal": [0, 0, 1]}, "velocity": [0, 0, 0.3], "from": 1.4}])");
  EXPECT_GT(risen_since_asleep(scene), 0.01);
}

TEST(Sleeping, EndsWithAnEventWithinAStep) {
  Json scene = beside_a_vibrating_one();
  scene["event_times"] = "exact";
  scene["events"] = Json::parse(R"([{"at": 0.00511, "remove": {"ids": [0]}}])");
  Simulation simulation(parse(scene));
  take_steps(simulation, 25);
  EXPECT_EQ(asleep(simulation), 1u);
  take_steps(simulation, 1);
  EXPECT_EQ(asleep(simulation), 0u);
  EXPECT_EQ(simulation.operations(), 1u);
}

// ---- runs

TEST(Sleeping, LeavesARunThatIsContinuedTheSame) {
  Json scene = touching(with_velocity(two_cubes(0.01), 1, {-1, 0, 0}));
  scene["contact"]["friction"] = 0.3;
  scene["contact"]["restitution"] = 0.5;
  scene["duration"] = 0.016;
  scene["output"] = Json::parse(R"({"frames_every": {"steps": 3}, "diagnostics_every": {"steps": 2}})");
  scene["sleep"] = Json::parse(R"({"speed": 1e-3, "time": 0.0004})");
  const SceneFile file = parse(scene);
  const recorded::RunInMemory one = recorded::whole(file);
  ASSERT_EQ(one.simulation->diagnostics().sleep->woken, 1u);
  for (std::uint64_t n = 1; n < one.simulation->step_count(); ++n) {
    SCOPED_TRACE(n);
    recorded::expect_same(recorded::in_two(file, n), one);
  }
}

TEST(Sleeping, BeginsAtTheSameStepAfterARestartBesideABodyThatHasGrown) {
  // it is near to the other as long as that has moved by half of the gap since the last look, and by a share of its
  // first size: at the eleventh step 0.051217 m, and with its size after three steps more than 0.0515 m
  Json scene = touching(two_cubes(0.0515));
  scene["material"] = Json::parse(R"({"density": 1000, "stiffness": 0, "damping": 0, "viscosity": 0})");
  scene["bodies"][1]["translate"] = {0.1515, 0, 0};
  scene["bodies"][1]["initial_velocity"] =
      Json::parse(R"({"linear": [[0, 0, 0], [0, 200, 0], [0, 0, 200]], "centre": [0.2015, 0.05, 0.05]})");
  scene["duration"] = 0.0024;
  scene["output"] = Json::parse(R"({"diagnostics_every": {"steps": 1}})");
  const SceneFile file = parse(scene);
  const recorded::RunInMemory one = recorded::whole(file);
  ASSERT_EQ(one.simulation->diagnostics().sleep->slept, 1u);
  for (const std::uint64_t n : {3, 5, 10}) {
    SCOPED_TRACE(n);
    recorded::expect_same(recorded::in_two(file, n), one);
  }
}

TEST(Sleeping, NamesTheVertexOfTheBodyWhereWhatIsAwakeDiverges) {
  Json scene = beside_a_vibrating_one();
  scene["step"] = 0.004;
  scene["duration"] = 5;
  scene["sleep"]["time"] = 0.008;
  Simulation simulation(parse(scene));
  std::optional<EarlyEnd> end;
  while (!end && simulation.steps_done() < simulation.step_count()) end = simulation.advance();
  ASSERT_TRUE(end);
  EXPECT_EQ(asleep(simulation), 1u);
  EXPECT_GE(std::get<Divergence>(*end).vertex, points_of_one);
}

}  // namespace
}  // namespace dartboard::sleeping_test
