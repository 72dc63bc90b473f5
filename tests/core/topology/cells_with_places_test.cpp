#include "core/topology/cells_with_places.h"

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "core/topology/build.h"
#include "core/topology/sew.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::cells_with_places_test {
namespace {

/// The same cells in the same order as a coverage of them, and every place of each once, that of its dart first.
template <int i, class Map>
void expect_all_places(const Map& map) {
  std::vector<Dart> cells, covered;
  for_each_cell<i>(map, [&](Cell<i> cell) { cells.push_back(cell.dart); });
  for_each_cell_with_places<i>(map, [&](Cell<i> cell, std::span<const Dart> places) {
    covered.push_back(cell.dart);
    std::set<std::uint32_t> expected, found;
    for_each_dart_of(map, cell, [&](Dart d) { expected.insert(Map::template slot<i>(d)); });
    for (const Dart d : places) EXPECT_TRUE(found.insert(Map::template slot<i>(d)).second);
    EXPECT_EQ(found, expected);
    EXPECT_EQ(Map::template slot<i>(places.front()), Map::template slot<i>(cell.dart));
  });
  EXPECT_EQ(covered, cells);
}

TEST(CellsWithPlaces, AreTheCellsOfTetrahedraSewnUnsewnAndDead) {
  auto map = build_map<TetMap>(kuhn_grid(2, 2, 1, 1.0)).map;
  for (const Dart d : {Dart{6}, Dart{30}, Dart{102}}) unsew<3>(map, d);
  for (std::uint32_t p = 0; p < 24; p += 6) unsew<3>(map, {96 + p});
  remove_cell(map, Dart{96});
  expect_all_places<0>(map);
  expect_all_places<1>(map);
  expect_all_places<2>(map);
  expect_all_places<3>(map);
}

TEST(CellsWithPlaces, AreTheCellsOfAnyMap) {
  const auto solid = build_map<Map3>(mixed_cells()).map;
  expect_all_places<0>(solid);
  expect_all_places<1>(solid);
  expect_all_places<2>(solid);
  expect_all_places<3>(solid);
  const auto surface = build_map<Map2>(moebius_lattice()).map;
  expect_all_places<0>(surface);
  expect_all_places<1>(surface);
  expect_all_places<2>(surface);
}

}  // namespace
}  // namespace dartboard::cells_with_places_test
