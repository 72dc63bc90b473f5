// The same bits everywhere: walks, storages, repeated runs, and every preset, because the number is pinned here.

#include <gtest/gtest.h>

#include "benchmarks/scenes.h"
#include "core/mechanics/mass_spring_body.h"
#include "core/time/runge_kutta_4.h"
#include "core/views/cell_arrays.h"
#include "core/views/dart_coverage.h"
#include "core/views/embedding_lists.h"

namespace dartboard {
namespace {

// After 20 steps of the scene `liver`. It changes only when the scene or the order of its sums does: say so in the
// commit.
constexpr std::uint64_t pinned = 0x58a4e0c7384a4139;

template <class Map, Held held, class Walk>
std::uint64_t hash_after_20_steps() {
  const Problem problem = scene("liver").make();
  auto body = build_body<Map, held>(problem);
  Walk walk;
  if constexpr (requires { walk.rebuild(body); }) walk.rebuild(body);
  RungeKutta4 integrator;
  for (int k = 0; k < 20; ++k) integrator.step(walk, body, problem.h);
  return body.state_hash();
}

constexpr auto one = Held::by_one_dart;
constexpr auto every = Held::by_every_dart;

TEST(StateHash, OfDartCoverageIsThePinnedOne) { EXPECT_EQ((hash_after_20_steps<Map3, one, DartCoverage>()), pinned); }
TEST(StateHash, OfEmbeddingListsIsThePinnedOne) {
  EXPECT_EQ((hash_after_20_steps<Map3, one, EmbeddingLists>()), pinned);
}
TEST(StateHash, OfCellArraysIsThePinnedOne) { EXPECT_EQ((hash_after_20_steps<Map3, every, CellArrays>()), pinned); }
TEST(StateHash, OfARepeatedRunIsThePinnedOne) { EXPECT_EQ((hash_after_20_steps<Map3, every, CellArrays>()), pinned); }
TEST(StateHash, OfTetrahedralStorageIsThePinnedOne) {
  EXPECT_EQ((hash_after_20_steps<TetMap, every, CellArrays>()), pinned);
  EXPECT_EQ((hash_after_20_steps<TetMap, one, DartCoverage>()), pinned);
}

}  // namespace
}  // namespace dartboard
