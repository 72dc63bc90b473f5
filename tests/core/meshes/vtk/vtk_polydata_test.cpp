// Legacy VTK with DATASET POLYDATA.

#include <gtest/gtest.h>

#include "tests/support/meshes/mesh_samples.h"
#include "tests/support/meshes/vtk_polygon_samples.h"

namespace dartboard::vtk_polydata_test {
namespace {

using namespace samples;

LoadedMesh parse(std::string_view text) { return parse_mesh(text, MeshFormat::vtk_legacy, "file"); }
std::string refused(std::string_view text) { return refusal(text, MeshFormat::vtk_legacy); }

TEST(VtkPolyData, ReadsToTheSameBitsAsTextAndAsBytesOfBothLayouts) {
  for (const std::string& text : {std::string(vtk_polygons), vtk_polygons_binary(false), vtk_polygons_binary(true)}) {
    const LoadedMesh loaded = parse(text);
    // the polygon comes before the strip, wherever the file has it
    EXPECT_EQ(loaded.mesh.nodes, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
    EXPECT_EQ(loaded.mesh.points, (std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    ASSERT_EQ(loaded.tags.size(), 1u);
    EXPECT_EQ(loaded.tags[0].values, (std::vector<std::int32_t>{7, -3}));
    EXPECT_EQ(loaded.notices,
              (std::vector<std::string>{"skipped 1 edge, 1 point element: the body is made of its 2 polygons"}));
  }
  EXPECT_EQ(parse(vtk_polygons).format, "legacy VTK 4.2 polygons");
  EXPECT_EQ(parse(vtk_polygons_binary(true)).format, "legacy VTK 5.1 polygons binary");
}

TEST(VtkPolyData, TurnsEveryOtherTriangleOfAStripAndGivesAllItsNumber) {
  std::string text = with(vtk_polygons, "TRIANGLE_STRIPS 1 4\n3 0 2 3", "TRIANGLE_STRIPS 1 5\n4 1 0 2 3");
  text = with(with(text, "POLYGONS 1 4\n3 0 1 2\n", ""), "CELL_DATA 4", "CELL_DATA 3");
  const LoadedMesh loaded = parse(with(text, "1 2 7 -3", "1 2 7"));
  EXPECT_EQ(loaded.mesh.nodes, (std::vector<std::uint32_t>{1, 0, 2, 2, 0, 3}));
  EXPECT_EQ(loaded.tags.at(0).values, (std::vector<std::int32_t>{7, 7}));
}

TEST(VtkPolyData, HasQuadrilateralsAmongItsPolygons) {
  const std::string text = with(with(vtk_polygons, "TRIANGLE_STRIPS 1 4\n3 0 2 3\n", ""), "POLYGONS 1 4\n3 0 1 2",
                                "POLYGONS 1 5\n4 0 1 2 3");
  EXPECT_EQ(parse(text.substr(0, text.find("CELL_DATA"))).mesh.kinds, std::vector{CellKind::quadrilateral});
}

TEST(VtkPolyData, MayEndWithItsLists) {
  const std::string text(vtk_polygons.substr(0, vtk_polygons.find("CELL_DATA")));
  EXPECT_EQ(parse(text).mesh.cell_count(), 2u);
}

TEST(VtkPolyData, RefusesListsThatAreTwiceThereOrOfAnotherSize) {
  expect_part(refused(with(vtk_polygons, "LINES 1 4", "POLYGONS 1 4")), "found POLYGONS again");
  expect_part(refused(with(vtk_polygons, "POLYGONS 1 4", "POLYGONS 1 5")), "the cells have 4 numbers; expected 5");
  expect_part(refused(with(vtk_polygons, "CELL_DATA 4", "CELL_DATA 2")), "CELL_DATA for 2; expected 4");
  expect_part(refused(with(vtk_polygons_binary(false), "POLYGONS 1", "POLYGONS 1000000000000000000")), "; expected");
}

TEST(VtkPolyData, RefusesCellsThatItCannotHold) {
  expect_part(refused(with(vtk_polygons, "3 0 1 2\n", "3 0 1 4\n")), "cell 2 has the point 4");
  expect_part(refused(with(vtk_polygons, "POLYGONS 1 4\n3 0 1 2", "POLYGONS 1 3\n2 0 1")),
              "cell 2 is a polygon of 2 corners; expected triangles and quadrilaterals");
  expect_part(refused(with(vtk_polygons, "POLYGONS 1 4\n3 0 1 2", "POLYGONS 1 6\n5 0 1 2 3 0")),
              "cell 2 is a polygon of 5 corners; expected triangles and quadrilaterals: split larger");
  expect_part(refused(with(vtk_polygons, "TRIANGLE_STRIPS 1 4\n3 0 2 3", "TRIANGLE_STRIPS 1 3\n2 0 2")),
              "cell 3 is a triangle strip with 2 points; expected 3 points or more");
  expect_part(refused(with(vtk_polygons, "3 0 1 2\n", "3 0 1 1\n")), "has the point 1 twice");
}

TEST(VtkPolyData, RefusesListsOfAGrid) {
  expect_part(refused(with(vtk_polygons, "LINES 1 4", "CELLS 1 4")), "found 'CELLS'; expected POINTS, VERTICES, LINES");
}

}  // namespace
}  // namespace dartboard::vtk_polydata_test
