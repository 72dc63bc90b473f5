#include "core/topology/storage/tet_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <functional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/plain/error.h"
#include "core/plain/mesh.h"
#include "core/topology/build.h"
#include "core/topology/check.h"
#include "core/topology/sew.h"
#include "tests/support/meshes_for_tests.h"
#include "tests/support/topology_message_for_tests.h"

namespace dartboard::tet_table_test {
namespace {

template <class A, class B>
void expect_equal_alphas(const A& a, const B& b) {
  ASSERT_EQ(a.capacity(), b.capacity());
  for (std::uint32_t d = 0; d < a.capacity(); ++d)
    for (int i = 0; i <= 3; ++i) ASSERT_EQ(a.alpha(i, {d}), b.alpha(i, {d})) << "alpha" << i << " of d" << d;
}

TEST(TetDarts, AreAClosedGeneralizedMapOfASurface) {
  for (std::size_t p = 0; p < 24; ++p)
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NE(tet_darts.alpha[i][p], p);
      EXPECT_EQ(tet_darts.alpha[i][tet_darts.alpha[i][p]], p);
    }
  for (std::size_t p = 0; p < 24; ++p)
    EXPECT_EQ(tet_darts.alpha[2][tet_darts.alpha[0][p]], tet_darts.alpha[0][tet_darts.alpha[2][p]]);
}

// A dart is a permutation: its vertex, the other end of its edge, the other node of its face, the node it leaves out.
TEST(TetDarts, AreTheTwentyFourPermutationsOfTheNodes) {
  std::vector<std::array<int, 4>> found;
  for (std::size_t p = 0; p < 24; ++p)
    found.push_back({tet_darts.node[p], tet_darts.node[tet_darts.alpha[0][p]],
                     tet_darts.node[tet_darts.alpha[0][tet_darts.alpha[1][p]]], static_cast<int>(p / 6)});
  std::sort(found.begin(), found.end());
  std::array<int, 4> permutation{0, 1, 2, 3};
  std::size_t k = 0;
  do EXPECT_EQ(found[k++], permutation);
  while (std::next_permutation(permutation.begin(), permutation.end()));
}

TEST(TetDarts, HaveTheNodesThatFacesOfNames) {
  const auto faces = faces_of(CellKind::tetrahedron);
  for (std::size_t f = 0; f < 4; ++f)
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_EQ(tet_darts.node[6 * f + 2 * k], faces[f][k]);
      EXPECT_EQ(tet_darts.node[6 * f + 2 * k + 1], faces[f][(k + 1) % 3]);
    }
}

TEST(TetDarts, ShareTheNumberOfAnEdgeWhenTheyShareItsNodes) {
  for (std::size_t p = 0; p < 24; ++p)
    for (std::size_t q = 0; q < 24; ++q) {
      const auto ends = [](std::size_t d) {
        const int a = tet_darts.node[d], b = tet_darts.node[tet_darts.alpha[0][d]];
        return std::pair(std::min(a, b), std::max(a, b));
      };
      EXPECT_EQ(tet_darts.edge[p] == tet_darts.edge[q], ends(p) == ends(q));
    }
}

TEST(TetTable, AnswersForOneTetrahedronAsAddCellBuildsIt) {
  TetMap tetrahedral;
  Map3 general;
  add_cell(tetrahedral, CellKind::tetrahedron);
  add_cell(general, CellKind::tetrahedron);
  expect_equal_alphas(tetrahedral, general);
}

TEST(TetTable, AnswersForAMeshAsTheGeneralStorage) {
  const Mesh mesh = kuhn_grid(3, 2, 2, 1.0);
  const auto tetrahedral = build_map<TetMap>(mesh);
  const auto general = build_map<Map3>(mesh);
  expect_equal_alphas(tetrahedral.map, general.map);
  EXPECT_EQ(tetrahedral.first_dart, general.first_dart);
  for (std::uint32_t d = 0; d < general.map.capacity(); ++d)
    ASSERT_EQ(tetrahedral.point[TetMap::slot<0>({d})], general.point[Map3::slot<0>({d})]);
}

// Nodes of the cells shuffled: every turn of a face against another occurs, mirrored ones too.
TEST(TetTable, AnswersAsTheGeneralStorageForEveryTurnOfAFace) {
  std::mt19937 bits(3);
  std::array<int, 6> met{};
  const Mesh sorted = kuhn_grid(2, 2, 2, 1.0);
  Mesh mesh;
  mesh.points = sorted.points;
  for (std::size_t c = 0; c < sorted.cell_count(); ++c) {
    std::vector<std::uint32_t> nodes(sorted.cell(c).begin(), sorted.cell(c).end());
    for (std::size_t k = 3; k > 0; --k) std::swap(nodes[k], nodes[bits() % (k + 1)]);
    mesh.add_cell(CellKind::tetrahedron, nodes);
  }
  const TetMap map = build_map<TetMap>(mesh).map;
  expect_equal_alphas(map, build_map<Map3>(mesh).map);
  EXPECT_EQ(check(map), "");
  for (std::uint32_t d = 0; d < map.capacity(); d += 6)
    if (!map.is_free<3>({d})) ++met[map.alpha<3>({d}).index % 6];
  for (const int times : met) EXPECT_GT(times, 0);
}

TEST(TetTable, LinksAllPairsOfDartsOfTwoFaces) {
  for (std::uint32_t a = 0; a < 24; ++a)
    for (std::uint32_t b = 24; b < 48; ++b) {
      TetMap map;
      map.add_tetrahedron();
      map.add_tetrahedron();
      map.link<3>({a}, {b});
      ASSERT_EQ(map.alpha<3>({a}), Dart{b});
      ASSERT_EQ(map.alpha<3>({b}), Dart{a});
      ASSERT_EQ(check(map), "");
      map.unlink<3>({b});
      ASSERT_TRUE(map.is_free<3>({a}));
      ASSERT_TRUE(map.is_free<3>({b}));
    }
}

TEST(TetTable, TakesTwentyBytesForATetrahedron) {
  TetMap map;
  const std::size_t n = 1 << 10;  // a power of two, the capacity a vector has when it doubles
  for (std::size_t t = 0; t < n; ++t) map.add_tetrahedron();
  EXPECT_EQ(map.bytes(), 20 * n);
}

TEST(TetTable, SlotsOfADeadTetrahedronAreUsedAgain) {
  TetMap map;
  for (int t = 0; t < 3; ++t) map.add_tetrahedron();
  map.remove_tetrahedron({24});
  EXPECT_FALSE(map.is_live({30}));
  EXPECT_TRUE(map.is_live({48}));
  EXPECT_EQ(map.dart_count(), 48u);
  EXPECT_EQ(map.add_tetrahedron(), Dart{24});
  EXPECT_TRUE(map.is_free<3>({30}));
  EXPECT_EQ(map.capacity(), 72u);
}

// Label places: one per corner, edge, face side of each tetrahedron.
TEST(TetTable, GivesOnePlaceToTheDartsOfACellWithinATetrahedron) {
  for (std::uint32_t d = 0; d < 48; ++d)
    for (std::uint32_t e = 0; e < 48; ++e) {
      const bool together = d / 24 == e / 24;
      const auto p = d % 24, q = e % 24;
      EXPECT_EQ(TetMap::slot<0>({d}) == TetMap::slot<0>({e}), together && tet_darts.node[p] == tet_darts.node[q]);
      EXPECT_EQ(TetMap::slot<1>({d}) == TetMap::slot<1>({e}), together && tet_darts.edge[p] == tet_darts.edge[q]);
      EXPECT_EQ(TetMap::slot<2>({d}) == TetMap::slot<2>({e}), together && p / 6 == q / 6);
      EXPECT_EQ(TetMap::slot<3>({d}) == TetMap::slot<3>({e}), together);
    }
}

TEST(TetMapDarts, ComeTwentyFourAtATime) {
  TetMap map;
  EXPECT_EQ(map.add_tetrahedron(), Dart{0});
  EXPECT_EQ(map.add_tetrahedron(), Dart{24});
  EXPECT_EQ(map.dart_count(), 48u);
  const DartId id = map.id({7});
  map.remove_tetrahedron({20});  // any of its darts names it
  EXPECT_EQ(map.dart_count(), 24u);
  EXPECT_EQ(message_of([&] { map.resolve(id); }), "d7 is dead, expected a live dart");
  EXPECT_EQ(map.add_tetrahedron(), Dart{0});
  EXPECT_EQ(message_of([&] { map.resolve(id); }),
            "d7 has died and its slot holds another dart (generation 3, expected 1)");
}

TEST(TetMapDarts, ATetrahedronWithASewnFaceCannotBeRemoved) {
  TetMap map;
  map.add_tetrahedron();
  map.add_tetrahedron();
  map.link<3>({13}, {40});
  const auto before = map.hash();
  EXPECT_EQ(message_of([&] { map.remove_tetrahedron({0}); }).substr(0, 28), "cannot remove d12: alpha3(d1");
  EXPECT_EQ(message_of([&] { map.remove_tetrahedron({25}); }).substr(0, 28), "cannot remove d36: alpha3(d3");
  EXPECT_EQ(map.hash(), before);
}

// alpha3 must stay an involution, and the whole face follows one pair: a third of a turn is not an involution.
TEST(TetMapDarts, AFaceIsNotLinkedToItselfByATurn) {
  TetMap map;
  map.add_tetrahedron();
  for (const std::uint32_t there : {2u, 4u})
    EXPECT_NE(message_of([&] { map.link<3>({0}, {there}); }), "no throw") << check(map);
  EXPECT_EQ(check(map), "");
}

}  // namespace
}  // namespace dartboard::tet_table_test
