#include <gtest/gtest.h>

#include <limits>

#include "tests/support/meshes/mesh_samples.h"

namespace dartboard::medit_test {
namespace {

using namespace samples;

LoadedMesh parse(std::string_view text) { return parse_mesh(text, MeshFormat::medit, "file"); }
std::string refused(std::string_view text) { return refusal(text, MeshFormat::medit); }

TEST(Medit, ReadsTetrahedraAndSkipsTheTrianglesBesideThem) {
  const LoadedMesh loaded = parse(medit);
  expect_two_tetrahedra(loaded);
  EXPECT_EQ(loaded.format, "Medit 2");
  ASSERT_EQ(loaded.notices.size(), 1u);
  EXPECT_EQ(loaded.notices[0], "skipped 1 triangle: the body is made of its 2 volumes");
}

TEST(Medit, ReadsASurfaceInThePlaneWithZeroHeight) {
  const LoadedMesh loaded = parse(
      "MeshVersionFormatted 1 Dimension 2 Vertices 5 0 0 0 1 0 0 1 1 0 0 1 0 2 0 0 "
      "Edges 1 1 2 0 Corners 1 1 Triangles 1 2 5 3 0 Quadrilaterals 1 1 2 3 4 0 End");
  EXPECT_EQ(loaded.mesh.dimension(), 2);
  EXPECT_EQ(loaded.mesh.kinds, (std::vector{CellKind::triangle, CellKind::quadrilateral}));
  EXPECT_EQ(loaded.mesh.points[2], Eigen::Vector3d(1, 1, 0));
  EXPECT_EQ(loaded.notices, (std::vector<std::string>{"skipped the section Corners: only points and cells are read",
                                                      "skipped 1 edge: the body is made of its 2 polygons"}));
}

TEST(Medit, ReadsHexahedraPrismsAndPyramids) {
  // a unit cube, half a cube at its side x = 1, and a roof on its top
  const LoadedMesh loaded = parse(
      "MeshVersionFormatted 2 Dimension 3 Vertices 11 0 0 0 0 1 0 0 0 1 1 0 0 0 1 0 0 0 0 1 0 1 0 1 0 1 1 1 0 0 1 1 0 "
      "2 0 0 0 2 0 1 0 0.5 0.5 2 0 Hexahedra 1 1 2 3 4 5 6 7 8 0 Prisms 1 2 9 3 6 10 7 0 Pyramids 1 5 6 7 8 11 0 End");
  EXPECT_EQ(loaded.mesh.kinds, (std::vector{CellKind::hexahedron, CellKind::prism, CellKind::pyramid}));
  EXPECT_TRUE(loaded.notices.empty());
  // sums of at most 24 products of a few small fractions: 64 u is ample
  constexpr double tolerance = 64 * std::numeric_limits<double>::epsilon();
  const double volumes[] = {1.0, 0.5, 1.0 / 3.0};
  for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(signed_measure(loaded.mesh, c), volumes[c], tolerance);
}

TEST(Medit, PassesOverSolutionsThatStandBesideTheMesh) {
  expect_two_tetrahedra(parse(with(medit, "End", "SolAtVertices 5 2 1 2 1 0 0 0 2 0 0 0 3 0 0 0 4 0 0 0 5 0 0 0 End")));
}

TEST(Medit, NamesTheLineOfAWordWhereANumberShouldStand) {
  EXPECT_EQ(refused(with(medit, "0 1 0 1", "0 one 0 1")),
            "file:9: 'one' is not a number; expected a coordinate of vertex 3");
}

TEST(Medit, RefusesCoordinatesThatAreNotFinite) {
  for (const char* bad : {"nan", "inf", "-inf", "1e999"})
    expect_part(refused(with(medit, "0 1 0 1", std::string("0 ") + bad + " 0 1")), "file:9: '");
}

TEST(Medit, TakesANumberTooSmallForADoubleAsZero) {
  EXPECT_EQ(parse(with(medit, "0 1 0 1", "1e-999 +1.0 0 1")).mesh.points[2], Eigen::Vector3d(0, 1, 0));
}

TEST(Medit, NamesAPointThatTheFileDoesNotDefine) {
  EXPECT_EQ(refused(with(medit, "2 3 4 5 0", "2 3 4 6 0")),
            "file:17: a tetrahedron has the point 6; expected one of the 5 point numbers in file");
  expect_part(refused(with(medit, "2 3 4 5 0", "0 3 4 5 0")), "has the point 0");
  expect_part(refused(with(medit, "2 3 4 5 0", "-2 3 4 5 0")), "file:17: -2 is negative");
}

TEST(Medit, RefusesAHugeCountWithoutAllocatingForIt) {
  expect_part(refused(with(medit, "Vertices\n5", "Vertices\n4000000000")), "file:12: 'Triangles' is not a number");
  expect_part(refused("MeshVersionFormatted 2 Dimension 3 Vertices 9000000000000000000 0 0 0"), "the text ends here");
}

TEST(Medit, TakesElementsOfSecondOrderByTheirCornersUnlessTheyAreSkippedAnyway) {
  const auto curved =
      parse(with(medit, "2\n1 2 3 4 0\n2 3 4 5 0", "1\n1 2 3 4 0 TetrahedraP2 1 2 3 4 5 1 1 1 1 1 1 0"));
  expect_two_tetrahedra(curved);
  EXPECT_EQ(curved.notices.at(1), "took 1 10-node tetrahedron by their corners: edges of a body are straight");
  const auto loaded = parse(with(medit, "End", "TrianglesP2 1 1 2 3 4 5 6 0 End"));
  EXPECT_EQ(loaded.notices.at(0), "skipped 1 triangle, 1 6-node triangle: the body is made of its 2 volumes");
}

TEST(Medit, RefusesAnUnknownSectionInsteadOfLosingCells) {
  expect_part(refused(with(medit, "Tetrahedra", "Tetrahedrons")), "file:14: 'Tetrahedrons' is not a section of a mesh");
}

}  // namespace
}  // namespace dartboard::medit_test
