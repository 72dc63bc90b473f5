#include "validation/topology_claims.h"

#include <gtest/gtest.h>

#include "tests/meshes_for_tests.h"

namespace dartboard {
namespace {

void expect_holds(const ClaimAnswer& answer) { EXPECT_TRUE(answer.holds) << answer.measured; }

TEST(TopologyClaims, OperationsCannotLeaveTheClass) {
  expect_holds(try_to_leave_the_class(kuhn_grid(3, 2, 2, 1.0), 400, 7));
}
TEST(TopologyClaims, NonManifoldInputsAreRefusedOrApart) { expect_holds(try_non_manifold_inputs()); }
TEST(TopologyClaims, OneGraphBelongsToTwoBodies) { expect_holds(try_same_graph_twice(kuhn_grid(2, 2, 2, 1.0))); }
TEST(TopologyClaims, OneGraphIsNotFoundTwiceWhereEveryInnerFaceTakesAnEdgeApart) {
  EXPECT_FALSE(try_same_graph_twice(unequal_tetrahedra()).holds);
}
TEST(TopologyClaims, ACombinatorialMapComesBack) {
  expect_holds(try_combinatorial_round_trip(kuhn_grid(2, 2, 2, 1.0)));
}

}  // namespace
}  // namespace dartboard
