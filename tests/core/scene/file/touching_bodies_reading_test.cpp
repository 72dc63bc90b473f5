// The bodies of a scene that touch, and their laws, as they are read.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "core/scene/body/make_contact.h"
#include "core/scene/file/scene_problem.h"
#include "tests/support/moving_box.h"

namespace dartboard::touching_bodies_reading_test {
namespace {

using namespace moving;

Json with_contact(int bodies, const char* contact) {
  Json scene = Json::parse(R"({"name": "boxes", "step": 0.001, "duration": 0.01})");
  for (int k = 0; k < bodies; ++k) {
    scene["bodies"].push_back(Json::parse(R"({"generate": {"box": {"cells": [1, 1, 1], "spacing": 1}}})"));
    scene["bodies"].back()["generate"]["box"]["cells"][0] = k + 1;
    scene["bodies"].back()["translate"] = {0, 0, 2 * k};
  }
  scene["contact"] = Json::parse(contact);
  scene["contact"]["pressure"] = 1500;
  scene["contact"]["depth"] = 0.25;
  return scene;
}
std::vector<std::pair<int, int>> pairs_of(const SceneFile& scene) {
  std::vector<std::pair<int, int>> pairs;
  for (const SceneTouch& touch : scene.touches) pairs.emplace_back(touch.first, touch.second);
  return pairs;
}
using Pairs = std::vector<std::pair<int, int>>;

TEST(TouchingBodiesRead, AreNoneUnlessTheSceneSaysSo) {
  const SceneFile scene = parse(with_contact(2, R"({"obstacles": [{"sphere": {"centre": [0, 0, 9], "radius": 1}}]})"));
  EXPECT_TRUE(scene.touches.empty());
  EXPECT_TRUE(scene.has_contact());
}

TEST(TouchingBodiesRead, AreThoseOfTheWord) {
  EXPECT_EQ(pairs_of(parse(with_contact(3, R"({"bodies": "all"})"))),
            (Pairs{{0, 0}, {0, 1}, {0, 2}, {1, 1}, {1, 2}, {2, 2}}));
  EXPECT_EQ(pairs_of(parse(with_contact(3, R"({"bodies": "others"})"))), (Pairs{{0, 1}, {0, 2}, {1, 2}}));
  EXPECT_EQ(pairs_of(parse(with_contact(3, R"({"bodies": "themselves"})"))), (Pairs{{0, 0}, {1, 1}, {2, 2}}));
  const SceneFile scene = parse(with_contact(3, R"({"bodies": "others", "exponent": 2, "restitution": 0.5,
                                                    "friction": 0.125})"));
  for (const SceneTouch& touch : scene.touches) {
    EXPECT_EQ(touch.path, "/contact/bodies");
    EXPECT_EQ(std::tuple(touch.law.pressure, touch.law.depth, touch.law.restitution, touch.law.friction),
              std::tuple(1500.0, 0.25, 0.5, 0.125));
    EXPECT_EQ(touch.law.exponent, 2);
  }
  EXPECT_TRUE(scene.obstacles.empty());
  EXPECT_TRUE(scene.has_contact());
}

TEST(TouchingBodiesRead, OfOneBodyAreItself) {
  Json scene = moving_box();
  scene["contact"] = {{"pressure", 1500}, {"depth", 0.25}, {"bodies", "all"}};
  EXPECT_EQ(pairs_of(parse(scene)), (Pairs{{0, 0}}));
}

TEST(TouchingBodiesRead, AreWhatPairsSayWhereTheySayMore) {
  const SceneFile scene = parse(with_contact(3, R"({"bodies": "others", "friction": 0.125, "pairs": [
      {"of": [2, 0], "touch": "no"}, {"of": [1, 1], "pressure": 3000, "depth": 2, "restitution": 0.5, "friction": 0},
      {"of": [2, 1], "depth": 0.5}]})"));
  ASSERT_EQ(pairs_of(scene), (Pairs{{0, 1}, {1, 1}, {1, 2}}));
  const auto law = [&scene](std::size_t k) {
    const ContactLaw& l = scene.touches[k].law;
    return std::tuple(l.pressure, l.depth, l.restitution, l.friction);
  };
  EXPECT_EQ(law(0), std::tuple(1500.0, 0.25, 1.0, 0.125));
  EXPECT_EQ(law(1), std::tuple(3000.0, 2.0, 0.5, 0.0));
  EXPECT_EQ(law(2), std::tuple(1500.0, 0.5, 1.0, 0.125));
  EXPECT_EQ(scene.touches[0].path, "/contact/bodies");
  EXPECT_EQ(scene.touches[1].path, "/contact/pairs/1");
  EXPECT_EQ(scene.touches[2].path, "/contact/pairs/2");
}

TEST(TouchingBodiesRead, AreRefusedWhereTheyAreMoreThanATableHolds) {
  Json scene = with_contact(1, R"({"bodies": "all"})");
  while (scene["bodies"].size() < 1000) scene["bodies"].push_back(scene["bodies"][0]);
  EXPECT_EQ(parse(scene).touches.size(), 1000u * 1001 / 2);
  scene["bodies"].push_back(scene["bodies"][0]);
  try {
    parse(scene);
    FAIL();
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "file: /contact: has bodies that touch among 1001; expected at most 1000");
  }
}

// For bodies of 6, 12 and 18 tetrahedra.
TEST(BodyRanges, AreWhereEachBodyBegins) {
  const Problem problem = make_problem(parse(with_contact(3, R"({"bodies": "all"})")));
  EXPECT_EQ(problem.bodies.cell, (std::vector<std::size_t>{0, 6, 18, 36}));
  EXPECT_EQ(problem.bodies.link, (std::vector<std::size_t>{0, 0, 0, 0}));
  EXPECT_EQ(problem.bodies.point.back(), problem.mesh.points.size());
  const std::pair<std::size_t, std::uint32_t> bodies[] = {{0, 0}, {5, 0}, {6, 1}, {17, 1}, {18, 2}, {35, 2}};
  for (const auto& [cell, body] : bodies) {
    EXPECT_EQ(body_of_cell(problem.bodies.cell, cell), body) << cell;
    EXPECT_EQ(body_of_cells(problem.bodies).at(cell), body) << cell;
  }
  EXPECT_EQ(make_problem(parse(moving_box())).bodies.cell, (std::vector<std::size_t>{0, 48}));
}

}  // namespace
}  // namespace dartboard::touching_bodies_reading_test
