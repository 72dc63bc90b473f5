#include "core/topology/cells.h"

#include <gtest/gtest.h>

#include <array>
#include <set>

#include "core/topology/build.h"
#include "core/topology/sew.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::cells_test {
namespace {

template <class Map>
std::array<std::size_t, 4> counts(const Map& map) {
  return {count_cells<0>(map), count_cells<1>(map), count_cells<2>(map), count_cells<3>(map)};
}
using Counts = std::array<std::size_t, 4>;

template <class Map>
class Cells : public testing::Test {};
using Maps = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(Cells, Maps);

TYPED_TEST(Cells, OfOneTetrahedron) {
  const auto map = build_map<TypeParam>(regular_tetrahedron()).map;
  EXPECT_EQ(map.dart_count(), 24u);
  EXPECT_EQ(counts(map), (Counts{4, 6, 4, 1}));
}

TYPED_TEST(Cells, OfTwoTetrahedraSharingAFace) {
  const auto map = build_map<TypeParam>(unequal_tetrahedra()).map;
  EXPECT_EQ(map.dart_count(), 48u);
  EXPECT_EQ(counts(map), (Counts{5, 9, 7, 2}));
}

TYPED_TEST(Cells, OfTheKuhnCube) {
  const auto map = build_map<TypeParam>(kuhn_grid(1, 1, 1, 1.0)).map;
  EXPECT_EQ(map.dart_count(), 144u);
  EXPECT_EQ(counts(map), (Counts{8, 19, 18, 6}));
}

// One box of Kuhn: 24 = 6 * 4 vertices, 36 = 6 * 6 edges, 24 = 6 * 4 faces.
TYPED_TEST(Cells, OfTheKuhnCubeAfterUnsewingEveryFace) {
  auto map = build_map<TypeParam>(kuhn_grid(1, 1, 1, 1.0)).map;
  for (std::uint32_t d = 0; d < map.capacity(); ++d) unsew<3>(map, {d});
  EXPECT_EQ(counts(map), (Counts{24, 36, 24, 6}));
}

TYPED_TEST(Cells, AroundAVertexOfTwoTetrahedra) {
  const auto map = build_map<TypeParam>(unequal_tetrahedra()).map;
  std::multiset<std::array<std::size_t, 3>> found;  // edges, faces, volumes around each vertex
  for_each_cell<0>(map, [&](Vertex v) {
    found.insert(
        {incident_cells<1>(map, v).size(), incident_cells<2>(map, v).size(), incident_cells<3>(map, v).size()});
  });
  // tips see one tetrahedron; a corner of the shared face sees 4 edges, that face, 2 more of each side
  EXPECT_EQ(found, (std::multiset<std::array<std::size_t, 3>>{{3, 3, 1}, {3, 3, 1}, {4, 5, 2}, {4, 5, 2}, {4, 5, 2}}));
}

TYPED_TEST(Cells, OfATetrahedronAndBack) {
  const auto map = build_map<TypeParam>(unequal_tetrahedra()).map;
  for_each_cell<3>(map, [&](Volume v) {
    EXPECT_EQ((incident_cells<0>(map, v).size()), 4u);
    EXPECT_EQ((incident_cells<1>(map, v).size()), 6u);
    EXPECT_EQ((incident_cells<2>(map, v).size()), 4u);
  });
  std::size_t sides = 0;
  for_each_cell<2>(map, [&](Face f) {
    EXPECT_EQ((incident_cells<0>(map, f).size()), 3u);
    EXPECT_EQ((incident_cells<1>(map, f).size()), 3u);
    sides += incident_cells<3>(map, f).size();
  });
  EXPECT_EQ(sides, 8u);
  for_each_cell<1>(map, [&](Edge e) { EXPECT_EQ((incident_cells<0>(map, e).size()), 2u); });
}

// The main diagonal of a Kuhn cube lies in all six tetrahedra.
TYPED_TEST(Cells, AroundTheEdgesOfTheKuhnCube) {
  const auto map = build_map<TypeParam>(kuhn_grid(1, 1, 1, 1.0)).map;
  std::multiset<std::size_t> volumes;
  for_each_cell<1>(map, [&](Edge e) { volumes.insert(incident_cells<3>(map, e).size()); });
  EXPECT_EQ(volumes.count(6), 1u);
  EXPECT_EQ(volumes.count(2), 12u);  // the diagonals of the cube's faces, and the 6 edges that meet the main diagonal
  EXPECT_EQ(volumes.count(1), 6u);   // the other edges of the cube
  EXPECT_EQ(volumes.size(), 19u);
}

TYPED_TEST(Cells, IncidenceIsMutual) {
  const auto map = build_map<TypeParam>(kuhn_grid(2, 1, 1, 1.0)).map;
  std::size_t from_vertices = 0, from_volumes = 0;
  for_each_cell<0>(map, [&](Vertex v) { from_vertices += incident_cells<3>(map, v).size(); });
  for_each_cell<3>(map, [&](Volume v) { from_volumes += incident_cells<0>(map, v).size(); });
  EXPECT_EQ(from_vertices, 48u);  // 12 tetrahedra of 4 vertices
  EXPECT_EQ(from_volumes, 48u);
}

TYPED_TEST(Cells, AVertexThatAVolumeMeetsTwiceIsIncidentOnce) {
  TypeParam map;
  const Dart d = add_cell(map, CellKind::tetrahedron);
  sew<3>(map, d, map.template alpha<2>(d));  // two faces folded together along their edge
  EXPECT_EQ((incident_cells<0>(map, Volume{d}).size()), 3u);
  EXPECT_EQ((incident_cells<3>(map, Vertex{d}).size()), 1u);
}

TEST(SurfaceCells, OfAGridOfQuadrilaterals) {
  const Map2 map = build_map<Map2>(quadrilateral_grid(3, 2)).map;
  EXPECT_EQ(count_cells<0>(map), 12u);
  EXPECT_EQ(count_cells<1>(map), 17u);
  EXPECT_EQ(count_cells<2>(map), 6u);
}

TEST(CellWalks, TellWhetherTwoDartsShareACell) {
  const Map3 map = build_map<Map3>(unequal_tetrahedra()).map;
  const Dart d{0};
  EXPECT_TRUE(same_cell<0>(map, d, map.alpha<1>(d)));
  EXPECT_FALSE(same_cell<0>(map, d, map.alpha<0>(d)));
  EXPECT_FALSE(same_cell<3>(map, {0}, {24}));
  EXPECT_TRUE(same_cell<3>(map, {0}, {23}));
}

}  // namespace
}  // namespace dartboard::cells_test
