#include "core/operations/remove_volume.h"

#include <gtest/gtest.h>

#include "core/operations/remove_component.h"
#include "core/plain/error.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"
#include "core/topology/check.h"
#include "core/topology/summary.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::remove_volume_test {
namespace {

template <class Map>
struct RemoveVolume : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(RemoveVolume, Solids);

TYPED_TEST(RemoveVolume, OfTheOnlyOneLeavesNothing) {
  auto map = build_map<TypeParam>(regular_tetrahedron()).map;
  const TopologyChange change = remove_volume(map, Dart{5});
  EXPECT_EQ(map.dart_count(), 0u);
  EXPECT_EQ(change.removed_vertices.size(), 4u);
  EXPECT_EQ(change.removed_edges.size(), 6u);
  EXPECT_EQ(change.removed_faces.size(), 4u);
  EXPECT_EQ(change.removed_volumes.size(), 1u);
  EXPECT_TRUE(change.vertices.empty());
}

TYPED_TEST(RemoveVolume, LeavesTheNeighbourWholeAndItsFaceOnTheBoundary) {
  auto map = build_map<TypeParam>(unequal_tetrahedra()).map;
  const TopologyChange change = remove_volume(map, Dart{24});
  EXPECT_EQ(change.vertices.size(), 3u);
  EXPECT_EQ(change.edges.size(), 3u);
  const MapSummary s = summarize(map);
  EXPECT_EQ(s.cells, (std::vector<std::size_t>{4, 6, 4, 1}));
  EXPECT_EQ(s.boundary_facets, 4u);
  EXPECT_EQ(s.violation, "");
}

TYPED_TEST(RemoveVolume, LetsTheNeighboursKeep) {
  auto map = build_map<TypeParam>(kuhn_grid(1, 1, 1, 1.0)).map;
  const TopologyChange change = remove_volume(map, Dart{48});
  for (const auto& pairs : {change.vertices, change.edges, change.faces})
    for (const DissociatedCell& pair : pairs) EXPECT_TRUE(map.is_live(pair.kept));
}

TYPED_TEST(RemoveVolume, OneByOneEmptiesTheBody) {
  auto map = build_map<TypeParam>(kuhn_grid(2, 2, 1, 1.0)).map;
  std::uint32_t state = 1;
  std::size_t volumes = 24;
  while (map.dart_count() > 0) {
    state = state * 1664525u + 1013904223u;
    const Dart d{state % static_cast<std::uint32_t>(map.capacity())};
    if (!map.is_live(d)) continue;
    remove_volume(map, d);
    ASSERT_EQ(check(map), "");
    ASSERT_EQ(count_cells<3>(map), --volumes);
  }
}

TYPED_TEST(RemoveVolume, OfAWholeComponentTellsEachOfItsCellsOnce) {
  auto map = build_map<TypeParam>(unequal_tetrahedra()).map;
  const TopologyChange change = remove_component(map, Dart{30});
  EXPECT_EQ(map.dart_count(), 0u);
  EXPECT_EQ(change.removed_vertices.size(), 5u);
  EXPECT_EQ(change.removed_edges.size(), 9u);
  EXPECT_EQ(change.removed_faces.size(), 7u);
  EXPECT_EQ(change.removed_volumes.size(), 2u);
  EXPECT_THROW(remove_component(map, Dart{30}), TopologyError);
}

TYPED_TEST(RemoveVolume, OfADeadDartIsRefused) {
  auto map = build_map<TypeParam>(regular_tetrahedron()).map;
  remove_volume(map, Dart{0});
  EXPECT_THROW(remove_volume(map, Dart{0}), TopologyError);
}

TEST(RemoveVolumeOfHexahedra, InTheMiddleLeavesACavity) {
  auto map = build_map<Map3>(hexahedron_box(3, 3, 3, 1.0)).map;
  remove_volume(map, Dart{13 * 48});
  const MapSummary s = summarize(map);
  EXPECT_EQ(s.cells[3], 26u);
  EXPECT_EQ(s.boundary_facets, 54u + 6u);
  EXPECT_EQ(s.euler, 2);  // a ball with a cavity
}

}  // namespace
}  // namespace dartboard::remove_volume_test
