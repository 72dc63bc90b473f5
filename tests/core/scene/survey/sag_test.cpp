// The strain of a body under its own weight, before it runs.

#include <gtest/gtest.h>

#include "core/meshes/formats/loaded_mesh.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/survey/sag.h"
#include "tests/support/bodies/surveys_for_tests.h"
#include "tests/support/moving_box.h"

namespace dartboard::sag_test {
namespace {

using namespace moving;

/// A block of 0.2 x 0.2 m, 0.4 m high, held at its foot.
Json standing(double young) {
  Json scene = Json::parse(R"({"name": "block", "step": 0.001, "duration": 0.01,
    "body": {"generate": {"box": {"cells": [1, 1, 2], "spacing": 0.2, "kind": "hexahedra"}}},
    "material": {"density": 1000, "poisson": 0.3}, "gravity": [0, 0, -10], "unstable_step": "warn",
    "fixed": [{"box": {"min": [0, 0, 0], "max": [1, 1, 0]}}]})");
  scene["material"]["young"] = young;
  return scene;
}
std::vector<Sag> sags(const Json& json) {
  const SceneFile scene = parse(json);
  return find_sags(scene, make_problem(scene));
}

// density g H / 2 E = 1000 * 10 * 0.4 / (2 * 5) = 400
TEST(Sag, IsThatOfAColumnUnderItsWeight) {
  const auto found = sags(standing(5));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].path, "/body");
  EXPECT_DOUBLE_EQ(found[0].height, 0.4);
  EXPECT_NEAR(found[0].strain, 400, 1e-9);
  EXPECT_TRUE(sags(standing(5000)).empty());
}

TEST(Sag, IsWarnedOfAboveTheHeightOfTheBody) {
  EXPECT_EQ(sags(standing(1999)).size(), 1u);
  EXPECT_TRUE(sags(standing(2001)).empty());
}

TEST(Sag, IsAlongGravity) {
  Json lying = standing(1500);
  lying["gravity"] = {-10, 0, 0};
  EXPECT_TRUE(sags(lying).empty());  // 1000 * 10 * 0.2 / (2 * 1500) = 0.67
  lying["material"]["young"] = 900;
  EXPECT_EQ(sags(lying).size(), 1u);
}

TEST(Sag, IsNotOfABodyThatFallsFreely) {
  Json falling = standing(5);
  falling.erase("fixed");
  EXPECT_TRUE(sags(falling).empty());
  falling["contact"] = Json::parse(R"({"pressure": 2000, "depth": 0.01,
    "obstacles": [{"plane": {"point": [0, 0, -0.1], "normal": [0, 0, 1]}}]})");
  EXPECT_EQ(sags(falling).size(), 1u);
}

TEST(Sag, IsOfTheBodyThatIsHeld) {
  Json two = standing(5);
  const Json body = two["body"];
  two.erase("body");
  two["bodies"] = {body, body};
  two["bodies"][1]["translate"] = {5, 0, 0};
  const auto found = sags(two);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].path, "/bodies/0");
}

TEST(Sag, IsNotOfSpringsWithoutAModulus) {
  Json springs = standing(5);
  springs["material"] = {{"density", 1000}, {"stiffness", 1e-3}};
  EXPECT_TRUE(sags(springs).empty());
}

TEST(Sag, NamesTheScaleOfAMeshFileThatHasNone) {
  const std::string advice = "and a mesh in millimetres needs a 'scale' of 0.001";
  EXPECT_NE(to_string(Sag{"/body", 20.0, 2.0, true}).find(advice), std::string::npos);
  EXPECT_EQ(to_string(Sag{"/body", 20.0, 2.0, false}).find(advice), std::string::npos);
  SceneFile scene = parse(standing(5));
  const Problem problem = make_problem(scene);
  EXPECT_FALSE(find_sags(scene, problem)[0].is_as_in_file);
  scene.body.loaded = std::make_shared<const LoadedMesh>();
  EXPECT_TRUE(find_sags(scene, problem)[0].is_as_in_file);
  scene.body.scale = 0.001;
  EXPECT_FALSE(find_sags(scene, problem)[0].is_as_in_file);
}

TEST(Sag, IsAWarningBeforeTheRun) {
  const auto said = warnings_before_run(parse(standing(5)));
  EXPECT_TRUE(std::ranges::any_of(said, [](const std::string& warning) {
    return warning.find("/body: its weight is expected to compress or stretch it by 4e+02 times its height of 0.4 m") !=
           std::string::npos;
  }));
}

}  // namespace
}  // namespace dartboard::sag_test
