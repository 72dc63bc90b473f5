#include "validation/scenes/scene_of_file.h"

#include <gtest/gtest.h>

#include "core/plain/error.h"
#include "tests/support/moving_box.h"

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

TEST(SceneOfFile, CarriesMaterialGravityAndWhatIsFixed) {
  const TradeoffScene scene = scene_of_file(parse(exact_box()));
  EXPECT_EQ(scene.name, "file");
  EXPECT_EQ(scene.duration, 0x1p-4);
  EXPECT_EQ(scene.motion.checkpoints.back(), 0x1p-4);
  const reference::SpringNetwork& network = scene.motion.network;
  EXPECT_EQ(network.viscosity, 0.5);
  EXPECT_EQ(network.gravity, Eigen::Vector3d(0, 0.5, -2));
  EXPECT_EQ(std::count(network.fixed.begin(), network.fixed.end(), 1), 9);
  const FrozenBody body(*scene.frozen);
  const auto& points = body.body().vertices().point;
  for (std::size_t i = 0; i < network.point_count(); ++i) {
    const bool centre = points[i] == 13;  // of the linear velocity
    EXPECT_EQ(scene.motion.start.v[i].isZero(0.0), network.fixed[i] || centre) << i;
  }
  EXPECT_TRUE(scene.omissions.empty());
}

TEST(SceneOfFile, SaysWhichEventsItLeavesOutAndWhatAnAccurateRunHasChosen) {
  const TradeoffScene scene = scene_of_file(parse(with_events(exact_box(), R"([
    {"at": 0.0625, "dissociate": {"points": [[0, 1, 13]]}},
    {"at": 0.02, "dissociate": {"plane": {"point": [9, 0, 0], "normal": [1, 0, 0]}}},
    {"at": 0.01, "remove": {"ids": [3]}}, {"at": 0.01, "remove": {"sphere": {"centre": [0, 0, 0.25], "radius": 0.1}}},
    {"every": 0.01, "from": 0.01, "until": 0.05, "tear": {"vertex": 13, "direction": [1, 0, 0]}}])")));
  const std::vector<std::string> expected{
      "/events/0 is left out: it happens at the end, and changes no motion.",
      "/events/1 is left out: it changes nothing.",
      "/events/3 operates on the same cells in every run, those of one accurate run.",
      "/events/4 operates on the same cells in every run, those of one accurate run."};
  EXPECT_EQ(scene.omissions, expected);
}

TEST(SceneOfFile, RefusesWhatIsNoMotionToStudy) {
  Json json = moving_box();
  json["duration"] = 0;
  EXPECT_THROW(scene_of_file(parse(json)), InputError);
  json = moving_box();
  json["material"]["stiffness"] = 0;
  EXPECT_THROW(scene_of_file(parse(json)), InputError);
}

TEST(SceneOfFile, RefusesASceneWhoseComponentsArePutToSleep) {
  Json json = exact_box();
  json["sleep"] = {{"speed", 0.001}, {"time", 0.25}};
  try {
    scene_of_file(parse(json));
    FAIL() << "it is taken";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(),
                 "file: /sleep: changes the motion on purpose, which is no error of an integrator; expected a scene "
                 "without it");
  }
}

TEST(FindScene, TakesFilesAndNamesOfTheStudy) {
  EXPECT_EQ(find_scene("chain", "").name, "chain");
  EXPECT_THROW(find_scene("no-such-scene", ""), InputError);
  EXPECT_THROW(find_scene("/no/such/file.json", ""), IoError);
}

}  // namespace
}  // namespace dartboard::scene_of_file_test
