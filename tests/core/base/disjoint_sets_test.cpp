#include "core/base/disjoint_sets.h"

#include <gtest/gtest.h>

namespace dartboard::disjoint_sets_test {
namespace {

TEST(DisjointSets, AreKnownByTheirLowestItem) {
  DisjointSets sets(6);
  sets.join(5, 3);
  sets.join(3, 4);
  sets.join(1, 4);
  for (const std::uint32_t k : {1u, 3u, 4u, 5u}) EXPECT_EQ(sets.set_of(k), 1u) << k;
  EXPECT_EQ(sets.set_of(0), 0u);
  EXPECT_EQ(sets.set_of(2), 2u);
}

TEST(DisjointSets, AreOneFewerForEachJoinOfTwo) {
  DisjointSets sets(4);
  EXPECT_EQ(sets.count(), 4u);
  sets.join(0, 1);
  sets.join(2, 3);
  EXPECT_EQ(sets.count(), 2u);
  sets.join(1, 0);
  EXPECT_EQ(sets.count(), 2u);
  sets.join(3, 0);
  EXPECT_EQ(sets.count(), 1u);
}

}  // namespace
}  // namespace dartboard::disjoint_sets_test
