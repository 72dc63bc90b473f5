#include "core/operations/dissociate_all.h"

#include <gtest/gtest.h>

#include "core/operations/dissociate_face.h"
#include "core/plain/error.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"
#include "core/topology/check.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::dissociate_all_test {
namespace {

template <class Map>
struct DissociateAll : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(DissociateAll, Solids);

template <int i, class Map>
std::vector<Dart> all_facets(const Map& map) {
  std::vector<Dart> darts;
  for_each_cell<i>(map, [&](Cell<i> facet) { darts.push_back(facet.dart); });
  return darts;
}

TYPED_TEST(DissociateAll, TakesABodyApartIntoItsCells) {
  auto map = build_map<TypeParam>(kuhn_grid(2, 1, 1, 1.0)).map;
  const auto faces = all_facets<2>(map);
  const std::size_t shared = 12 * 4 - faces.size();
  const TopologyChange change = dissociate_all(map, faces);
  EXPECT_EQ(change.faces.size(), shared);
  EXPECT_EQ(count_cells<0>(map), 12u * 4u);
  EXPECT_EQ(count_orbits(map, all_involutions(3)), 12u);
  EXPECT_EQ(check(map), "");
}

TYPED_TEST(DissociateAll, IsTheSeriesOfTheSingleOnes) {
  auto map = build_map<TypeParam>(kuhn_grid(2, 1, 1, 1.0)).map;
  auto one_by_one = map;
  const auto faces = all_facets<2>(map);
  const std::vector<Dart> some(faces.begin(), faces.begin() + 20);
  const TopologyChange change = dissociate_all(map, some);
  TopologyChange series;
  for (const Dart d : some) series.append(dissociate_face(one_by_one, d));
  EXPECT_EQ(map.hash(), one_by_one.hash());
  EXPECT_EQ(change.vertices.size(), series.vertices.size());
  EXPECT_EQ(change.edges.size(), series.edges.size());
  EXPECT_EQ(change.faces.size(), series.faces.size());
}

TYPED_TEST(DissociateAll, PassesOverFacesThatAreFreeAlready) {
  auto map = build_map<TypeParam>(unequal_tetrahedra()).map;
  Dart shared = no_dart;
  map.for_each_dart([&](Dart d) {
    if (!map.template is_free<3>(d)) shared = d;
  });
  const std::vector<Dart> twice{shared, map.template alpha<3>(shared), map.template alpha<2>(shared)};
  EXPECT_EQ(dissociate_all(map, twice).faces.size(), 1u);
}

TYPED_TEST(DissociateAll, OfADeadDartIsRefusedBeforeAnythingIsDone) {
  auto map = build_map<TypeParam>(unequal_tetrahedra()).map;
  const auto before = map.hash();
  std::vector<Dart> darts;
  map.for_each_dart([&](Dart d) { darts.push_back(d); });
  darts.push_back(Dart{48});
  EXPECT_THROW(dissociate_all(map, darts), TopologyError);
  EXPECT_EQ(map.hash(), before);
}

TEST(DissociateAllOfASurface, SeparatesFacesAtTheirEdges) {
  auto map = build_map<Map2>(klein_lattice()).map;
  const TopologyChange change = dissociate_all(map, all_facets<1>(map));
  EXPECT_EQ(change.edges.size(), 24u);  // 12 quadrilaterals, closed
  EXPECT_EQ(count_cells<0>(map), 12u * 4u);
  EXPECT_EQ(count_orbits(map, all_involutions(2)), 12u);
}

}  // namespace
}  // namespace dartboard::dissociate_all_test
