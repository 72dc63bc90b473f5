#include "validation/scenes/random_scenes.h"

#include <gtest/gtest.h>

#include <set>

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
  std::set<std::string> seen;
  for (std::uint64_t k = 0; k < 24; ++k) {
    const TradeoffScene scene = random_scene(9, k, small);
    const reference::SpringNetwork& network = scene.motion.network;
    EXPECT_NO_THROW(check(scene.motion));
    EXPECT_GE(scene.duration * scene.fastest_rate, 0.99 * small.least_phase) << scene.what;
    EXPECT_LE(network.point_count(), 250u) << scene.what;
    for (const char* kind : {"clamped", "free", "gravity", "stiffer", "damping", "cut", "ball", "box", "spinning"})
      if (scene.what.find(kind) != std::string::npos) seen.insert(kind);
    EXPECT_EQ(scene.what.find("cut") != std::string::npos, !scene.motion.events.empty()) << scene.what;
    EXPECT_EQ(scene.what.find("clamped") != std::string::npos,
              std::count(network.fixed.begin(), network.fixed.end(), 1) > 0);
  }
  EXPECT_EQ(seen.size(), 9u);
}

}  // namespace
}  // namespace dartboard::random_scenes_test
