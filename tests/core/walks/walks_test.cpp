// The three walks of the paper over one body: dart coverage, lists of embeddings, cell arrays.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "core/mechanics/mass_spring_body.h"
#include "core/walks/cell_arrays.h"
#include "core/walks/dart_coverage.h"
#include "core/walks/embedding_lists.h"
#include "core/walks/runge_kutta_4.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::walks_test {
namespace {

constexpr auto one = Held::by_one_dart;
constexpr auto every = Held::by_every_dart;

Problem problem_of(Mesh mesh) {
  Problem problem;
  problem.mesh = std::move(mesh);
  problem.fixed = {0, 1, 2};
  return problem;
}

template <class Map, Held held, class Walk>
std::uint64_t hash_after_20_steps(const Problem& problem) {
  auto body = build_body<Map, held>(problem);
  Walk walk;
  if constexpr (requires { walk.rebuild(body); }) walk.rebuild(body);
  RungeKutta4 integrator;
  for (int k = 0; k < 20; ++k) integrator.step(walk, body, problem.h);
  return body.state_hash();
}

template <class Map, Held held>
void expect_hash_on_all_walks(const Problem& problem, std::uint64_t expected) {
  EXPECT_EQ((hash_after_20_steps<Map, held, DartCoverage>(problem)), expected);
  EXPECT_EQ((hash_after_20_steps<Map, held, EmbeddingLists>(problem)), expected);
  EXPECT_EQ((hash_after_20_steps<Map, held, CellArrays>(problem)), expected);
}

TEST(Walks, LeadASolidToTheSameBitsOnBothStoragesAndHoldings) {
  const Problem problem = problem_of(kuhn_grid(3, 2, 2, 0.1, 0.1, 9));
  const auto expected = hash_after_20_steps<Map3, one, DartCoverage>(problem);
  expect_hash_on_all_walks<Map3, one>(problem, expected);
  expect_hash_on_all_walks<Map3, every>(problem, expected);
  expect_hash_on_all_walks<TetMap, one>(problem, expected);
  expect_hash_on_all_walks<TetMap, every>(problem, expected);
}

TEST(Walks, LeadASurfaceToTheSameBits) {
  const Problem problem = problem_of(torus_lattice());
  const auto expected = hash_after_20_steps<Map2, one, DartCoverage>(problem);
  expect_hash_on_all_walks<Map2, one>(problem, expected);
  expect_hash_on_all_walks<Map2, every>(problem, expected);
}

TEST(Walks, LeadABodyOfMixedCellsToTheSameBits) {
  const Problem problem = problem_of(mixed_cells());
  const auto expected = hash_after_20_steps<Map3, one, DartCoverage>(problem);
  expect_hash_on_all_walks<Map3, one>(problem, expected);
  expect_hash_on_all_walks<Map3, every>(problem, expected);
}

TEST(Walks, MoveTheBodyAtAll) {
  const Problem problem = problem_of(kuhn_grid(1, 1, 1, 0.1));
  EXPECT_NE((hash_after_20_steps<TetMap, one, CellArrays>(problem)), (build_body<TetMap, one>(problem).state_hash()));
}

template <class Walk>
class EachWalk : public testing::Test {};
using Kinds = testing::Types<DartCoverage, EmbeddingLists, CellArrays>;
TYPED_TEST_SUITE(EachWalk, Kinds);

TYPED_TEST(EachWalk, MeetsEveryVertexAndEveryEdgeOnceInTheirOrder) {
  const auto body = build_body<TetMap, one>(problem_of(kuhn_grid(2, 1, 1, 1.0)));
  TypeParam walk;
  if constexpr (requires { walk.rebuild(body); }) walk.rebuild(body);
  std::uint32_t vertices = 0, edges = 0;
  walk.for_each_vertex(body, [&](std::uint32_t v) { EXPECT_EQ(v, vertices++); });
  walk.for_each_edge(body, [&](std::uint32_t e, std::uint32_t a, std::uint32_t b) {
    EXPECT_EQ(e, edges++);
    EXPECT_NE(a, b);
    EXPECT_EQ((body.vertices.position[a] - body.vertices.position[b]).norm(), body.springs[e].rest_length);
  });
  EXPECT_EQ(vertices, body.vertices.size());
  EXPECT_EQ(edges, body.springs.size());
}

// After dissociations the numbers of embeddings are no longer those of the order of the cells. Coverages and lists go
// by cells then, arrays by numbers; all must visit the same.
TYPED_TEST(EachWalk, TellsTheNumbersOfEmbeddingsAndNotOfPlaces) {
  auto body = build_body<TetMap, one>(problem_of(kuhn_grid(2, 1, 1, 1.0)));
  const auto edges = static_cast<std::uint32_t>(body.springs.size());
  const auto vertices = static_cast<std::uint32_t>(body.vertices.size());
  std::uint32_t k = 0;
  for_each_cell<1>(body.map, [&](Edge e) { body.edge.attach(body.map, e, edges - ++k); });
  k = 0;
  for_each_cell<0>(body.map, [&](Vertex v) { body.vertex.attach(body.map, v, vertices - ++k); });
  TypeParam walk;
  if constexpr (requires { walk.rebuild(body); }) walk.rebuild(body);
  std::vector<std::array<std::uint32_t, 3>> expected, found;
  for_each_cell<1>(body.map, [&](Edge e) {
    expected.push_back({body.edge(body.map, e.dart), body.vertex(body.map, e.dart),
                        body.vertex(body.map, body.map.template alpha<0>(e.dart))});
  });
  walk.for_each_edge(body, [&](auto e, auto a, auto b) { found.push_back({e, a, b}); });
  std::sort(found.begin(), found.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_EQ(found, expected);
  std::vector<std::uint32_t> met;
  walk.for_each_vertex(body, [&](std::uint32_t v) { met.push_back(v); });
  std::sort(met.begin(), met.end());
  for (std::uint32_t v = 0; v < vertices; ++v) EXPECT_EQ(met.at(v), v);
}

TYPED_TEST(EachWalk, CanBeRebuiltForAnotherBody) {
  const auto large = build_body<TetMap, one>(problem_of(kuhn_grid(2, 2, 1, 1.0)));
  const auto small = build_body<TetMap, one>(problem_of(regular_tetrahedron()));
  TypeParam walk;
  if constexpr (requires { walk.rebuild(large); }) {
    walk.rebuild(large);
    walk.rebuild(small);
  }
  std::size_t edges = 0;
  walk.for_each_edge(small, [&](auto...) { ++edges; });
  EXPECT_EQ(edges, 6u);
}

TYPED_TEST(EachWalk, CanBeRebuiltAfterTheNumbersHaveChanged) {
  auto body = build_body<TetMap, one>(problem_of(kuhn_grid(2, 1, 1, 1.0)));
  TypeParam walk;
  if constexpr (requires { walk.rebuild(body); }) walk.rebuild(body);
  auto left = static_cast<std::uint32_t>(body.springs.size());
  for_each_cell<1>(body.map, [&](Edge e) { body.edge.attach(body.map, e, --left); });
  if constexpr (requires { walk.rebuild(body); }) walk.rebuild(body);
  std::vector<int> met(body.springs.size(), 0);
  walk.for_each_edge(body, [&](std::uint32_t e, auto, auto) { ++met[e]; });
  EXPECT_EQ(met, std::vector<int>(body.springs.size(), 1));
}

TYPED_TEST(EachWalk, HasNothingToVisitInAnEmptyBody) {
  const auto body = build_body<TetMap, one>(Problem{});
  TypeParam walk;
  if constexpr (requires { walk.rebuild(body); }) walk.rebuild(body);
  walk.for_each_vertex(body, [](auto) { FAIL(); });
  walk.for_each_edge(body, [](auto...) { FAIL(); });
}

TEST(CellArraysOf, ASolidHoldItsFacesAndVolumes) {
  const auto body = build_body<TetMap, every>(problem_of(unequal_tetrahedra()));
  CellArrays arrays;
  arrays.rebuild(body);
  EXPECT_EQ(arrays.vertices.size(), 5u);
  EXPECT_EQ(arrays.edges.size(), 9u);
  EXPECT_EQ(arrays.faces.size(), 7u);
  ASSERT_EQ(arrays.volumes.size(), 2u);
  EXPECT_EQ(arrays.volumes[1].embedding, 1u);
}

TEST(CellArraysOf, ASurfaceHoldItsFacesAndNoVolume) {
  const auto body = build_body<Map2, every>(problem_of(torus_lattice()));
  CellArrays arrays;
  arrays.rebuild(body);
  ASSERT_EQ(arrays.faces.size(), 12u);
  EXPECT_EQ(arrays.faces[11].embedding, 11u);
  EXPECT_TRUE(arrays.volumes.empty());
}

std::vector<std::uint32_t> contents(const EmbeddingList& list) {
  std::vector<std::uint32_t> found;
  list.for_each([&](std::uint32_t k, Dart d) {
    EXPECT_EQ(d, Dart{10 * k});
    found.push_back(k);
  });
  return found;
}
using Numbers = std::vector<std::uint32_t>;

EmbeddingList list_of(const Numbers& numbers) {
  EmbeddingList list;
  for (const auto k : numbers) list.push_back(k, {10 * k});
  return list;
}

TEST(EmbeddingList, KeepsTheOrderOfItsPushes) { EXPECT_EQ(contents(list_of({3, 0, 7, 1})), (Numbers{3, 0, 7, 1})); }

TEST(EmbeddingList, KeepsTheOrderWhenOneInTheMiddleIsErased) {
  EmbeddingList list = list_of({0, 1, 2, 3});
  list.erase(2);
  EXPECT_EQ(contents(list), (Numbers{0, 1, 3}));
  list.push_back(2, {20});
  EXPECT_EQ(contents(list), (Numbers{0, 1, 3, 2}));
}

TEST(EmbeddingList, KeepsTheOrderWhenItsEndsAreErased) {
  EmbeddingList list = list_of({0, 1, 2, 3});
  list.erase(0);
  list.erase(3);
  EXPECT_EQ(contents(list), (Numbers{1, 2}));
  list.push_back(9, {90});
  EXPECT_EQ(contents(list), (Numbers{1, 2, 9}));
}

TEST(EmbeddingList, CanBeEmptiedAndFilledAgain) {
  EmbeddingList list = list_of({0, 1});
  list.erase(1);
  list.erase(0);
  EXPECT_EQ(contents(list), Numbers{});
  list.push_back(1, {10});
  EXPECT_EQ(contents(list), Numbers{1});
  list.clear();
  EXPECT_EQ(contents(list), Numbers{});
}

}  // namespace
}  // namespace dartboard::walks_test
