#include "validation/drawn/drawn_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <string>
#include <vector>

#include "tests/validation/drawn/covering_scenes.h"
#include "validation/drawn/broken_scene.h"
#include "validation/drawn/met_values.h"
#include "validation/drawn/scene_walk.h"

namespace dartboard::drawn_scene_test {
namespace {

constexpr std::uint64_t seed = 1;

/// The keys of some hundred scenes, with the values of choices and without.
const MetValues& drawn_values() {
  static const MetValues all = [] {
    MetValues met;
    for (const std::uint64_t number : covering_scenes) met.add(values_of(drawn_scene(seed, number)));
    return met;
  }();
  return all;
}

/// Shapes in scenes that no scene has as long as these keys are not drawn.
bool is_in_what_is_not_drawn(Shape shape) {
  return shape == Shape::tag || shape == Shape::expect || shape == Shape::expected_place;
}

TEST(CoveringScenes, HaveEveryKeyAndChoiceButThoseThatAreNamedWithAReasonAndAllPairs) {
  const auto not_drawn = keys_not_drawn();
  for (const SceneKey& key : scene_keys()) {
    const bool is_left_out = std::ranges::any_of(
        not_drawn, [&](const KeyNotDrawn& one) { return one.shape == key.shape && one.name == key.name; });
    if (is_left_out || is_in_what_is_not_drawn(key.shape)) continue;
    const std::string name = std::string(help_of(key.shape).name) + "." + std::string(key.name);
    for (const std::string& choice : key.choices)
      EXPECT_TRUE(drawn_values().has(name + "=" + choice)) << name << "=" << choice;
    if (key.choices.empty() && !key.required) {
      EXPECT_TRUE(drawn_values().has(name)) << name << " is not drawn: see validation/drawn/drawn_scene.cpp";
    }
  }
  for (const KeyNotDrawn& key : keys_not_drawn()) {
    ASSERT_NE(find_key(key.shape, key.name), nullptr) << key.name;
    EXPECT_FALSE(drawn_values().has(std::string(help_of(key.shape).name) + "." + std::string(key.name))) << key.name;
  }
  EXPECT_EQ(drawn_values().pairs(), covered_pairs)
      << "scenes are drawn otherwise: tests/validation/drawn/covering_scenes.h says how they are chosen";
}

TEST(MetValues, AreCountedOneByOneInPairsAndInTriples) {
  MetValues met;
  EXPECT_EQ(met.add({"a", "b", "c"}), 3u);
  EXPECT_EQ(met.add({"b", "c", "d"}), 2u);
  EXPECT_EQ(met.add({"a", "b"}), 0u);
  EXPECT_EQ(met.values(), 4u);
  EXPECT_EQ(met.pairs(), 5u);
  EXPECT_EQ(met.triples(), 2u);
}

TEST(MetValues, OfAFewScenesAreThoseOfAll) {
  // the third has most pairs; of the others only the last has one that is new
  EXPECT_EQ(covering({{"a", "b"}, {"b", "c"}, {"a", "b", "c"}, {"c"}, {"c", "d"}}), (std::vector<std::size_t>{2, 4}));
}

TEST(DrawnScenes, AreTheSameAgainAndNoTwoAlike) {
  EXPECT_EQ(drawn_scene(3, 7), drawn_scene(3, 7));
  auto one = drawn_scene(3, 7), other = drawn_scene(3, 8);
  one.erase("name");
  other.erase("name");
  EXPECT_NE(one, other);
}

TEST(BrokenScenes, AreRefusedWhereTheFaultIs) {
  std::set<std::string> faults;
  for (std::uint64_t number = 0; number < 40; ++number) {
    const auto scene = drawn_scene(seed, number);
    Draw draw(5, number);
    for (int k = 0; k < 10; ++k) {
      const BrokenScene broken = broken_scene(scene, draw);
      faults.insert(broken.fault);
      const auto wrong = wrong_refusal(broken);
      EXPECT_FALSE(wrong) << *wrong;
    }
  }
  EXPECT_EQ(faults.size(), 4u);
}

TEST(BrokenScenes, ThatAreTakenOrRefusedElsewhereAreReported) {
  const auto scene = drawn_scene(seed, 0);
  EXPECT_EQ(wrong_refusal({scene, "/step", "nothing"}), "nothing in /step is taken");
  auto other = scene;
  other["step"] = -1;
  const auto wrong = wrong_refusal({other, "/duration", "a number out of range"});
  ASSERT_TRUE(wrong);
  EXPECT_NE(wrong->find("is refused by \"scene: /step"), std::string::npos) << *wrong;
}

}  // namespace
}  // namespace dartboard::drawn_scene_test
