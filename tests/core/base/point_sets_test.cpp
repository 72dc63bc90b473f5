#include "core/base/point_sets.h"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>
#include <vector>

namespace dartboard::point_sets_test {
namespace {

using Points = std::vector<std::uint32_t>;
using Sets = PointSets<4>;

TEST(PointSets, AreFoundAgainInAnyOrderOfTheirPoints) {
  Sets sets(10, 2);
  sets.number_of(Sets::set_of(Points{7, 3, 9})) = 5;
  EXPECT_EQ(sets.number_of(Sets::set_of(Points{9, 7, 3})), 5u);
  EXPECT_EQ(sets.number_of(Sets::set_of(Points{3, 7})), Sets::none);
  EXPECT_EQ(sets.number_of(Sets::set_of(Points{3, 7, 9, 8})), Sets::none);
  EXPECT_EQ(sets.number_of(Sets::set_of(Points{3, 7, 8})), Sets::none);
}

TEST(PointSets, AreAscendingAndFilledUp) {
  EXPECT_EQ(Sets::set_of(Points{4, 2}), (Sets::Set{2, 4, Sets::none, Sets::none}));
  EXPECT_EQ(PointSets<8>::set_of(Points{7, 0, 6, 1, 5, 2, 4, 3}), (PointSets<8>::Set{0, 1, 2, 3, 4, 5, 6, 7}));
}

TEST(PointSets, CountLikeATree) {
  std::mt19937 bits(3);
  Sets sets(12, 1);
  std::map<std::set<std::uint32_t>, std::uint32_t> counts;
  std::vector<std::uint32_t> in_order;
  std::vector<std::set<std::uint32_t>> order;
  for (int k = 0; k < 5000; ++k) {
    std::set<std::uint32_t> some;
    const std::size_t size = 2 + bits() % 3;
    while (some.size() < size) some.insert(static_cast<std::uint32_t>(bits() % 12));
    std::uint32_t& number = sets.number_of(Sets::set_of(Points(some.rbegin(), some.rend())));
    number = number == Sets::none ? 1 : number + 1;
    if (++counts[some] == 1) order.push_back(some);
    ASSERT_EQ(number, counts[some]);
  }
  sets.for_each([&](std::uint32_t number) { in_order.push_back(number); });
  ASSERT_EQ(in_order.size(), order.size());
  for (std::size_t k = 0; k < order.size(); ++k) EXPECT_EQ(in_order[k], counts[order[k]]);
}

}  // namespace
}  // namespace dartboard::point_sets_test
