// The paper's collisions: they are handled, and where contact is too soft to handle them, the claim falls short.

#include "validation/contact/collisions.h"

#include <gtest/gtest.h>

#include "validation/contact/contact_scenes.h"

namespace dartboard::collisions_test {
namespace {

TEST(PaperCollisions, OfTwoBodiesAndOfThePartsOfOneAreHandled) {
  for (const SceneFile& scene : {scene_of_collision(), scene_of_cut()}) {
    const ClaimAnswer answer = try_collision(scene, 5);
    EXPECT_TRUE(answer.holds) << scene.name << ": " << answer.measured;
  }
}

TEST(PaperCollisions, AreNotHandledWhereContactIsTooSoft) {
  SceneFile scene = scene_of_cut();
  for (SceneTouch& touch : scene.touches) touch.law.pressure *= 1e-4;
  EXPECT_FALSE(try_collision(scene, 5).holds);
}

TEST(PaperCollisions, AreNoneWhereNothingTouches) {
  SceneFile scene = scene_of_collision();
  scene.duration = 0.001;
  EXPECT_FALSE(try_collision(scene, 2).holds);
}

// What acts from outside takes momentum.
TEST(PaperCollisions, AreNotJudgedByMomentumUnderGravity) {
  SceneFile scene = scene_of_collision();
  scene.gravity = {0, 0, -1};
  EXPECT_FALSE(try_collision(scene, 5).holds);
}

}  // namespace
}  // namespace dartboard::collisions_test
