#include "validation/scenes/scene_of_file.h"

#include <gtest/gtest.h>

#include "core/plain/error.h"
#include "core/time/integrators.h"
#include "tests/support/moving_box.h"
#include "validation/scenes/scene_stage.h"

namespace dartboard::scene_of_file_test {
namespace {

using namespace moving;

// 64 steps of 2^-10 s: times are exact
Json exact_box() {
  Json scene = moving_box();
  scene["step"] = 0x1p-10;
  scene["duration"] = 0x1p-4;
  scene["gravity"] = {0, 0.5, -2};
  scene["fixed"] = Json::parse(R"([{"plane": {"point": [0, 0, 0], "normal": [-1, 0, 0]}}])");
  return scene;
}

/// The last state, by vertex number.
PointState run_as_simulation(const Json& json) {
  Simulation simulation(parse(json));
  run(simulation);
  const VertexColumns& v = simulation.body().vertices();
  return {v.position, v.velocity};
}

PointState run_as_study(const Json& json) {
  const TradeoffScene scene = scene_of_file(parse(json));
  EXPECT_TRUE(scene.body.has_value());
  const auto integrator = make_integrator(json.value("integrator", "rk4"));
  return run_scene(*scene.body, *integrator, 64, EventTiming::end_of_step).states.back();
}

class SceneOfFileBits : public ::testing::TestWithParam<const char*> {};

TEST_P(SceneOfFileBits, AreThoseOfTheSimulationWithTheSameIntegratorAndStep) {
  for (const char* integrator : {"rk4", "verlet", "blanes-moan-4", "baraff-witkin"}) {
    Json json = with_events(exact_box(), GetParam());
    json["integrator"] = integrator;
    const PointState simulated = run_as_simulation(json), studied = run_as_study(json);
    EXPECT_EQ(simulated.x, studied.x) << integrator;
    EXPECT_EQ(simulated.v, studied.v) << integrator;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Events, SceneOfFileBits,
    ::testing::Values("[]", R"([{"at": 0.02, "dissociate": {"points": [[0, 1, 13], [0, 4, 13]]}}])",
                      R"([{"at": 0.03125, "tear": {"vertex": 13, "direction": [1, 0, 0]}},
                          {"at": 0.0, "dissociate": {"points": [[0, 1, 13]]}}])",
                      R"([{"at": 0.03, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}])"));

TEST(SceneOfFile, CarriesMaterialGravityAndWhatIsFixed) {
  const TradeoffScene scene = scene_of_file(parse(exact_box()));
  EXPECT_EQ(scene.name, "file");
  EXPECT_EQ(scene.duration, 0x1p-4);
  EXPECT_EQ(scene.motion.checkpoints.back(), 0x1p-4);
  const reference::SpringNetwork& network = scene.motion.network;
  EXPECT_EQ(network.viscosity, 0.5);
  EXPECT_EQ(network.gravity, Eigen::Vector3d(0, 0.5, -2));
  EXPECT_EQ(std::count(network.fixed.begin(), network.fixed.end(), 1), 9);
  for (std::size_t i = 0; i < network.point_count(); ++i) {
    const bool centre = scene.body->body.vertices.point[i] == 13;  // of the linear velocity
    EXPECT_EQ(scene.motion.start.v[i].isZero(0.0), network.fixed[i] || centre) << i;
  }
  EXPECT_TRUE(scene.omissions.empty());
}

TEST(SceneOfFile, SaysWhichEventsItLeavesOut) {
  const TradeoffScene scene = scene_of_file(parse(with_events(exact_box(), R"([
    {"tear_where_stressed": {"threshold": 100}}, {"at": 0.01, "remove": {"ids": [3]}},
    {"at": 0.01, "refine": {"cells": {"ids": [3]}}}, {"at": 0.0625, "dissociate": {"points": [[0, 1, 13]]}},
    {"every": 0.01, "from": 0.01, "until": 0.05, "tear": {"vertex": 13, "direction": [1, 0, 0]}},
    {"at": 0.02, "dissociate": {"plane": {"point": [9, 0, 0], "normal": [1, 0, 0]}}}])")));
  EXPECT_TRUE(scene.motion.events.empty());
  ASSERT_EQ(scene.omissions.size(), 6u);
  const char* starts[]{"/events/0 ", "/events/1 ", "/events/2 ", "/events/3 ", "/events/4 ", "/events/5 "};
  for (std::size_t k = 0; k < 6; ++k) EXPECT_TRUE(scene.omissions[k].starts_with(starts[k])) << scene.omissions[k];
}

TEST(SceneOfFile, RunsOtherBodiesAsTheirSprings) {
  Json json = with_events(exact_box(), R"([{"at": 0.01, "remove": {"ids": [0]}}])");
  json["body"] = Json::parse(R"({"generate": {"sheet": {"cells": [3, 2], "spacing": 0.125}}})");
  const TradeoffScene scene = scene_of_file(parse(json));
  EXPECT_FALSE(scene.body.has_value());
  EXPECT_EQ(scene.motion.network.point_count(), 12u);
  EXPECT_EQ(scene.omissions.size(), 2u);  // no map, and the event
  // the sums of a mass and of the forces on a vertex run in another order: 64 steps of rounding, amplified by nothing
  json["events"] = Json::array();
  const PointState simulated = run_as_simulation(json);
  const auto integrator = make_integrator("rk4");
  const TimedRun run = run_timed(scene, *integrator, {.steps = 64}, [] { return 0; });
  ASSERT_EQ(run.states.size(), 8u);
  Simulation start(parse(json));
  for (std::size_t k = 0; k < 12; ++k) {
    const std::uint32_t point = start.body().vertices().point[k];
    EXPECT_LT((simulated.x[k] - run.states.back().x[point]).norm(), 64 * 64 * 0x1p-52 * 0.5) << k;
  }
}

TEST(SceneOfFile, RefusesWhatIsNoMotionToStudy) {
  Json json = moving_box();
  json["duration"] = 0;
  EXPECT_THROW(scene_of_file(parse(json)), InputError);
  json = moving_box();
  json["material"]["stiffness"] = 0;
  EXPECT_THROW(scene_of_file(parse(json)), InputError);
}

TEST(SceneOfFile, RefusesContactByItsKey) {
  Json json = moving_box();
  json["contact"] = Json::parse(R"({"pressure": 1, "depth": 1,
                                    "obstacles": [{"sphere": {"centre": [9, 9, 9], "radius": 1}}]})");
  try {
    scene_of_file(parse(json));
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "file: /contact: says what touches; expected none, to compare with references");
  }
}

TEST(FindScene, TakesFilesAndNamesOfTheStudy) {
  EXPECT_EQ(find_scene("chain", "").name, "chain");
  EXPECT_THROW(find_scene("no-such-scene", ""), InputError);
  EXPECT_THROW(find_scene("/no/such/file.json", ""), IoError);
}

}  // namespace
}  // namespace dartboard::scene_of_file_test
