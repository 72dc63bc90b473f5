// The paper's Fig. 5, a 2-g-map of three faces, written dart by dart.
//
// Given by the paper: the alphas of darts 1..10 (table of section 2.1), hence alpha1(18) = 9, alpha1(13) = 10,
// alpha2(20) = 3 and alpha2(19) = 4; from the edge {3,4,19,20}, alpha0(19) = 20; from the vertex {2,3,20,21},
// alpha1(20) = 21 and 21 is 2-free; from the face {9,10,13,14,17,18}, that 13, 14, 17, 18 close a triangle with 9, 10.
// The table makes f1 the quadrilateral 1..8. The darts left, 11, 12, 15, 16, 19..22, make the face f2 of 20 a
// quadrilateral, and no dart above 22 is needed.
//
// Completed here (marked below): the pairing of consecutive numbers by alpha0, the order of the edges of f2, and the
// edge by which f2 and the triangle f3 touch. Any such choice keeps every statement of the text.

#include <gtest/gtest.h>

#include <array>
#include <set>
#include <utility>
#include <vector>

#include "core/topology/cells.h"
#include "core/topology/check.h"

namespace dartboard::figure5_test {
namespace {

using Pairs = std::vector<std::pair<unsigned, unsigned>>;

Dart dart(unsigned number) { return {number - 1}; }  // the paper counts from 1
unsigned number(Dart d) { return d.index + 1; }

Map2 figure5() {
  Map2 map;
  for (int k = 0; k < 22; ++k) map.add_dart();
  const Pairs alpha0{{1, 2},   {3, 4},   {5, 6},   {7, 8},   {9, 10}, {19, 20},
                     {11, 12}, {13, 14}, {15, 16}, {17, 18}, {21, 22}};  // this line completed
  const Pairs alpha1{{1, 5},   {2, 3},   {4, 8},   {6, 7},   {9, 18}, {10, 13},
                     {20, 21}, {14, 17}, {22, 15}, {16, 11}, {12, 19}};  // this line completed
  const Pairs alpha2{{3, 20}, {4, 19}, {13, 16}, {14, 15}};              // the last two completed
  for (const auto& [a, b] : alpha0) map.link<0>(dart(a), dart(b));
  for (const auto& [a, b] : alpha1) map.link<1>(dart(a), dart(b));
  for (const auto& [a, b] : alpha2) map.link<2>(dart(a), dart(b));
  return map;
}

template <int... i>
std::set<unsigned> orbit_numbers(const Map2& map, unsigned from) {
  std::set<unsigned> numbers;
  for (const Dart d : orbit<i...>(map, dart(from))) numbers.insert(number(d));
  return numbers;
}

TEST(Figure5, HasTheAlphasOfThePapersTable) {
  const Map2 map = figure5();
  const std::array<unsigned, 10> alpha0{2, 1, 4, 3, 6, 5, 8, 7, 10, 9};
  const std::array<unsigned, 10> alpha1{5, 3, 2, 8, 1, 7, 6, 4, 18, 13};
  const std::array<unsigned, 10> alpha2{1, 2, 20, 19, 5, 6, 7, 8, 9, 10};
  for (unsigned k = 1; k <= 10; ++k) {
    EXPECT_EQ(number(map.alpha<0>(dart(k))), alpha0[k - 1]) << k;
    EXPECT_EQ(number(map.alpha<1>(dart(k))), alpha1[k - 1]) << k;
    EXPECT_EQ(number(map.alpha<2>(dart(k))), alpha2[k - 1]) << k;
  }
}

TEST(Figure5, IsAValidMap) { EXPECT_EQ(check(figure5()), ""); }

TEST(Figure5, TheVertexOfDart2IsTheOrbitOfThePaper) {
  EXPECT_EQ((orbit_numbers<1, 2>(figure5(), 2)), (std::set<unsigned>{2, 3, 20, 21}));
}

TEST(Figure5, TheEdgeOfDart3IsTheOrbitOfThePaper) {
  EXPECT_EQ((orbit_numbers<0, 2>(figure5(), 3)), (std::set<unsigned>{3, 4, 19, 20}));
}

TEST(Figure5, TheFaceOfDart9IsTheOrbitOfThePaper) {
  EXPECT_EQ((orbit_numbers<0, 1>(figure5(), 9)), (std::set<unsigned>{9, 10, 13, 14, 17, 18}));
}

TEST(Figure5, TheFaceOfDart1IsTheQuadrilateralOfTheTable) {
  EXPECT_EQ((orbit_numbers<0, 1>(figure5(), 1)), (std::set<unsigned>{1, 2, 3, 4, 5, 6, 7, 8}));
}

// "2 = alpha_0(1), 3 = alpha_1(2), 20 = alpha_2(3)"
TEST(Figure5, TheChainOfSection21LeadsFromDart1ToDart20) { EXPECT_EQ(number(figure5().alpha<0, 1, 2>(dart(1))), 20u); }

// Each of those steps exchanges the cell of its own dimension and keeps the other two.
TEST(Figure5, EachAlphaExchangesTheCellOfItsDimensionOnly) {
  const Map2 map = figure5();
  EXPECT_FALSE(same_cell<0>(map, dart(1), dart(2)));
  EXPECT_TRUE(same_cell<1>(map, dart(1), dart(2)));
  EXPECT_TRUE(same_cell<2>(map, dart(1), dart(2)));
  EXPECT_TRUE(same_cell<0>(map, dart(2), dart(3)));
  EXPECT_FALSE(same_cell<1>(map, dart(2), dart(3)));
  EXPECT_TRUE(same_cell<2>(map, dart(2), dart(3)));
  EXPECT_TRUE(same_cell<0>(map, dart(3), dart(20)));
  EXPECT_TRUE(same_cell<1>(map, dart(3), dart(20)));
  EXPECT_FALSE(same_cell<2>(map, dart(3), dart(20)));
}

template <int i>
void expect_partition(const Map2& map, std::size_t cells) {
  std::vector<int> met(map.capacity(), 0);
  std::size_t count = 0;
  for_each_cell<i>(map, [&](Cell<i> cell) {
    ++count;
    for (const Dart d : orbit(map, cell)) ++met[d.index];
  });
  EXPECT_EQ(count, cells);
  EXPECT_EQ(met, std::vector<int>(22, 1));  // every dart in exactly one cell
}

TEST(Figure5, VerticesPartitionTheDarts) { expect_partition<0>(figure5(), 7); }
TEST(Figure5, EdgesPartitionTheDarts) { expect_partition<1>(figure5(), 9); }  // 4 + 4 + 3 sides, two of them shared
TEST(Figure5, FacesPartitionTheDarts) { expect_partition<2>(figure5(), 3); }

TEST(Figure5, TwoFreeDartsFormTheBoundary) {
  const Map2 map = figure5();
  std::size_t free = 0;
  map.for_each_dart([&](Dart d) { free += map.is_free<2>(d) ? 1u : 0u; });
  EXPECT_EQ(free, 14u);  // seven boundary edges, two darts each
}

}  // namespace
}  // namespace dartboard::figure5_test
