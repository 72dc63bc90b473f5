#include "core/scene/body/events/ready.h"

#include <gtest/gtest.h>

#include "tests/support/moving_box.h"

namespace dartboard::release_test {
namespace {

using namespace moving;

// Held everywhere and at rest, so that only gravity moves the released vertices.
Json held_box(const char* events) {
  Json scene = with_events(moving_box(), events);
  scene.erase("initial_velocity");
  scene["material"]["viscosity"] = 0;
  scene["fixed"] = Json::parse(R"([{"box": {"min": [-1, -1, -1], "max": [1, 1, 1]}}])");
  return scene;
}
const char* const all_at_4_ms = R"([{"at": 0.004, "release": {"box": {"min": [-1, -1, -1], "max": [1, 1, 1]}}}])";

// Without strain the whole body falls as a point does: by g t^2 / 2, exactly up to rounding for a method of order 2 or
// more. 6 steps of numbers below 0.25 m round by less than 6 * 8 * 2^-54 m.
TEST(Release, LetsTheBodyFallFromThenOn) {
  for (const char* method : {"rk4", "verlet", "implicit-midpoint"}) {
    Json scene = held_box(all_at_4_ms);
    scene["integrator"] = method;
    Simulation simulation(parse(scene));
    const auto start = simulation.body().vertices().position;
    for (int n = 0; n < 4; ++n) ASSERT_FALSE(simulation.advance());
    EXPECT_EQ(simulation.body().vertices().position, start) << method;
    EXPECT_EQ(simulation.operations(), 27u);
    run(simulation);
    for (std::size_t k = 0; k < start.size(); ++k) {
      const Eigen::Vector3d& now = simulation.body().vertices().position[k];
      EXPECT_NEAR(start[k].z() - now.z(), 0.5 * 9.81 * 0.006 * 0.006, 1e-13) << method;
      EXPECT_NEAR((now - start[k]).head<2>().norm(), 0.0, 1e-13) << method;
    }
  }
}

TEST(Release, LetsGoOfThoseSelectedAndHoldsTheOthers) {
  Simulation simulation(
      parse(held_box(R"([{"at": 0.001, "release": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}])")));
  const auto start = simulation.body().vertices().position;
  run(simulation);
  for (std::size_t k = 0; k < start.size(); ++k)
    EXPECT_EQ(simulation.body().vertices().position[k] == start[k], start[k].x() < 0.125) << k;
  EXPECT_EQ(simulation.operations(), 18u);
}

TEST(Release, FindsVerticesByWhereTheyAreAtRest) {
  // the plane is at the box's place at rest; at 5 ms the free part has moved on by half a metre
  Json scene = held_box(R"([{"at": 0.005, "release": {"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]}}}])");
  scene["body"]["translate"] = {0, 0, 0};
  Simulation simulation(parse(scene));
  run(simulation);
  EXPECT_EQ(simulation.operations(), 9u);
}

TEST(Release, LetsGoOfAllPartsOfAVertexThatCameApart) {
  Simulation simulation(parse(held_box(R"([
    {"at": 0.001, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}},
    {"at": 0.002, "release": {"ids": [1]}}])")));
  run(simulation);
  EXPECT_EQ(simulation.operations(), 8u + 2u);  // point 1 is at (0.125, 0, 0)
}

TEST(Release, KnowsVerticesByTheNumbersOfTheirPoints) {
  Simulation simulation(parse(held_box(R"([{"at": 0.001, "release": {"ids": [5, 20]}}])")));
  const auto start = simulation.body().vertices().position;
  const auto& point = simulation.body().vertices().point;
  ASSERT_NE(point[5], 5u);  // vertices have another order
  run(simulation);
  for (std::size_t k = 0; k < start.size(); ++k)
    EXPECT_EQ(simulation.body().vertices().position[k] != start[k], point[k] == 5 || point[k] == 20) << point[k];
}

TEST(Release, NeedsNoMap) { EXPECT_EQ(Simulation(parse(held_box(all_at_4_ms))).body().map_name(), "no map"); }

TEST(Release, WorksOnAChain) {
  Json scene = held_box(all_at_4_ms);
  scene["body"] = Json::parse(R"({"generate": {"chain": {"links": 3, "spacing": 0.25}}})");
  scene["fixed"] = Json::parse(R"([{"ids": [0]}])");
  Simulation simulation(parse(scene));
  run(simulation);
  EXPECT_EQ(simulation.operations(), 1u);
  EXPECT_LT(simulation.body().vertices().position[0].z(), 0.0);
}

TEST(Release, OfNothingFixedIsRefused) {
  Json scene = held_box(all_at_4_ms);
  scene["fixed"] = Json::parse(R"([{"ids": [0]}])");
  scene["events"][0]["release"] = Json::parse(R"({"ids": [1]})");
  EXPECT_EQ(refusal(scene), "file: /events/0/release: selects no vertex that is fixed; expected at least one");
  scene.erase("fixed");
  EXPECT_NE(refusal(scene).find("selects no vertex that is fixed"), std::string::npos);
}

TEST(Release, OfADrivenVertexIsRefused) {
  Json scene = held_box(all_at_4_ms);
  scene["fixed"] = Json::parse(R"([{"ids": [0]}])");
  scene["driven"] = Json::parse(R"([{"ids": [26], "velocity": [0, 0, 1]}])");
  EXPECT_EQ(refusal(scene),
            "file: /events/0/release: selects point 26, which /driven moves; expected fixed ones alone");
}

TEST(Release, BesideARefinementIsRefused) {
  Json scene = held_box(all_at_4_ms);
  scene["events"].push_back(Json::parse(R"({"at": 0.001, "refine": {"cells": {"ids": [0]}}})"));
  EXPECT_NE(refusal(scene).find("/events/1/refine: cannot be combined with /events/0/release"), std::string::npos);
}

}  // namespace
}  // namespace dartboard::release_test
