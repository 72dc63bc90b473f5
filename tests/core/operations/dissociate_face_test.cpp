#include "core/operations/dissociate_face.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/plain/error.h"
#include "core/topology/build.h"
#include "core/topology/cells.h"
#include "core/topology/check.h"
#include "core/topology/sew.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::dissociate_face_test {
namespace {

template <class Map>
struct DissociateFace : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(DissociateFace, Solids);

template <class Map>
Dart some_inner_dart(const Map& map) {
  Dart found = no_dart;
  map.for_each_dart([&](Dart d) {
    if (found == no_dart && !map.template is_free<3>(d)) found = d;
  });
  return found;
}

// The same numbers from both, in any order.
bool same_cells(std::vector<DissociatedCell> a, std::vector<DissociatedCell> b) {
  const auto less = [](const DissociatedCell& x, const DissociatedCell& y) {
    return std::pair(x.kept, x.split) < std::pair(y.kept, y.split);
  };
  std::sort(a.begin(), a.end(), less);
  std::sort(b.begin(), b.end(), less);
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const auto& x, const auto& y) { return x.kept == y.kept && x.split == y.split; });
}

TYPED_TEST(DissociateFace, BetweenTwoTetrahedraSplitsTheFaceAndItsThreeEdgesAndVertices) {
  auto map = build_map<TypeParam>(unequal_tetrahedra()).map;
  const Dart d = some_inner_dart(map);
  const TopologyChange change = dissociate_face(map, d);
  EXPECT_EQ(change.vertices.size(), 3u);
  EXPECT_EQ(change.edges.size(), 3u);
  EXPECT_EQ(change.faces.size(), 1u);
  EXPECT_EQ(check(map), "");
  EXPECT_EQ(count_cells<0>(map), 8u);
  EXPECT_EQ(count_cells<1>(map), 12u);
  EXPECT_EQ(count_cells<2>(map), 8u);
}

TYPED_TEST(DissociateFace, KeepsTheSideOfTheGivenDart) {
  auto map = build_map<TypeParam>(unequal_tetrahedra()).map;
  const Dart d = map.template alpha<3>(some_inner_dart(map));
  const TopologyChange change = dissociate_face(map, d);
  EXPECT_EQ(change.faces[0].kept, d);
  for (const auto& cells : {change.vertices, change.edges})
    for (const DissociatedCell& c : cells) {
      EXPECT_TRUE(same_cell<3>(map, c.kept, d));
      EXPECT_FALSE(same_cell<3>(map, c.split, d));
    }
}

TYPED_TEST(DissociateFace, OnTheBoundaryChangesNothing) {
  auto map = build_map<TypeParam>(regular_tetrahedron()).map;
  const auto before = map.hash();
  EXPECT_TRUE(dissociate_face(map, Dart{0}).empty());
  EXPECT_EQ(map.hash(), before);
}

TYPED_TEST(DissociateFace, OfADeadDartIsRefused) {
  auto map = build_map<TypeParam>(regular_tetrahedron()).map;
  EXPECT_THROW(dissociate_face(map, Dart{99}), TopologyError);
}

TYPED_TEST(DissociateFace, ReportsExactlyTheCellsThatTheCountsGain) {
  auto map = build_map<TypeParam>(kuhn_grid(2, 2, 2, 1.0)).map;
  for (Dart d = some_inner_dart(map); d != no_dart; d = some_inner_dart(map)) {
    const std::size_t v = count_cells<0>(map), e = count_cells<1>(map), f = count_cells<2>(map);
    const TopologyChange change = dissociate_face(map, d);
    ASSERT_EQ(count_cells<0>(map) - v, change.vertices.size());
    ASSERT_EQ(count_cells<1>(map) - e, change.edges.size());
    ASSERT_EQ(count_cells<2>(map) - f, change.faces.size());
    ASSERT_EQ(check(map), "");
  }
}

TYPED_TEST(DissociateFace, AgreesWithAppendixAOnEveryFaceInEveryOrder) {
  auto fast = build_map<TypeParam>(kuhn_grid(2, 2, 2, 1.0)).map;
  auto by_orbits = fast;
  std::uint32_t state = 1;  // visits the darts in a scattered order
  for (int k = 0; k < 4000; ++k) {
    state = state * 1664525u + 1013904223u;
    const Dart d{state % static_cast<std::uint32_t>(fast.capacity())};
    const TopologyChange a = dissociate_face(fast, d), b = dissociate_face_by_orbits(by_orbits, d);
    ASSERT_TRUE(same_cells(a.vertices, b.vertices) && same_cells(a.edges, b.edges) && same_cells(a.faces, b.faces));
  }
  EXPECT_EQ(some_inner_dart(fast), no_dart);
  EXPECT_EQ(fast.hash(), by_orbits.hash());
}

TYPED_TEST(DissociateFace, OfAllInnerFacesOfAKuhnCubeSplitsSixteenVerticesAndSeventeenEdges) {
  auto map = build_map<TypeParam>(kuhn_grid(1, 1, 1, 1.0)).map;
  std::size_t vertices = 0, edges = 0;
  for (Dart d = some_inner_dart(map); d != no_dart; d = some_inner_dart(map)) {
    const TopologyChange change = dissociate_face(map, d);
    vertices += change.vertices.size();
    edges += change.edges.size();
  }
  EXPECT_EQ(vertices, 16u);  // 24 - 8
  EXPECT_EQ(edges, 17u);     // 36 - 19
}

TEST(DissociateEdge, AtTheBorderOfASheetSplitsOneVertexAndTheOther) {
  // Two triangles that share an edge: both ends lie on the border, so both come apart.
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.add_cell(CellKind::triangle, std::array<std::uint32_t, 3>{0, 1, 2});
  mesh.add_cell(CellKind::triangle, std::array<std::uint32_t, 3>{0, 2, 3});
  auto map = build_map<Map2>(mesh).map;
  Dart shared = no_dart;
  map.for_each_dart([&](Dart d) {
    if (!map.is_free<2>(d)) shared = d;
  });
  const TopologyChange change = dissociate_edge(map, shared);
  EXPECT_EQ(change.edges.size(), 1u);
  EXPECT_EQ(change.vertices.size(), 2u);
  EXPECT_EQ(count_cells<0>(map), 6u);
  EXPECT_EQ(check(map), "");
}

// The fold lays two edges of the triangle on each other, and the third on itself.
TYPED_TEST(DissociateFace, FoldedOntoItselfSplitsNoFaceAndReportsItsEdgeOnce) {
  auto map = build_map<TypeParam>(regular_tetrahedron()).map;
  sew<3>(map, Dart{0}, Dart{1});
  ASSERT_EQ(count_cells<1>(map), 5u);
  const TopologyChange change = dissociate_face(map, Dart{0});
  EXPECT_TRUE(change.faces.empty());
  EXPECT_EQ(count_cells<1>(map), 6u);
  EXPECT_EQ(change.edges.size(), 1u);
}

// Two faces of a tetrahedron sewn so that their common edge meets itself the other way round: it stays one edge.
TYPED_TEST(DissociateFace, KeepsAnEdgeThatHoldsTogetherWithATwist) {
  auto map = build_map<TypeParam>(regular_tetrahedron()).map;
  sew<3>(map, Dart{0}, map.template alpha<2, 0>(Dart{0}));
  const auto before = count_cells<1>(map);
  const TopologyChange change = dissociate_face(map, Dart{0});
  EXPECT_EQ(before + change.edges.size(), count_cells<1>(map));
}

TEST(DissociateEdge, FoldedOntoItselfSplitsNoEdge) {
  Map2 map;
  add_cell(map, CellKind::triangle);
  sew<2>(map, {0}, {1});
  const TopologyChange change = dissociate_edge(map, {0});
  EXPECT_TRUE(change.edges.empty());
  EXPECT_EQ(change.vertices.size(), 1u);
  EXPECT_EQ(count_cells<0>(map), 3u);
}

}  // namespace
}  // namespace dartboard::dissociate_face_test
