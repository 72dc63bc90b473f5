#include <gtest/gtest.h>

#include "tests/support/meshes/mesh_samples.h"

namespace dartboard::tetgen_test {
namespace {

using namespace samples;

std::string refused(std::string_view text) { return refusal(text, MeshFormat::tetgen); }

TEST(TetGen, ReadsPointsNumberedFromZeroWithAttributesAndMarkers) {
  const LoadedMesh loaded = parse_mesh(tetgen(), MeshFormat::tetgen, "file");
  expect_two_tetrahedra(loaded);
  EXPECT_EQ(loaded.format, "TetGen");
  EXPECT_TRUE(loaded.notices.empty());
}

TEST(TetGen, ReadsPointsNumberedFromOne) {
  expect_two_tetrahedra(
      parse_mesh("5 3 0 0\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n# cells\n2 4 0\n1 1 2 3 4\n2 2 3 4 5\n",
                 MeshFormat::tetgen, "file"));
}

TEST(TetGen, ReadsTrianglesInThePlane) {
  const auto loaded = parse_mesh("3 2 0 1\n1 0 0 1\n2 1 0 1\n3 0 1 1\n1 3 0\n1 1 2 3\n", MeshFormat::tetgen, "file");
  EXPECT_EQ(loaded.mesh.kinds, std::vector{CellKind::triangle});
}

TEST(TetGen, RefusesPointsNumberedFromTwo) {
  EXPECT_EQ(refused(with(tetgen(), "0 0 0 0 0.5 1", "2 0 0 0 0.5 1")),
            "file:3: the first point is 2; expected points numbered from 0 or 1");
}

TEST(TetGen, TakesCellsOfSecondOrderByTheirCorners) {
  const auto text =
      with(tetgen(), "2 4 1\n0 0 1 2 3 7\n1 1 2 3 4 7", "2 10 0\n0 0 1 2 3 4 0 1 2 3 4\n1 1 2 3 4 0 0 0 0 0 0");
  expect_two_tetrahedra(parse_mesh(text, MeshFormat::tetgen, "file"));
}

TEST(TetGen, RefusesTwoBoundaryMarkers) {
  expect_part(refused("3 2 0 2\n1 0 0 1 1\n2 1 0 1 1\n3 0 1 1 1\n1 3 0\n1 1 2 3\n"),
              ": 2 boundary markers; expected 0 or 1");
}

TEST(TetGen, RefusesMoreOrFewerCellsThanAnnounced) {
  expect_part(refused(with(tetgen(), "2 4 1", "1 4 1")), "file:10: '1' follows the last cell");
  expect_part(refused(with(tetgen(), "2 4 1", "3 4 1")), "the text ends here; expected the number of a cell");
  expect_part(refused(tetgen_node), "expected the number of cells");
}

}  // namespace
}  // namespace dartboard::tetgen_test
