#include "validation/topology/topology_claims.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "core/topology/build.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::topology_claims_test {
namespace {

void expect_holds(const ClaimAnswer& answer) { EXPECT_TRUE(answer.holds) << answer.measured; }

TEST(TopologyClaims, OperationsCannotLeaveTheClass) {
  expect_holds(try_to_leave_the_class(kuhn_grid(3, 2, 2, 1.0), 400, 7));
}
// The first of them removes a cell where its dart is sewn, else tries to sew it; the second dissociates instead.
TEST(TopologyClaims, SayHowManyOperationsTheyMade) {
  const auto answers = [](int operations) {
    std::set<std::string> all;
    for (std::uint64_t seed = 1; seed <= 30; ++seed)
      all.insert(try_to_leave_the_class(kuhn_grid(1, 1, 1, 1.0), operations, seed).measured);
    return all;
  };
  const std::string valid = ": valid after each";
  const std::set<std::string> one = answers(1), two = answers(2);
  EXPECT_TRUE(one.contains("0 dissociations, 1 removals, 0 sews" + valid));
  EXPECT_TRUE(two.contains("1 dissociations, 1 removals, 0 sews" + valid));
  for (const std::string& answer : one) EXPECT_TRUE(answer.starts_with("0 dissociations")) << answer;
}

TEST(TopologyClaims, NonManifoldInputsAreRefusedOrApart) { expect_holds(try_non_manifold_inputs()); }
TEST(TopologyClaims, OneGraphBelongsToTwoBodies) { expect_holds(try_same_graph_twice(kuhn_grid(2, 2, 2, 1.0))); }
TEST(TopologyClaims, OneGraphIsNotFoundTwiceWhereEveryInnerFaceTakesAnEdgeApart) {
  EXPECT_FALSE(try_same_graph_twice(unequal_tetrahedra()).holds);
}
TEST(TopologyClaims, ACombinatorialMapComesBack) {
  expect_holds(try_combinatorial_round_trip(kuhn_grid(2, 2, 2, 1.0)));
}

TEST(TopologyClaims, ACombinatorialMapWithOneFaceApartDoesNotComeBack) {
  const Map3 map = build_map<Map3>(kuhn_grid(1, 1, 1, 1.0)).map;
  CombinatorialMap half = to_combinatorial_map(map);
  EXPECT_TRUE(comes_back(map, half).holds);
  std::uint32_t d = 0;
  while (half.beta[d][2] == CombinatorialMap::none) ++d;
  // the three darts of a face, and those opposite
  for (std::uint32_t k = 0, e = d; k < 3; ++k, e = half.beta[e][0]) {
    half.beta[half.beta[e][2]][2] = CombinatorialMap::none;
    half.beta[e][2] = CombinatorialMap::none;
  }
  const ClaimAnswer answer = comes_back(map, half);
  EXPECT_FALSE(answer.holds);
  EXPECT_NE(answer.measured.find("not isomorphic"), std::string::npos) << answer.measured;
}

TEST(TopologyClaims, DrawTheirOperationsFromTheSeed) {
  const auto tried = [](std::uint64_t seed) {
    return try_to_leave_the_class(kuhn_grid(2, 1, 1, 1.0), 100, seed).measured;
  };
  EXPECT_EQ(tried(7), tried(7));
  EXPECT_NE(tried(7), tried(8));
}

}  // namespace
}  // namespace dartboard::topology_claims_test
