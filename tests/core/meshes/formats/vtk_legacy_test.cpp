#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/support/mesh_samples.h"

namespace dartboard {
namespace {

using namespace samples;

LoadedMesh parse(std::string_view text) { return parse_mesh(text, MeshFormat::vtk_legacy, "file"); }
std::string refused(std::string_view text) { return refusal(text, MeshFormat::vtk_legacy); }

std::string grid(std::string_view points, std::string_view cells, std::string_view types) {
  return "# vtk DataFile Version 2.0\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " + std::string(points) +
         "\nCELLS " + std::string(cells) + "\nCELL_TYPES " + std::string(types) + "\n";
}

TEST(VtkLegacy, ReadsVersionThreeUpToTheFirstData) {
  const LoadedMesh loaded = parse(vtk4);
  expect_two_tetrahedra(loaded);
  EXPECT_EQ(loaded.format, "legacy VTK 3.0");
  EXPECT_EQ(loaded.notices, (std::vector<std::string>{"skipped 1 triangle: the body is made of its 2 volumes"}));
}

TEST(VtkLegacy, ReadsVersionFiveWithOffsets) { expect_two_tetrahedra(parse(vtk5)); }

TEST(VtkLegacy, ReordersVoxelsAndPixels) {
  const auto voxel =
      parse(grid("8 float 0 0 0 1 0 0 0 1 0 1 1 0 0 0 1 1 0 1 0 1 1 1 1 1", "1 9 8 0 1 2 3 4 5 6 7", "1 11"));
  EXPECT_EQ(voxel.mesh.kinds, std::vector{CellKind::hexahedron});
  EXPECT_DOUBLE_EQ(signed_measure(voxel.mesh, 0), 1.0);
  EXPECT_TRUE(voxel.notices.empty());
  const auto pixel = parse(grid("4 float 0 0 0 1 0 0 0 1 0 1 1 0", "1 5 4 0 1 2 3", "1 8"));
  EXPECT_DOUBLE_EQ(signed_measure(pixel.mesh, 0), 1.0);
}

TEST(VtkLegacy, TurnsAWedgeOfVtkIntoARightHandedPrism) {
  // the first triangle is turned outward, as VTK documents it
  const auto wedge = parse(grid("6 float 0 0 0 0 1 0 1 0 0 0 0 1 0 1 1 1 0 1", "1 7 6 0 1 2 3 4 5", "1 13"));
  EXPECT_DOUBLE_EQ(signed_measure(wedge.mesh, 0), 0.5);
  EXPECT_TRUE(wedge.notices.empty());
}

TEST(VtkLegacy, RefusesBinaryFilesAndOtherDataSets) {
  expect_part(refused(with(vtk4, "ASCII", "BINARY")), "file:3: found a BINARY file");
  expect_part(refused(with(vtk4, "UNSTRUCTURED_GRID", "POLYDATA")), "file:4: found the data set 'POLYDATA'");
  expect_part(refused(with(vtk4, "# vtk", "# VTX")), "file:1: found '# VTX DataFile Version 3.0'");
}

TEST(VtkLegacy, RefusesCellsThatItCannotHold) {
  EXPECT_EQ(refused(with(vtk4, "5 10 10\n", "5 10 24\n")),
            "file:14: found a 10-node tetrahedron; expected elements of first order, with straight edges");
  expect_part(refused(with(vtk4, "5 10 10\n", "5 10 42\n")), "file:14: cell 2 with 4 points has the type 42");
  expect_part(refused(with(vtk4, "5 10 10\n", "5 10 12\n")), "cell 2 is a hexahedron with 4 points; expected 8");
}

// The volumes of vtkCellType.h with curved edges: quadratic and biquadratic ones, Lagrange's and Bezier's.
TEST(VtkLegacy, RefusesEveryVolumeWithCurvedEdgesByItsName) {
  std::set<std::string> names;
  for (const int type : {24, 25, 26, 27, 29, 31, 32, 33, 37, 71, 72, 73, 74, 78, 79, 80, 81}) {
    const std::string message = refused(with(vtk4, "5 10 10\n", "5 10 " + std::to_string(type) + "\n"));
    expect_part(message, "expected elements of first order, with straight edges");
    EXPECT_TRUE(names.insert(message).second) << type << ": " << message;
    if (type >= 69) expect_part(message, type < 76 ? "found a Lagrange " : "found a Bezier ");
    if (type == 74 || type == 81) expect_part(message, "pyramid");
  }
}

TEST(VtkLegacy, RefusesAPointOutOfRange) {
  EXPECT_EQ(refused(with(vtk4, "4 1 2 3 4\n", "4 1 2 3 5\n")),
            "file:14: cell 2 has the point 5; expected a number from 0 to less than 5");
  expect_part(refused(with(vtk4, "4 1 2 3 4\n", "4 1 2 3 -1\n")), "cell 2 has the point -1");
}

TEST(VtkLegacy, RefusesCountsThatDoNotFit) {
  expect_part(refused(with(vtk4, "CELLS 3 14", "CELLS 3 15")), "the cells have 14 numbers; expected 15");
  expect_part(refused(with(vtk4, "CELLS 3 14", "CELLS 3 13")), "cell 2 has 4 points");
  expect_part(refused(with(vtk4, "CELL_TYPES 3", "CELL_TYPES 2")), "found 2 cell types; expected 3");
  expect_part(refused(with(vtk5, "0 4 8", "0 4 7")), "the last offset is 7; expected 8");
  expect_part(refused(with(vtk5, "0 4 8", "0 9 8")), "the offset of cell 1 is 9");
  expect_part(refused(with(vtk4, "POINTS 5", "POINTS 4000000000")), "'METADATA' is not a number");
}

TEST(VtkLegacy, RefusesATruncatedFile) {
  expect_part(refused(vtk4.substr(0, vtk4.find("CELL_TYPES"))), "the text ends here; expected POINTS, CELLS and");
}

}  // namespace
}  // namespace dartboard
