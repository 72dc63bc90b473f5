#include "validation/contact/random_placements.h"

#include <gtest/gtest.h>

#include "core/meshes/generators/mesh_generators.h"

namespace dartboard::random_placements_test {
namespace {

const Mesh& box() {
  static const Mesh mesh = kuhn_box(2, 2, 2, 0.5, 0.15, 5);
  return mesh;
}
const Mesh& ball() {
  static const Mesh mesh = tetrahedron_ball(2, 0.5);
  return mesh;
}

// Overlaps of half an altitude are felt; those that are not felt are a part of a face deep, and rare.
TEST(RandomPlacements, AreFeltWhereTheyAreDeep) {
  const PlacementsFound found = judge_placements(box(), ball(), {.placements = 150, .seed = 3});
  EXPECT_EQ(found.placements, 150u);
  EXPECT_EQ(found.overlapping, 150u);
  EXPECT_LE(found.quiet, 5u);
  EXPECT_LE(found.deepest_quiet, 0.5);
  EXPECT_GT(found.by_depth.count(), 1000u);
  EXPECT_LE(found.by_depth.count_missed(), found.by_depth.count() / 100);
  // by up to one altitude; the depth can be larger if the way out crosses no face
  EXPECT_GT(found.by_depth.deepest, 0.6);
}

TEST(RandomPlacements, TellWhatIsNotFelt) {
  const PlacementsFound found =
      judge_placements(box(), ball(), {.placements = 30, .seed = 3, .loses = [](std::size_t k) { return k % 2 == 0; }});
  EXPECT_GE(found.quiet, 15u);
  EXPECT_GT(found.deepest_quiet, 0.5);
  EXPECT_GT(found.by_depth.count_missed(), found.by_depth.count() / 4);
  EXPECT_LT(found.by_depth.count_missed(), found.by_depth.count());
}

TEST(RandomPlacements, AreOthersForAnotherSeedAndTheSameForTheSame) {
  const PlacementsFound a = judge_placements(box(), ball(), {.placements = 10, .seed = 1}),
                        b = judge_placements(box(), ball(), {.placements = 10, .seed = 1}),
                        c = judge_placements(box(), ball(), {.placements = 10, .seed = 2});
  EXPECT_EQ(a.by_depth.overlaps, b.by_depth.overlaps);
  EXPECT_EQ(a.by_depth.deepest, b.by_depth.deepest);
  EXPECT_NE(a.by_depth.deepest, c.by_depth.deepest);
}

// Corners of balls lie in the same directions from their middles: some have to be turned into exactly the opposite one.
TEST(RandomPlacements, TurnTheBodyRoundAsItIs) {
  const PlacementsFound found =
      judge_placements(ball(), tetrahedron_ball(2, 0.7), {.placements = 250, .seed = 1'000'004});
  EXPECT_EQ(found.overlapping, 250u);
  EXPECT_LE(found.by_depth.deepest_missed, 0.5);
}

TEST(RandomPlacements, AddUp) {
  PlacementsFound sum = judge_placements(box(), ball(), {.placements = 10, .seed = 1});
  const PlacementsFound other = judge_placements(box(), ball(), {.placements = 5, .seed = 2});
  const std::size_t before = sum.by_depth.count();
  sum.add(other);
  EXPECT_EQ(sum.placements, 15u);
  EXPECT_EQ(sum.overlapping, 15u);
  EXPECT_EQ(sum.by_depth.count(), before + other.by_depth.count());
}

}  // namespace
}  // namespace dartboard::random_placements_test
