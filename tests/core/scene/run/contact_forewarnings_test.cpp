// What a run says of its contacts before the first step: obstacles too thin or too small, bodies that bounce otherwise,
// chains that touch nothing.

#include <gtest/gtest.h>

#include <algorithm>

#include "core/scene/run/simulation.h"
#include "tests/support/bodies/surveys_for_tests.h"
#include "tests/support/moving_box.h"

namespace dartboard::contact_forewarnings_test {
namespace {

using namespace moving;

/// A box of 4 cm and 1000 kg/m^3 that begins above the origin, on an obstacle with this law.
Json box_on(const char* obstacle, double pressure, double depth) {
  Json scene = Json::parse(R"({"name": "box", "step": 0.0001, "duration": 0.05, "integrator": "verlet",
    "body": {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.02}}, "translate": [-0.02, -0.02, 0]},
    "material": {"density": 1000, "young": 100000, "viscosity": 0}})");
  scene["contact"] = {{"pressure", pressure}, {"depth", depth}, {"obstacles", {Json::parse(obstacle)}}};
  return scene;
}
std::vector<std::string> warnings_before(const Json& scene) {
  const SceneFile file = parse(scene);
  return warnings_before_run(file);
}

// 392.4 Pa at 1 mm carry the box in the middle of a plate 2 mm thick. Let go above it, it comes 3^(1/2) times as deep;
// the forecast adds what it may fall in 0.05 s, 0.1203 m^2/s^2 of energy per mass: (3 0.1203 40 / 0.3924)^(1/3) mm.
TEST(ContactForewarnings, NameAPlateTooThinForWhatFallsOnIt) {
  const char* const plate = R"({"box": {"min": [-1, -1, -0.002], "max": [1, 1, 0]}})";
  const auto warnings = warnings_before(box_on(plate, 392.4, 0.001));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(
      warnings[0].starts_with("/contact/obstacles/0 may be 0.005058 m deep in a body, and nothing is more than 0.001 m "
                              "inside it: what is deeper comes out on its other side"))
      << warnings[0];
  EXPECT_TRUE(warnings_before(box_on(plate, 392400, 0.001)).empty());
  const char* const slab = R"({"box": {"min": [-1, -1, -0.02], "max": [1, 1, 0]}})";
  EXPECT_TRUE(warnings_before(box_on(slab, 392.4, 0.001)).empty());
}

// 0.1 and 0.3 are not numbers of two: places come to lie beside the surface by rounding.
TEST(ContactForewarnings, AreSilentOnABodyThatLiesOnASurface) {
  for (const double height : {0.1, 0.3, -0.1, 0.7}) {
    Json scene = box_on(R"({"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}})", 392400, 0.001);
    scene["contact"]["obstacles"][0]["plane"]["point"] = {0, 0, height};
    scene["body"]["translate"] = {-0.02, -0.02, height};
    EXPECT_TRUE(warnings_before(scene).empty()) << height;
    scene["body"]["translate"][2] = height - 1e-6;
    const auto warnings = warnings_before(scene);
    ASSERT_EQ(warnings.size(), 1u) << height;
    EXPECT_NE(warnings[0].find("inside obstacles at the start"), std::string::npos) << warnings[0];
  }
}

// The forecast is of a column: an edge that comes first goes deeper than it says, and is named when it comes through.
TEST(ContactForewarnings, AreNotAllThatIsSaidOfAnEdgeThatComesThroughAPlate) {
  Json scene = box_on(R"({"box": {"min": [-1, -1, -0.004], "max": [1, 1, 0]}})", 4000, 0.003);
  scene["body"]["rotate"] = {{"axis", {0, 1, 0}}, {"degrees", 45}};
  scene["body"]["translate"] = {-0.03, -0.02, 0.03};
  scene["initial_velocity"] = {0, 0, -0.5};
  const SceneFile file = parse(scene);
  Simulation simulation(file);
  while (simulation.steps_done() < simulation.step_count()) ASSERT_FALSE(simulation.advance());
  const auto all = simulation.contact_warnings();
  const auto found = std::ranges::find(all, ContactWarning::Kind::comes_through, &ContactWarning::kind);
  ASSERT_NE(found, all.end());
  EXPECT_LE(found->value, 0.002 + 1e-12);
  EXPECT_FALSE(found->of_bodies);
}

// Faces have legs of 2 cm, whose ends are 2 cm 5^(1/2) / 3 and 2 cm 2^(1/2) / 3 from the middle: the place on a leg
// that is as far from the middle as from its end is 8.3 mm from both.
TEST(ContactForewarnings, NameABallThatPassesBetweenTheSamplesOfAFace) {
  const auto warnings =
      warnings_before(box_on(R"({"sphere": {"centre": [0.003, 0.007, -0.007], "radius": 0.007}})", 1e5, 0.001));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(warnings[0].starts_with(
      "/contact/obstacles/0 may come any depth into faces of bodies between the places that feel "
      "contact, which are up to 0.008333 m from other places"))
      << warnings[0];
  // 9 mm less the root of 81 - 69.4 mm^2
  const Json larger = box_on(R"({"sphere": {"centre": [0.003, 0.007, -0.009], "radius": 0.009}})", 1e5, 0.001);
  EXPECT_NE(warnings_before(larger)[0].find("may come 0.005601 m deep into"), std::string::npos);
  // a ball 10 cm thick comes 0.3 mm into the face, less than its law allows
  EXPECT_TRUE(warnings_before(box_on(R"({"sphere": {"centre": [0, 0, -0.1], "radius": 0.1}})", 1e5, 0.001)).empty());
  const char* const rod = R"({"box": {"min": [-1, -0.005, -0.01], "max": [1, 0.005, 0]}})";
  EXPECT_NE(warnings_before(box_on(rod, 1e5, 0.001))[0].find("any depth"), std::string::npos);
}

// Young over the height is 2.5 MPa/m. A law of 2 kPa at 2 mm has 2 P / depth (d / depth) where the box lies 0.89 mm
// deep.
TEST(ContactForewarnings, NameARestitutionThatABodyDoesNotKeep) {
  Json scene = box_on(R"({"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}})", 2000, 0.002);
  EXPECT_TRUE(warnings_before(scene).empty());
  scene["contact"]["restitution"] = 0.5;
  const auto warnings = warnings_before(scene);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_TRUE(
      warnings[0].starts_with("the restitution 0.5 at /contact/obstacles/0 is that of places, and a body will bounce "
                              "otherwise: it is 0.81 times as stiff as the contact"))
      << warnings[0];
  scene["material"]["young"] = 2e6;
  EXPECT_TRUE(warnings_before(scene).empty());
  // between bodies
  scene["bodies"] = {scene["body"], scene["body"]};
  scene["bodies"][1]["translate"] = {-0.02, -0.02, 0.0401};
  scene.erase("body");
  scene["contact"] = {{"pressure", 2000}, {"depth", 0.002}, {"restitution", 0.5}, {"bodies", "others"}};
  scene["material"]["young"] = 2e4;
  const auto between = warnings_before(scene);
  ASSERT_EQ(between.size(), 1u);
  EXPECT_TRUE(between[0].starts_with("the restitution 0.5 at /bodies/1 is that of places")) << between[0];
}

}  // namespace
}  // namespace dartboard::contact_forewarnings_test
