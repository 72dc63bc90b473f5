#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/support/meshes/mesh_samples.h"

namespace dartboard::vtk_legacy_test {
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

TEST(VtkLegacy, RefusesOtherEncodingsAndOtherDataSets) {
  expect_part(refused(with(vtk4, "ASCII", "HEX")), "file:3: found 'HEX'; expected the word ASCII or BINARY");
  expect_part(refused(with(vtk4, "UNSTRUCTURED_GRID", "RECTILINEAR_GRID")),
              "file:4: found the data set 'RECTILINEAR_GRID'");
  expect_part(refused(with(vtk4, "# vtk", "# VTX")), "file:1: found '# VTX DataFile Version 3.0'");
}

TEST(VtkLegacy, RefusesCellsThatItCannotHold) {
  expect_part(refused(with(vtk4, "5 10 10\n", "5 10 24\n")),
              "file:14: cell 2 is a 10-node tetrahedron with 4 points; expected 10");
  expect_part(refused(with(vtk4, "5 10 10\n", "5 10 42\n")), "file:14: cell 2 with 4 points has the type 42");
  expect_part(refused(with(vtk4, "5 10 10\n", "5 10 12\n")), "cell 2 is a hexahedron with 4 points; expected 8");
}

// The volumes of vtkCellType.h with curved edges: quadratic and biquadratic ones, Lagrange's and Bezier's. Their
// corners come first, those of wedges with the first triangle turned inward.
TEST(VtkLegacy, TakesEveryVolumeWithCurvedEdgesByItsCorners) {
  struct Curved {
    int type;
    std::size_t points;
    CellKind kind;
  };
  using enum CellKind;
  std::set<std::string> names;
  for (const auto& [type, size, kind] : {Curved{24, 10, tetrahedron},
                                         {25, 20, hexahedron},
                                         {26, 15, prism},
                                         {27, 13, pyramid},
                                         {29, 27, hexahedron},
                                         {31, 12, prism},
                                         {32, 18, prism},
                                         {33, 24, hexahedron},
                                         {37, 19, pyramid},
                                         {71, 10, tetrahedron},
                                         {72, 64, hexahedron},
                                         {73, 18, prism},
                                         {74, 14, pyramid},
                                         {78, 20, tetrahedron},
                                         {79, 27, hexahedron},
                                         {80, 40, prism},
                                         {81, 14, pyramid}}) {
    const char* corners = kind == tetrahedron ? "0 0 0 1 0 0 0 1 0 0 0 1"
                          : kind == pyramid   ? "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1"
                          : kind == prism     ? "0 0 0 1 0 0 0 1 0 0 0 1 1 0 1 0 1 1"
                                              : "0 0 0 1 0 0 1 1 0 0 1 0 0 0 1 1 0 1 1 1 1 0 1 1";
    std::string points = corners, cell = std::to_string(size);
    for (std::size_t k = static_cast<std::size_t>(node_count(kind)); k < size; ++k) points += " 9 9 9";
    for (std::size_t k = 0; k < size; ++k) cell += " " + std::to_string(k);
    const LoadedMesh loaded = parse(grid(std::to_string(size) + " float " + points,
                                         "1 " + std::to_string(size + 1) + " " + cell, "1 " + std::to_string(type)));
    EXPECT_EQ(loaded.mesh.kinds, std::vector{kind}) << type;
    EXPECT_GT(signed_measure(loaded.mesh, 0), 0.16) << type;
    ASSERT_EQ(loaded.notices.size(), 2u) << type;  // read by its corners, without the other points: not turned
    EXPECT_TRUE(names.insert(loaded.notices[0]).second) << type << ": " << loaded.notices[0];
    expect_part(loaded.notices[0], "by their corners");
    if (type >= 69) expect_part(loaded.notices[0], type < 76 ? "took 1 Lagrange " : "took 1 Bezier ");
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
}  // namespace dartboard::vtk_legacy_test
