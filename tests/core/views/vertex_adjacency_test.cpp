#include "core/views/vertex_adjacency.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "tests/support/meshes_for_tests.h"
#include "tests/support/random_operations.h"

namespace dartboard {
namespace {

using List = std::vector<Neighbour>;

List around(const VertexAdjacency& view, std::uint32_t vertex) {
  const auto list = view.around(vertex);
  return {list.begin(), list.end()};
}

// From the map: every dart of a vertex lies on an edge to a neighbour; the darts of one edge end are one entry.
template <class Body>
List walked(const Body& body, std::uint32_t vertex) {
  List list;
  for_each_dart_of(body.map, Vertex{body.vertices.dart[vertex]}, [&](Dart d) {
    list.push_back({body.vertex(body.map, body.map.template alpha<0>(d)), body.edge(body.map, d)});
  });
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  return list;
}

const auto expect_rebuilt = [](const VertexAdjacency& view, const auto& body) {
  VertexAdjacency rebuilt;
  rebuilt.rebuild(body);
  ASSERT_EQ(view, rebuilt);
  for (std::uint32_t v = 0; v < body.vertices.size(); ++v) ASSERT_EQ(around(view, v), walked(body, v));
};

template <class Map>
struct VertexAdjacencyOf : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(VertexAdjacencyOf, Solids);

TYPED_TEST(VertexAdjacencyOf, OneBodyIsForgottenForAnother) {
  VertexAdjacency view;
  for (const Mesh& mesh : {kuhn_grid(2, 2, 1, 1.0), regular_tetrahedron(), unequal_tetrahedra()}) {
    const auto body = body_of<TypeParam>(mesh);
    view.rebuild(body);
    expect_rebuilt(view, body);
    EXPECT_EQ(view.vertex_count(), body.vertices.size());
  }
}

TYPED_TEST(VertexAdjacencyOf, TwoTetrahedraHasThreeEdgesAtTheTipsAndFourElsewhere) {
  const auto body = body_of<TypeParam>(unequal_tetrahedra());
  VertexAdjacency view;
  view.rebuild(body);
  ASSERT_EQ(view.vertex_count(), 5u);
  for (std::uint32_t v = 0; v < 5; ++v) {
    EXPECT_EQ(view.around(v).size(), body.vertices.point[v] < 3 ? 4u : 3u);
    for (const Neighbour& n : view.around(v)) {
      const auto& ends = around(view, n.vertex);
      EXPECT_NE(std::find(ends.begin(), ends.end(), Neighbour{v, n.edge}), ends.end());
    }
  }
}

// An edge comes apart before its ends do.
TYPED_TEST(VertexAdjacencyOf, ABodyMayHaveParallelEdges) {
  auto body = body_of<TypeParam>(kuhn_grid(2, 2, 2, 1.0));
  VertexAdjacency view;
  view.rebuild(body);
  std::size_t parallel = 0;
  SplitMix64 random(4);
  for (int k = 0; k < 60; ++k) {
    view.apply(body, adapt(body, dissociate_face(body.map, some_live_dart(body.map, random))));
    expect_rebuilt(view, body);
    for (std::uint32_t v = 0; v < view.vertex_count(); ++v) {
      const auto list = view.around(v);
      parallel += list.end() != std::adjacent_find(list.begin(), list.end(),
                                                   [](const auto& a, const auto& b) { return a.vertex == b.vertex; });
    }
  }
  EXPECT_GT(parallel, 0u);
}

TYPED_TEST(VertexAdjacencyOf, FollowsEveryOperationUntilNothingIsLeft) {
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const auto view = followed_until_nothing_is_left<VertexAdjacency>(body_of<TypeParam>(kuhn_grid(3, 2, 2, 0.125)),
                                                                      seed, seed == 1 ? 150 : 20, expect_rebuilt);
    EXPECT_EQ(view.vertex_count(), 0u);
  }
}

TEST(VertexAdjacencyOfHexahedra, FollowsEveryOperationUntilNothingIsLeft) {
  const auto view = followed_until_nothing_is_left<VertexAdjacency>(body_of<Map3>(hexahedron_box(3, 2, 2, 1.0)), 1, 30,
                                                                    expect_rebuilt);
  EXPECT_EQ(view.vertex_count(), 0u);
}

TEST(VertexAdjacencyOfASurface, FollowsEveryOperationUntilNothingIsLeft) {
  for (const Mesh& mesh : surfaces())
    EXPECT_EQ(
        followed_until_nothing_is_left<VertexAdjacency>(body_of<Map2>(mesh), 2, 60, expect_rebuilt).vertex_count(), 0u);
}

}  // namespace
}  // namespace dartboard
