#include "core/views/spring_ends.h"

#include <gtest/gtest.h>

#include "core/walks/cell_arrays.h"
#include "tests/support/meshes_for_tests.h"
#include "tests/support/random_operations.h"

namespace dartboard::spring_ends_test {
namespace {

// CellArrays finds the ends by covering the map.
template <class Body>
void expect_ends_of_the_map(const SpringEndsView& view, const Body& body) {
  CellArrays arrays;
  arrays.rebuild(body);
  ASSERT_EQ(view.ends.size(), arrays.edges.size());
  for (std::size_t k = 0; k < view.ends.size(); ++k) ASSERT_EQ(view.ends[k], arrays.edges[k].ends);
}

template <class Map>
struct SpringEndsOf : testing::Test {};
using Solids = testing::Types<Map3, TetMap>;
TYPED_TEST_SUITE(SpringEndsOf, Solids);

TYPED_TEST(SpringEndsOf, TwoTetrahedraAreAllPairsButTheTips) {
  const auto body = body_of<TypeParam>(unequal_tetrahedra());
  SpringEndsView view;
  view.rebuild(body);
  std::set<std::set<std::uint32_t>> pairs;
  for (const auto& [a, b] : view.ends) pairs.insert({body.vertices.point[a], body.vertices.point[b]});
  EXPECT_EQ(view.ends.size(), 9u);
  EXPECT_EQ(pairs.size(), 9u);
  EXPECT_FALSE(pairs.contains({3, 4}));
}

TYPED_TEST(SpringEndsOf, FollowEveryOperationUntilNothingIsLeft) {
  auto body = body_of<TypeParam>(kuhn_grid(3, 2, 2, 0.125));
  SpringEndsView view;
  view.rebuild(body);
  operate_at_random(body, 1, 100, [&](const auto& now, const TopologyChange&, const ChangedEmbeddings& changed) {
    view.apply(now, changed);
    SpringEndsView rebuilt;
    rebuilt.rebuild(now);
    ASSERT_EQ(view, rebuilt);
    expect_ends_of_the_map(view, now);
  });
  EXPECT_TRUE(view.ends.empty());
}

TEST(SpringEndsOfASurface, FollowEveryOperationUntilNothingIsLeft) {
  for (const Mesh& mesh : surfaces()) {
    auto body = body_of<Map2>(mesh);
    SpringEndsView view;
    view.rebuild(body);
    operate_at_random(body, 2, 60, [&](const auto& now, const TopologyChange&, const ChangedEmbeddings& changed) {
      view.apply(now, changed);
      expect_ends_of_the_map(view, now);
    });
  }
}

}  // namespace
}  // namespace dartboard::spring_ends_test
