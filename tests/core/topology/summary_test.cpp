#include "core/topology/summary.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <vector>

#include "core/topology/build.h"
#include "core/topology/cells.h"
#include "core/topology/orientation.h"
#include "core/topology/sew.h"
#include "tests/support/meshes/random_cells.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::summary_test {
namespace {

using Counts = std::vector<std::size_t>;

template <class Map>
MapSummary summary_of(const Mesh& mesh) {
  return summarize(build_map<Map>(mesh).map);
}

TEST(Summary, OfAnEmptyMapIsAllZero) {
  const MapSummary s = summarize(Map3());
  EXPECT_EQ(s.dimension, 3);
  EXPECT_EQ(s.darts, 0u);
  EXPECT_EQ(s.cells, (Counts{0, 0, 0, 0}));
  EXPECT_EQ(s.components, 0u);
  EXPECT_EQ(s.boundary_facets, 0u);
  EXPECT_EQ(s.euler, 0);
  EXPECT_TRUE(s.orientable);
  EXPECT_EQ(s.violation, "");
}

TEST(Summary, OfABallOfTetrahedraIsTheSameOnBothStorages) {
  for (const MapSummary& s : {summary_of<Map3>(kuhn_grid(2, 2, 2, 1.0)), summary_of<TetMap>(kuhn_grid(2, 2, 2, 1.0))}) {
    EXPECT_EQ(s.darts, 48u * 24u);
    EXPECT_EQ(s.cells, (Counts{27, 98, 120, 48}));  // 120 = (4 * 48 + 48) / 2, 98 = 27 + 120 - 48 - 1
    EXPECT_EQ(s.components, 1u);
    EXPECT_EQ(s.boundary_facets, 48u);  // 2 * 4 on each of six sides
    EXPECT_EQ(s.euler, 1);
    EXPECT_TRUE(s.orientable);
  }
}

TEST(Summary, OfATorusSurface) {
  const MapSummary s = summary_of<Map2>(torus_lattice());
  EXPECT_EQ(s.dimension, 2);
  EXPECT_EQ(s.cells, (Counts{12, 24, 12}));
  EXPECT_EQ(s.euler, 0);
  EXPECT_EQ(s.boundary_facets, 0u);
  EXPECT_EQ(s.components, 1u);
  EXPECT_TRUE(s.orientable);
}

TEST(Summary, OfAKleinBottle) {
  const MapSummary s = summary_of<Map2>(klein_lattice());
  EXPECT_EQ(s.cells, (Counts{12, 24, 12}));
  EXPECT_EQ(s.euler, 0);
  EXPECT_EQ(s.boundary_facets, 0u);
  EXPECT_FALSE(s.orientable);
}

TEST(Summary, OfAMoebiusStrip) {
  const MapSummary s = summary_of<Map2>(moebius_lattice());
  EXPECT_EQ(s.cells, (Counts{10, 15, 5}));
  EXPECT_EQ(s.euler, 0);
  EXPECT_EQ(s.boundary_facets, 10u);
  EXPECT_EQ(s.components, 1u);
  EXPECT_FALSE(s.orientable);
  EXPECT_EQ(s.violation, "");
}

TEST(Summary, OfAnAnnulusDiffersFromTheMoebiusStripInOrientabilityOnly) {
  const MapSummary annulus = summary_of<Map2>(sheet(5, 1, true, false, false));
  const MapSummary strip = summary_of<Map2>(moebius_lattice());
  EXPECT_EQ(annulus.cells, strip.cells);
  EXPECT_EQ(annulus.boundary_facets, strip.boundary_facets);
  EXPECT_TRUE(annulus.orientable);
}

TEST(Summary, OfTwoComponents) {
  Mesh mesh = regular_tetrahedron();
  mesh.points.insert(mesh.points.end(), {{9, 0, 0}, {10, 0, 0}, {9, 1, 0}, {9, 0, 1}});
  mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{4, 5, 6, 7});
  const MapSummary s = summary_of<TetMap>(mesh);
  EXPECT_EQ(s.components, 2u);
  EXPECT_EQ(s.cells, (Counts{8, 12, 8, 2}));
  EXPECT_EQ(s.euler, 2);
  EXPECT_EQ(s.boundary_facets, 8u);
}

// Fig. 3b: one component, one central vertex, though that vertex has no neighbourhood like a ball. A cone over an
// annulus of 8 triangles: V = 1 + 8, E = 8 spokes + 16, F = 8 + 16 cones over the edges, T = 8.
TEST(Summary, OfThePinchedBodyOfFigure3b) {
  for (const MapSummary& s : {summary_of<Map3>(pinched_ring()), summary_of<TetMap>(pinched_ring())}) {
    EXPECT_EQ(s.cells, (Counts{9, 24, 24, 8}));
    EXPECT_EQ(s.components, 1u);
    EXPECT_EQ(s.euler, 1);
    EXPECT_EQ(s.boundary_facets, 16u);  // the annulus, and cones over its 8 boundary edges
    EXPECT_TRUE(s.orientable);
    EXPECT_EQ(s.violation, "");
  }
}

TEST(Summary, OfAClosedSolidHasNoBoundary) {
  Mesh mesh = regular_tetrahedron();  // twice the same tetrahedron: all faces are shared, a 3-sphere
  mesh.add_cell(CellKind::tetrahedron, mesh.cell(0));
  const MapSummary s = summary_of<TetMap>(mesh);
  EXPECT_EQ(s.cells, (Counts{4, 6, 4, 2}));
  EXPECT_EQ(s.boundary_facets, 0u);
  EXPECT_EQ(s.euler, 0);
}

TEST(Summary, OfABrokenMapSaysWhatIsViolatedAndCountsNoCells) {
  Map2 map;
  for (int k = 0; k < 3; ++k) map.add_dart();
  map.link<0>({0}, {1});
  map.link<2>({1}, {2});
  const MapSummary s = summarize(map);
  EXPECT_NE(s.violation, "");
  EXPECT_EQ(s.darts, 3u);
  EXPECT_TRUE(s.cells.empty());
}

/// The same by walks round every cell, as of a map of any cells.
void expect_counts_of_walks(const TetMap& map) {
  const MapSummary s = summarize(map);
  EXPECT_EQ(s.violation, "");
  EXPECT_EQ(s.darts, map.dart_count());
  EXPECT_EQ(s.cells, (Counts{count_cells<0>(map), count_cells<1>(map), count_cells<2>(map), count_cells<3>(map)}));
  EXPECT_EQ(s.components, components(map).count);
  EXPECT_EQ(s.orientable, orientation(map).has_value());
  std::size_t boundary = 0;
  for_each_cell<2>(map, [&](Face face) { boundary += map.is_free<3>(face.dart) ? 1u : 0u; });
  EXPECT_EQ(s.boundary_facets, boundary);
  EXPECT_EQ(s.euler, static_cast<long>(s.cells[0] + s.cells[2]) - static_cast<long>(s.cells[1] + s.cells[3]));
}

TEST(Summary, OfTetrahedraIsThatOfAnyCells) {
  for (unsigned seed = 0; seed < 12; ++seed) {
    SCOPED_TRACE(seed);
    const Mesh mesh = random_cells_of(kuhn_grid(3, 3, 2, 1.0), 0.1 + 0.07 * seed, seed);
    const MapSummary tetrahedra = summary_of<TetMap>(mesh), any = summary_of<Map3>(mesh);
    EXPECT_EQ(tetrahedra.darts, any.darts);
    EXPECT_EQ(tetrahedra.cells, any.cells);
    EXPECT_EQ(tetrahedra.components, any.components);
    EXPECT_EQ(tetrahedra.boundary_facets, any.boundary_facets);
    EXPECT_EQ(tetrahedra.euler, any.euler);
    EXPECT_EQ(tetrahedra.orientable, any.orientable);
    expect_counts_of_walks(build_map<TetMap>(mesh).map);
  }
}

TEST(Summary, OfFoldedUnsewnAndDeadTetrahedraIsThatOfWalks) {
  auto map = build_map<TetMap>(kuhn_grid(2, 1, 1, 1.0)).map;
  for (std::uint32_t p = 0; p < 24; p += 6) unsew<3>(map, {48 + p});
  remove_cell(map, Dart{48});
  expect_counts_of_walks(map);
  for (const std::uint32_t other : {6u, 7u, 8u, 9u, 1u, 3u, 5u}) {  // to another face, and onto itself
    TetMap one;
    one.add_tetrahedron();
    one.add_tetrahedron();
    one.link<3>({0}, {other});
    SCOPED_TRACE(other);
    expect_counts_of_walks(one);
  }
}

TEST(Orientation, IsLostByOneFaceFoldedTheWrongWay) {
  TetMap map;
  map.add_tetrahedron();
  map.link<3>({0}, {6});  // even to even: the two darts have the same colour
  EXPECT_FALSE(orientation(map).has_value());
  map.unlink<3>({0});
  map.link<3>({0}, {7});
  EXPECT_TRUE(orientation(map).has_value());
}

TEST(Orientation, GivesSignsThatEveryAlphaChanges) {
  const TetMap map = build_map<TetMap>(kuhn_grid(2, 1, 1, 1.0)).map;
  const auto sign = orientation(map);
  ASSERT_TRUE(sign.has_value());
  map.for_each_dart([&](Dart d) {
    EXPECT_EQ(std::abs((*sign)[d.index]), 1);
    for (int i = 0; i <= 3; ++i) EXPECT_TRUE(map.is_free(i, d) || (*sign)[map.alpha(i, d).index] == -(*sign)[d.index]);
  });
}

// Within a cell every alpha but the last changes the sign.
template <class Map>
void expect_orientations_by_signs(const Map& map) {
  const auto sign = orientation(map);
  ASSERT_TRUE(sign.has_value());
  for_each_cell<Map::dimension>(map, [&](auto cell) {
    for_each_dart_of(map, cell, [&](Dart d) {
      ASSERT_EQ(same_orientation(map, cell.dart, d), (*sign)[d.index] == (*sign)[cell.dart.index]) << to_string(d);
      ASSERT_EQ(same_orientation(map, d, cell.dart), (*sign)[d.index] == (*sign)[cell.dart.index]) << to_string(d);
    });
  });
}

TEST(Orientation, IsTheSameWithinACellWhereSignsAre) {
  expect_orientations_by_signs(build_map<TetMap>(kuhn_grid(1, 1, 1, 1.0)).map);
  expect_orientations_by_signs(build_map<Map3>(mixed_cells()).map);
  expect_orientations_by_signs(build_map<Map2>(quadrilateral_grid(2, 2)).map);
}

TEST(Components, AreNumberedByTheirLowestDart) {
  Map2 map;
  for (int k = 0; k < 3; ++k) add_cell(map, CellKind::triangle);
  sew<2>(map, {0}, {12});
  const Components found = components(map);
  EXPECT_EQ(found.count, 2u);
  EXPECT_EQ(found.of_dart[5], 0u);
  EXPECT_EQ(found.of_dart[6], 1u);
  EXPECT_EQ(found.of_dart[17], 0u);
}

TEST(Components, SkipDeadCells) {
  TetMap map;
  for (int k = 0; k < 3; ++k) map.add_tetrahedron();
  map.remove_tetrahedron({0});
  const Components found = components(map);
  EXPECT_EQ(found.count, 2u);
  EXPECT_EQ(found.of_dart[24], 0u);
  EXPECT_EQ(found.of_dart[71], 1u);
}

// The middle one of three cubes falls to pieces; the remaining darts are labelled in the same way.
TEST(Components, AreTheSameOnBothStorages) {
  const Mesh mesh = kuhn_grid(3, 1, 1, 1.0);
  auto general = build_map<Map3>(mesh);
  auto tetrahedral = build_map<TetMap>(mesh);
  for (std::size_t c = 6; c < 12; ++c)
    for (std::uint32_t p = 0; p < 24; ++p) {
      unsew<3>(general.map, {general.first_dart[c] + p});
      unsew<3>(tetrahedral.map, {tetrahedral.first_dart[c] + p});
    }
  EXPECT_EQ(components(general.map).count, 8u);  // two cubes and six tetrahedra
  EXPECT_EQ(components(general.map).of_dart, components(tetrahedral.map).of_dart);
}

}  // namespace
}  // namespace dartboard::summary_test
