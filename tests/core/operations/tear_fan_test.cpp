#include "core/operations/tear_fan.h"

#include <gtest/gtest.h>

#include <set>

#include "core/plain/error.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"
#include "core/topology/check.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::tear_fan_test {
namespace {

template <class Map>
struct Fan : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(Fan, Solids);

// A hexahedral or Kuhn grid of 2 x 2 x 2 cubes has one inner point, its middle.
template <class Map>
bool is_inner_vertex(const Map& map, Dart d) {
  return !for_each_dart_of(map, Vertex{d}, [&](Dart e) { return map.template is_free<3>(e); });
}

TEST(FanOfHexahedra, IsTheFourFacesOfAPlaneThroughTheVertex) {
  const auto map = build_map<Map3>(hexahedron_box(2, 2, 2, 1.0)).map;
  int inner = 0;
  map.for_each_dart([&](Dart d) {
    if (!is_inner_vertex(map, d)) return;
    ++inner;
    EXPECT_EQ(fan(map, d).size(), 4u);
  });
  EXPECT_EQ(inner, 8 * 6);  // the corner of each of eight cubes has six darts
}

TEST(FanOfHexahedra, TornApartHalvesTheVertex) {
  auto map = build_map<Map3>(hexahedron_box(2, 2, 2, 1.0)).map;
  Dart inner = no_dart;
  map.for_each_dart([&](Dart d) {
    if (is_inner_vertex(map, d)) inner = d;
  });
  const TopologyChange change = tear_fan(map, inner);
  EXPECT_EQ(change.faces.size(), 4u);
  // the four faces reach the boundary: the body is cut in two halves of 2 x 2 cubes
  EXPECT_EQ(change.vertices.size(), 9u);
  EXPECT_EQ(change.edges.size(), 12u);
  EXPECT_EQ(count_orbits(map, all_involutions(3)), 2u);
  EXPECT_EQ(check(map), "");
}

TYPED_TEST(Fan, StaysWithTheVertexAndListsEachFaceOnce) {
  const auto map = build_map<TypeParam>(kuhn_grid(2, 2, 2, 1.0)).map;
  map.for_each_dart([&](Dart d) {
    std::set<Dart> faces;
    for (const Dart e : fan(map, d)) {
      ASSERT_TRUE(same_cell<0>(map, d, e));
      Dart lowest = e;
      for_each_dart_of(map, Face{e}, [&](Dart x) { lowest = std::min(lowest, x); });
      ASSERT_TRUE(faces.insert(lowest).second);
    }
  });
}

TYPED_TEST(Fan, OpenAtTheSurfaceIsFoundFromEitherEnd) {
  const auto map = build_map<TypeParam>(unequal_tetrahedra()).map;
  map.for_each_dart([&](Dart d) {
    if (map.template is_free<3>(d)) return;
    EXPECT_EQ(fan(map, d), (std::vector<Dart>{d}));  // the shared face alone: both its edges lie on the surface
  });
}

TYPED_TEST(Fan, OfADeadDartIsNotTorn) {
  auto map = build_map<TypeParam>(regular_tetrahedron()).map;
  EXPECT_THROW(tear_fan(map, Dart{24}), TopologyError);
}

// For 2 x 2 cubes side by side, each inner face meets the opposite one along the edge in the middle, and the surface
// along the others.
TEST(FanOfHexahedra, OpenAtTheSurfaceIsTheSameFromTheDartOfEitherEdge) {
  const auto map = build_map<Map3>(hexahedron_box(2, 2, 1, 1.0)).map;
  int of_two = 0;
  map.for_each_dart([&](Dart d) {
    if (map.is_free<3>(d)) return;
    EXPECT_EQ(fan(map, d).size(), fan(map, map.alpha<1>(d)).size());
    of_two += fan(map, d).size() == 2 ? 1 : 0;
  });
  EXPECT_EQ(of_two, 4 * 2 * 2 * 2);  // four faces, their two sides, the two ends of the middle edge, two darts at each
}

}  // namespace
}  // namespace dartboard::tear_fan_test
