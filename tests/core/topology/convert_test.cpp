#include "core/topology/convert.h"

#include <gtest/gtest.h>

#include "core/plain/error.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"
#include "core/topology/check.h"
#include "core/topology/sew.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::convert_test {
namespace {

TEST(ToGeneral, KeepsEveryAlphaUnderTheSameNumbers) {
  auto tets = build_map<TetMap>(kuhn_grid(2, 1, 1, 1.0)).map;
  for (std::uint32_t p = 24; p < 48; ++p) unsew<3>(tets, Dart{p});
  tets.remove_tetrahedron({24});
  const Map3 general = to_general(tets);
  EXPECT_EQ(check(general), "");
  EXPECT_EQ(general.dart_count(), tets.dart_count());
  tets.for_each_dart([&](Dart d) {
    for (int i = 0; i <= 3; ++i) ASSERT_EQ(general.alpha(i, d), tets.alpha(i, d));
  });
  EXPECT_FALSE(general.is_live({24}));
}

TEST(CombinatorialMap, HasHalfTheDarts) {
  const auto map = build_map<TetMap>(regular_tetrahedron()).map;
  EXPECT_EQ(to_combinatorial_map(map).beta.size(), 12u);
}

TEST(CombinatorialMap, ThereAndBackIsIsomorphic) {
  const auto map = build_map<Map3>(kuhn_grid(2, 2, 1, 1.0)).map;
  const Map3 back = to_generalized_map<3>(to_combinatorial_map(map));
  EXPECT_EQ(check(back), "");
  EXPECT_TRUE(are_isomorphic(map, back));
}

TEST(CombinatorialMap, OfASurfaceGoesThereAndBackToo) {
  Mesh sheet;
  sheet.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  sheet.add_cell(CellKind::triangle, std::array<std::uint32_t, 3>{0, 1, 2});
  sheet.add_cell(CellKind::triangle, std::array<std::uint32_t, 3>{0, 2, 3});
  const auto map = build_map<Map2>(sheet).map;
  EXPECT_TRUE(are_isomorphic(map, to_generalized_map<2>(to_combinatorial_map(map))));
}

TEST(CombinatorialMap, CannotHoldADartThatIsOneFree) {
  Map2 map;
  const Dart a = map.add_dart(), b = map.add_dart();
  map.link<0>(a, b);
  EXPECT_THROW(to_combinatorial_map(map), InputError);
}

TEST(CombinatorialMap, CannotHoldAMoebiusStrip) {
  // one square whose opposite edges are sewn with a twist
  Map2 map;
  const Dart d = add_cell(map, CellKind::quadrilateral);
  sew<2>(map, d, Dart{d.index + 4});  // edge 0 to edge 2, running the same way around the square
  EXPECT_THROW(to_combinatorial_map(map), InputError);
}

TEST(Isomorphism, SeesOneUnsewnFaceThatNoCountOfCellsButFacesShows) {
  const auto whole = build_map<Map3>(kuhn_grid(2, 2, 2, 1.0)).map;
  auto cut = whole;
  Dart inner = no_dart;  // a face whose dissociation takes no edge or vertex apart
  whole.for_each_dart([&](Dart d) {
    if (inner != no_dart || whole.is_free<3>(d)) return;
    auto trial = whole;
    unsew<3>(trial, d);
    if (count_cells<0>(trial) == count_cells<0>(whole) && count_cells<1>(trial) == count_cells<1>(whole)) inner = d;
  });
  ASSERT_NE(inner, no_dart);
  unsew<3>(cut, inner);
  EXPECT_TRUE(are_isomorphic(whole, whole));
  EXPECT_FALSE(are_isomorphic(whole, cut));
}

TEST(Isomorphism, DoesNotDependOnTheOrderOfCells) {
  Mesh mesh = unequal_tetrahedra(), reversed;
  reversed.points = mesh.points;
  reversed.add_cell(CellKind::tetrahedron, mesh.cell(1));
  reversed.add_cell(CellKind::tetrahedron, mesh.cell(0));
  EXPECT_TRUE(are_isomorphic(build_map<TetMap>(mesh).map, build_map<Map3>(reversed).map));
}

TEST(Isomorphism, TellsOneComponentFromTwo) {
  const auto joined = build_map<Map3>(unequal_tetrahedra()).map;
  Map3 apart;
  add_cell(apart, CellKind::tetrahedron);
  add_cell(apart, CellKind::tetrahedron);
  EXPECT_FALSE(are_isomorphic(joined, apart));
}

TEST(Isomorphism, TellsAMapFromALargerOneThatContainsIt) {
  Map3 one, two;
  add_cell(one, CellKind::tetrahedron);
  add_cell(two, CellKind::tetrahedron);
  add_cell(two, CellKind::tetrahedron);
  EXPECT_FALSE(are_isomorphic(one, two));
}

// The first dart lies on the border in one map and on the shared edge in the other: the search must start over.
TEST(Isomorphism, IsFoundAfterAStartThatFails) {
  Mesh mesh, turned;
  mesh.points = turned.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.add_cell(CellKind::triangle, std::array<std::uint32_t, 3>{0, 1, 2});
  mesh.add_cell(CellKind::triangle, std::array<std::uint32_t, 3>{0, 2, 3});
  turned.add_cell(CellKind::triangle, std::array<std::uint32_t, 3>{2, 0, 1});
  turned.add_cell(CellKind::triangle, std::array<std::uint32_t, 3>{0, 2, 3});
  EXPECT_TRUE(are_isomorphic(build_map<Map2>(mesh).map, build_map<Map2>(turned).map));
}

}  // namespace
}  // namespace dartboard::convert_test
