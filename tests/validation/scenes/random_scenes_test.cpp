#include "validation/scenes/random_scenes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

namespace dartboard::random_scenes_test {
namespace {

const RandomSceneOptions small{.most_points = 200, .most_work = 2e4};

TEST(RandomScene, IsTheSameForTheSameSeedAndNumber) {
  const TradeoffScene a = random_scene(4, 2, small), b = random_scene(4, 2, small), c = random_scene(4, 3, small);
  EXPECT_EQ(a.what, b.what);
  EXPECT_EQ(a.motion.start.x, b.motion.start.x);
  EXPECT_EQ(a.duration, b.duration);
  EXPECT_NE(a.what, c.what);
}

TEST(RandomScene, CoversWhatChangesTheChoice) {
  const char* const kinds[] = {"clamped", "driven",   "free",  "gravity",  "floor",    "stiffer", "damping",
                               "cut in",  "removed",  "tear",  "pulled",   "ball",     "box",     "sheet",
                               "springs", "elements", "cubes", "spinning", "hexahedra"};
  std::set<std::string> seen;
  for (std::uint64_t k = 0; k < 60; ++k) {
    const TradeoffScene scene = random_scene(9, k, small);
    EXPECT_NO_THROW(check(scene.motion));
    EXPECT_GE(scene.duration * scene.fastest_rate, 0.7 * small.least_phase) << scene.what;
    EXPECT_LE(scene.motion.network.point_count(), 300u) << scene.what;
    for (const char* kind : kinds)
      if (scene.what.find(kind) != std::string::npos) seen.insert(kind);
    EXPECT_EQ(scene.what.find("clamped") != std::string::npos,
              std::ranges::count(scene.motion.network.fixed, 1) > 0 && scene.frozen->file.driven.empty());
    EXPECT_EQ(scene.what.find("floor") != std::string::npos, scene.has_contact());
  }
  EXPECT_EQ(seen.size(), std::size(kinds));
}

TEST(RandomScene, IsOfSpringsAloneWhereOtherCodesFollow) {
  RandomSceneOptions options = small;
  options.only_springs = true;
  for (std::uint64_t k = 0; k < 24; ++k) {
    const TradeoffScene scene = random_scene(9, k, options);
    EXPECT_EQ(scene.beyond_references, "") << scene.what;
    EXPECT_EQ(scene.equal_steps(), "") << scene.what;
    EXPECT_TRUE(scene.motion.events.empty()) << scene.what;
  }
}

}  // namespace
}  // namespace dartboard::random_scenes_test
