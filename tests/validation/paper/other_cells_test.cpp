#include "validation/paper/other_cells.h"

#include <gtest/gtest.h>

#include "tests/validation/paper/paper_problem_for_tests.h"
#include "validation/paper/moves_as_reference.h"

namespace dartboard::other_cells_test {
namespace {

TEST(OtherCells, AreCutAndMovedLikeTetrahedra) { expect_yes(try_other_cells(mixed_box(2, 2, 2, 0.1), 60, 1)); }

TEST(OtherCells, AreNotAnsweredWhereAKindIsMissing) { expect_no(try_other_cells(hexahedron_box(3, 3, 3, 0.1), 60, 1)); }

TEST(OtherCells, FallShortWhereANodeOfAHexahedronGetsAQuarter) {
  expect_no(try_other_cells(mixed_box(2, 2, 2, 0.1), 60, 1, [](LiveBody<Map3>& body, const TopologyChange& change) {
    for (std::size_t c = 0; c < body.node_share.size(); ++c) body.node_share[c] = body.cell_mass[c] / 4.0;
    core_adapt(body, change);
  }));
}

TEST(MovesAsReference, WithinTenSpreads) {
  const double share = motion_beside_reference(kuhn_box(2, 2, 2, 0.1));
  EXPECT_LE(share, 1.0);
  EXPECT_GE(share, 0.01);  // the bound is no more than a hundred times too wide
}

}  // namespace
}  // namespace dartboard::other_cells_test
