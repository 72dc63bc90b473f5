#include "core/topology/build.h"

#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <ostream>
#include <string>
#include <vector>

#include "core/plain/error.h"
#include "core/topology/cells.h"
#include "core/topology/check.h"
#include "tests/support/meshes/random_cells.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::build_test {
namespace {

using Counts = std::array<std::size_t, 4>;
using Nodes = std::vector<std::uint32_t>;

template <class Map>
Counts counts(const Map& map) {
  Counts n{count_cells<0>(map), count_cells<1>(map), count_cells<2>(map), 0};
  if constexpr (Map::dimension == 3) n[3] = count_cells<3>(map);
  return n;
}

Mesh mesh_of(std::size_t points, CellKind kind, const std::vector<Nodes>& cells) {
  Mesh mesh;
  for (std::size_t p = 0; p < points; ++p) mesh.points.emplace_back(static_cast<double>(p), 0, 0);  // never looked at
  for (const Nodes& cell : cells) mesh.add_cell(kind, cell);
  return mesh;
}

template <class Error>
std::string message_of(const std::function<void()>& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return "no throw";
}

struct OneCell {
  CellKind kind;
  std::size_t darts;
  Counts cells;
};
void PrintTo(const OneCell& cell, std::ostream* os) { *os << name(cell.kind); }

class AddCell : public testing::TestWithParam<OneCell> {};
TEST_P(AddCell, MakesOneValidCellOfItsKind) {
  Map3 map;
  EXPECT_EQ(add_cell(map, GetParam().kind), Dart{0});
  EXPECT_EQ(map.dart_count(), GetParam().darts);
  EXPECT_EQ(counts(map), GetParam().cells);
  EXPECT_EQ(check(map), "");
  map.for_each_dart([&](Dart d) {
    EXPECT_TRUE(map.is_free<3>(d));
    for (const int i : {0, 1, 2}) EXPECT_FALSE(map.is_free(i, d));
  });
}
TEST_P(AddCell, NumbersDartsFaceByFaceAsFacesOfListsThem) {
  Mesh mesh = mesh_of(8, GetParam().kind, {});
  Nodes nodes;
  for (int k = 0; k < node_count(GetParam().kind); ++k) nodes.push_back(static_cast<std::uint32_t>(k));
  mesh.add_cell(GetParam().kind, nodes);
  const auto built = build_map<Map3>(mesh);
  std::uint32_t d = 0;
  for (const auto& face : faces_of(GetParam().kind))
    for (std::size_t k = 0; k < face.size(); ++k, d += 2) {
      EXPECT_EQ(built.point[d], static_cast<std::uint32_t>(face[k]));
      EXPECT_EQ(built.point[d + 1], static_cast<std::uint32_t>(face[(k + 1) % face.size()]));
      EXPECT_EQ(built.map.alpha<0>({d}), Dart{d + 1});
    }
}
INSTANTIATE_TEST_SUITE_P(EveryKind, AddCell,
                         testing::Values(OneCell{CellKind::tetrahedron, 24, {4, 6, 4, 1}},
                                         OneCell{CellKind::pyramid, 32, {5, 8, 5, 1}},
                                         OneCell{CellKind::prism, 36, {6, 9, 5, 1}},
                                         OneCell{CellKind::hexahedron, 48, {8, 12, 6, 1}}),
                         [](const auto& cell) { return std::string(name(cell.param.kind)); });

TEST(AddCellTo, AMapThatCannotHoldItIsRefused) {
  Map2 surface;
  Map3 solid;
  TetMap tetrahedra;
  EXPECT_EQ(message_of<TopologyError>([&] { add_cell(surface, CellKind::tetrahedron); }),
            "a 2-g-map cannot hold a tetrahedron");
  EXPECT_EQ(message_of<TopologyError>([&] { add_cell(solid, CellKind::triangle); }),
            "a 3-g-map cannot hold a triangle");
  EXPECT_EQ(message_of<TopologyError>([&] { add_cell(tetrahedra, CellKind::prism); }),
            "a tetrahedral map cannot hold a prism");
  EXPECT_EQ(surface.dart_count() + solid.dart_count() + tetrahedra.dart_count(), 0u);
}

TEST(RemoveCell, TakesAllDartsOfAnIsolatedCellAndNoOther) {
  Map3 map;
  add_cell(map, CellKind::pyramid);
  const Dart prism = add_cell(map, CellKind::prism);
  remove_cell(map, {5});
  EXPECT_EQ(map.dart_count(), 36u);
  EXPECT_TRUE(map.is_live(prism));
  EXPECT_EQ(check(map), "");
}

TEST(RemoveCell, RefusesACellThatIsSewnAnywhereAndChangesNothing) {
  auto map = build_map<Map3>(mixed_cells()).map;
  const auto before = map.hash();
  EXPECT_NE(message_of<TopologyError>([&] { remove_cell(map, Dart{0}); }).find("cannot remove d"), std::string::npos);
  EXPECT_EQ(map.hash(), before);
}

TEST(BuildMap, OfNoCellsIsEmpty) {
  EXPECT_EQ(build_map<Map3>(Mesh{}).map.dart_count(), 0u);
  EXPECT_EQ(build_map<TetMap>(Mesh{}).map.dart_count(), 0u);
}

TEST(BuildMap, SewsHexahedra) {
  const auto map = build_map<Map3>(hexahedron_box(2, 2, 2, 1.0)).map;
  EXPECT_EQ(counts(map), (Counts{27, 54, 36, 8}));
  EXPECT_EQ(check(map), "");
}

// 12 points; 12 + 4 + 5 + 3 edges; 6 + 5 + 5 + 4 faces, three of them shared; 48 + 32 + 36 + 24 darts
TEST(BuildMap, SewsEveryKindToAnother) {
  const auto map = build_map<Map3>(mixed_cells()).map;
  EXPECT_EQ(map.dart_count(), 140u);
  EXPECT_EQ(counts(map), (Counts{12, 24, 17, 4}));
  EXPECT_EQ(check(map), "");
}

TEST(BuildMap, KnowsThePointOfEveryDart) {
  const Mesh mesh = mixed_cells();
  const auto built = build_map<Map3>(mesh);
  const auto& map = built.map;
  map.for_each_dart([&](Dart d) {  // the same vertex, the same point; the two ends of an edge, two points
    EXPECT_EQ(built.point[d.index], built.point[map.alpha<1>(d).index]);
    EXPECT_EQ(built.point[d.index], built.point[map.alpha<2>(d).index]);
    EXPECT_EQ(built.point[d.index], built.point[map.alpha<3>(d).index]);
    EXPECT_NE(built.point[d.index], built.point[map.alpha<0>(d).index]);
  });
  EXPECT_EQ(built.first_dart, (Nodes{0, 48, 80, 116}));
}

TEST(BuildMap, KeepsCellsApartThatMeetAlongAnEdgeOnly) {
  const auto mesh = mesh_of(6, CellKind::tetrahedron, {{0, 1, 2, 3}, {0, 1, 4, 5}});
  EXPECT_EQ(counts(build_map<TetMap>(mesh).map), (Counts{8, 12, 8, 2}));
  EXPECT_EQ(counts(build_map<Map3>(mesh).map), (Counts{8, 12, 8, 2}));
}

TEST(BuildMap, KeepsCellsApartThatMeetAtAVertexOnly) {
  const auto mesh = mesh_of(7, CellKind::tetrahedron, {{0, 1, 2, 3}, {0, 4, 5, 6}});
  EXPECT_EQ(counts(build_map<TetMap>(mesh).map), (Counts{8, 12, 8, 2}));
}

// Same four points, another cycle: not one face.
TEST(BuildMap, KeepsQuadrilateralsApartThatShareTheirPointsInAnotherOrder) {
  const auto mesh = mesh_of(6, CellKind::pyramid, {{0, 1, 2, 3, 4}, {0, 2, 1, 3, 5}});
  EXPECT_EQ(counts(build_map<Map3>(mesh).map)[2], 10u);
}

TEST(BuildMap, KeepsQuadrilateralsApartThatShareThreeOfTheirPoints) {
  const auto mesh = mesh_of(7, CellKind::pyramid, {{0, 1, 2, 3, 4}, {0, 1, 5, 3, 6}});
  EXPECT_EQ(counts(build_map<Map3>(mesh).map)[2], 10u);
}

TEST(BuildMap, SewsAQuadrilateralFaceWhereverItsCycleStartsAndRuns) {
  const std::vector<Nodes> cycles{{0, 1, 2, 3}, {1, 2, 3, 0}, {2, 3, 0, 1}, {3, 0, 1, 2},
                                  {3, 2, 1, 0}, {2, 1, 0, 3}, {1, 0, 3, 2}, {0, 3, 2, 1}};
  for (const Nodes& base : cycles) {
    auto mesh = mesh_of(6, CellKind::pyramid, {{0, 1, 2, 3, 4}});
    mesh.add_cell(CellKind::pyramid, Nodes{base[0], base[1], base[2], base[3], 5});
    const auto map = build_map<Map3>(mesh).map;
    EXPECT_EQ(counts(map), (Counts{6, 12, 9, 2}));
    EXPECT_EQ(check(map), "");
  }
}

TEST(BuildMap, RefusesAFaceOfThreeCellsNamingThem) {
  const auto mesh = mesh_of(8, CellKind::tetrahedron, {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 2, 4}, {0, 2, 1, 5}});
  for (const auto& said : {message_of<InputError>([&] { build_map<TetMap>(mesh); }),
                           message_of<InputError>([&] { build_map<Map3>(mesh); })}) {
    EXPECT_NE(said.find("cells 0, 2 and 3 share the face of points"), std::string::npos) << said;
  }
}

TEST(BuildMap, RefusesAnEdgeOfThreePolygonsNamingThem) {
  const auto mesh = mesh_of(5, CellKind::triangle, {{0, 1, 2}, {0, 1, 3}, {1, 0, 4}});
  EXPECT_EQ(message_of<InputError>([&] { build_map<Map2>(mesh); }),
            "cells 0, 1 and 2 share the edge of points 1, 0: at most two may");
}

TEST(BuildMap, RefusesARepeatedNode) {
  const auto mesh = mesh_of(8, CellKind::tetrahedron, {{0, 1, 2, 3}, {4, 5, 4, 6}});
  EXPECT_EQ(message_of<InputError>([&] { build_map<TetMap>(mesh); }), "cell 1 names point 4 twice");
}

TEST(BuildMap, RefusesAPointThatDoesNotExist) {
  const auto mesh = mesh_of(3, CellKind::triangle, {{0, 1, 3}});
  EXPECT_EQ(message_of<InputError>([&] { build_map<Map2>(mesh); }), "cell 0 names point 3, expected less than 3");
}

TEST(BuildMap, RefusesCellsThatTheMapDoesNotHold) {
  EXPECT_EQ(message_of<InputError>([] { build_map<TetMap>(mixed_cells()); }),
            "cell 0 is a hexahedron: this map holds tetrahedra only");
  EXPECT_EQ(message_of<InputError>([] { build_map<Map2>(regular_tetrahedron()); }),
            "cell 0 is a tetrahedron: this map holds polygons only");
  EXPECT_EQ(message_of<InputError>([] { build_map<Map3>(torus_lattice()); }),
            "cell 0 is a quadrilateral: this map holds volumes only");
}

TEST(BuildMap, SewsSurfacesOfTrianglesAndQuadrilaterals) {
  Mesh mesh = quadrilateral_grid(2, 1);  // points 0 1 | 2 3 | 4 5
  mesh.points.emplace_back(3, 0, 0);
  mesh.add_cell(CellKind::triangle, Nodes{5, 4, 6});
  const auto map = build_map<Map2>(mesh).map;
  EXPECT_EQ(map.dart_count(), 22u);
  EXPECT_EQ(counts(map), (Counts{7, 9, 3, 0}));
  EXPECT_EQ(check(map), "");
}

TEST(BuildMap, SewsAMoebiusStrip) {
  const auto map = build_map<Map2>(moebius_lattice()).map;
  EXPECT_EQ(counts(map), (Counts{10, 15, 5, 0}));
  EXPECT_EQ(check(map), "");
}

TEST(BuildMap, SewsTetrahedraAsCellsOfAnyKind) {
  for (unsigned seed = 0; seed < 8; ++seed) {
    const Mesh mesh = random_cells_of(kuhn_grid(2, 3, 2, 1.0), 0.3 + 0.1 * seed, seed);
    const auto tetrahedra = build_map<TetMap>(mesh);
    const auto any = build_map<Map3>(mesh);
    EXPECT_EQ(tetrahedra.first_dart, any.first_dart);
    ASSERT_EQ(tetrahedra.map.capacity(), any.map.capacity());
    any.map.for_each_dart([&](Dart d) {
      EXPECT_EQ(tetrahedra.point[TetMap::slot<0>(d)], any.point[d.index]);
      for (int i = 0; i <= 3; ++i) ASSERT_EQ(tetrahedra.map.alpha(i, d), any.map.alpha(i, d)) << to_string(d);
    });
  }
}

TEST(BuildMap, NamesTheSameThreeCellsOnBothStorages) {
  const Mesh mesh =
      mesh_of(7, CellKind::tetrahedron, {{0, 1, 2, 6}, {0, 1, 2, 3}, {4, 5, 6, 3}, {2, 4, 1, 0}, {2, 1, 0, 5}});
  const std::string expected = "cells 0, 1 and 3 share the face of points";
  const std::string of_tetrahedra = message_of<InputError>([&] { build_map<TetMap>(mesh); });
  EXPECT_EQ(of_tetrahedra.substr(0, expected.size()), expected);
  EXPECT_EQ(of_tetrahedra, message_of<InputError>([&] { build_map<Map3>(mesh); }));
}

}  // namespace
}  // namespace dartboard::build_test
