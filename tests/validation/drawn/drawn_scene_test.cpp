#include "validation/drawn/drawn_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <string>

#include "validation/drawn/broken_scene.h"
#include "validation/drawn/scene_walk.h"
#include "validation/drawn/value_pairs.h"

namespace dartboard::drawn_scene_test {
namespace {

constexpr std::uint64_t seed = 1, count = 400;

/// The keys of some hundred scenes, with the values of choices and without.
const ValuePairs& drawn_values() {
  static const ValuePairs all = [] {
    ValuePairs pairs;
    for (std::uint64_t number = 0; number < count; ++number) pairs.add(values_of(drawn_scene(seed, number)));
    return pairs;
  }();
  return all;
}

/// Shapes in scenes that no scene has as long as these keys are not drawn.
bool is_in_what_is_not_drawn(Shape shape) {
  return shape == Shape::tag || shape == Shape::expect || shape == Shape::expected_place;
}

TEST(DrawnScenes, HaveEveryKeyAndChoiceButThoseThatAreNamedWithAReasonAndMostPairs) {
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
  // of some 230 values; a few may change with a key that is added
  EXPECT_GT(drawn_values().pairs(), 14000u);
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
