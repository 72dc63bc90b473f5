// Files of other programs: the content that is read, the notices, and the refusals that remain.

#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/meshes/mesh_samples.h"
#include "tests/support/meshes/writer_samples.h"

namespace dartboard::mesh_writers_test {
namespace {

using namespace samples;
using Notices = std::vector<std::string>;

LoadedMesh medit_mesh(std::string_view text) { return parse_mesh(text, MeshFormat::medit, "file"); }
std::string refused_medit(std::string_view text) { return refusal(text, MeshFormat::medit); }

void expect_square(const LoadedMesh& loaded) {
  EXPECT_EQ(loaded.mesh.nodes, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(loaded.mesh.points, (std::vector<Eigen::Vector3d>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
}

// ---- Medit

TEST(MeditOfMmg, NamesTheSectionsThatWereSkipped) {
  const LoadedMesh loaded = medit_mesh(medit_of_mmg);
  expect_two_tetrahedra(loaded);
  EXPECT_EQ(
      loaded.notices,
      (Notices{"skipped the sections Corners, RequiredVertices, RequiredTriangles, Ridges, RequiredEdges, "
               "RequiredTetrahedra, Normals, NormalAtVertices, Tangents, TangentAtVertices: only points and cells "
               "are read",
               "skipped 1 triangle, 1 edge: the body is made of its 2 volumes"}));
}

TEST(MeditOfBamg, HasVersion0QuotedTextsAndSizesAtVertices) {
  const LoadedMesh loaded = medit_mesh(medit_of_bamg);
  expect_square(loaded);
  EXPECT_EQ(loaded.format, "Medit 0");
}

TEST(MeditKeywords, MayBeInSmallLetters) {
  const LoadedMesh loaded = medit_mesh(medit_in_small_letters);
  expect_two_tetrahedra(loaded);
  EXPECT_EQ(loaded.notices,
            (Notices{"skipped the sections corners, solatvertices, trianglesGid: only points and cells are read",
                     "skipped 1 edge: the body is made of its 2 volumes"}));
}

TEST(MeditText, WithoutEndIsReadWithANotice) {
  const LoadedMesh loaded = medit_mesh(with(medit, "End\n", ""));
  expect_two_tetrahedra(loaded);
  EXPECT_EQ(loaded.notices.front(),
            "the file ends without the word End: whether further sections were cut off cannot be known");
}

TEST(MeditText, WithoutEndIsRefusedWithinASection) {
  EXPECT_EQ(refused_medit(with(with(medit, "End\n", ""), "Tetrahedra\n2", "Tetrahedra\n3")),
            "file:17: the text ends here; expected a vertex of tetrahedron 3");
}

TEST(MeditSkipped, SectionsOfAnyNameEndWithTheNextWord) {
  for (const char* section : {"Nothing", "Foo_2 3 -1 1e-3 +4", "OfText 1 \"Tetrahedra 9 \" 2 \"the End \""}) {
    const LoadedMesh loaded = medit_mesh(with(medit, "Triangles", std::string(section) + "\nTriangles"));
    expect_two_tetrahedra(loaded);
    const std::string_view name(section, std::strcspn(section, " "));
    EXPECT_EQ(loaded.notices.front(), "skipped the section " + std::string(name) + ": only points and cells are read");
  }
  expect_part(refused_medit(with(medit, "Triangles", "1 Triangles")), "'1' is not a section of a mesh");
}

TEST(MeditSkipped, SectionsThatMayHoldCellsAreRefused) {
  for (const std::string name : {"TetrahedraP3", "TRIANGLESP4", "HexahedraQ3", "Prisms9", "Quadrilaterals6", "Polygons",
                                 "InnerPolygonHeaders", "PolyhedraFaces", "Tetraedra", "pyramid", "Wedges"})
    expect_part(refused_medit(with(medit, "End", name + " 1 1 2 3 4 0 End")),
                "'" + name + "' is not a section of a mesh");
  for (const std::string name : {"TetrahedraP2Ordering", "TrianglesOnGeometricTriangles", "TriangleReferenceElement",
                                 "TetrahedraGrainPartitions", "TetrahedraColour", "PrismsGID", "CoarseHexahedra",
                                 "RequiredTetrahedra", "HOSolAtTetrahedraP1", "PrivateTable"})
    expect_two_tetrahedra(medit_mesh(with(medit, "End", name + " 1 1 2 3 4 0 End")));
}

TEST(MeditSkipped, SolutionsMayHaveValuesThatAreNoNumbers) {
  expect_two_tetrahedra(medit_mesh(with(medit, "End", "SolAtVertices 5 1 1 1 nan -nan inf 0.5 End")));
}

TEST(MeditSkipped, TextsEndWithTheirQuoteOrTheirLine) {
  for (const char* text :
       {"Identifier \"a b\" ", "Identifier a b\n", "Geometry \"\" ", "Comments 2\nEnd of\n\"a b\"\n"})
    expect_two_tetrahedra(medit_mesh(with(medit, "Vertices", std::string(text) + "Vertices")));
  expect_part(refused_medit(with(medit, "Vertices", "Identifier \"a b\nVertices")),
              "file:5: a text in quotes has no end in its line");
}

// ---- Gmsh

TEST(GmshGroups, OfOneElementThatIsListedForEachKeepTheFirst) {
  const LoadedMesh loaded = parse_mesh(gmsh2_of_groups, MeshFormat::gmsh, "file");
  expect_two_tetrahedra(loaded);
  EXPECT_EQ(loaded.tags.at(0).values, (std::vector<std::int32_t>{8, 8}));
  EXPECT_EQ(loaded.notices,
            (Notices{"2 elements are listed again in a further physical group: only the first is kept"}));
}

TEST(GmshGroups, DoNotExcuseAnElementThatIsTwiceInOneOfThem) {
  const auto refused = [](std::string_view text) { return refusal(text, MeshFormat::gmsh); };
  expect_part(refused(with(gmsh2_of_groups, "2 4 2 9 1 1 2 3 4", "2 4 2 8 1 1 2 3 4")), "has the same points as");
  const auto thrice = with(with(gmsh2_of_groups, "4\n1 4 2", "5\n1 4 2"), "3 4 2 8", "5 4 2 9 1 4 3 2 1\n3 4 2 8");
  expect_part(refused(thrice), "has the same points as");
}

// ---- numbers of Fortran

TEST(FortranNumbers, MarkTheirExponentsByADInAnyTextFormat) {
  const auto y_of_point_2 = [](std::string_view text, MeshFormat format) {
    return parse_mesh(text, format, "file").mesh.points[2].y();
  };
  for (const char* one : {"1.0D+00", "1.D0", "10.0d-1", "+1d0"})
    EXPECT_EQ(y_of_point_2(with(medit, "0 1 0 1", std::string("0 ") + one + " 0 1"), MeshFormat::medit), 1.0) << one;
  EXPECT_EQ(y_of_point_2(with(vtk4, "0 1 0 0", "0 1.0D+00 0 0"), MeshFormat::vtk_legacy), 1.0);
  EXPECT_EQ(y_of_point_2(with(medit, "0 1 0 1", "1.0D-999 1 0 1"), MeshFormat::medit), 1.0);
}

TEST(FortranNumbers, HaveOneExponentAfterADigit) {
  for (const char* bad : {"D0", "1D", "1D0D0", "1D0E0", "-D1", "1D+"})
    expect_part(refused_medit(with(medit, "0 1 0 1", std::string("0 ") + bad + " 0 1")), "is not a number");
  expect_part(refused_medit(with(medit, "0 1 0 1", "0 1D999 0 1")), "is too large for a double");
}

// ---- VTK

TEST(VtkOfFreeFem, KeepsItsLabelsAndWhatComesAfterItsColours) {
  const LoadedMesh loaded = parse_mesh(vtk_of_freefem, MeshFormat::vtk_legacy, "file");
  expect_two_tetrahedra(loaded);
  ASSERT_EQ(loaded.tags.size(), 2u);
  EXPECT_EQ(loaded.tags[0].name, "Label");
  EXPECT_EQ(loaded.tags[0].values, (std::vector<std::int32_t>{7, 8}));
  EXPECT_EQ(loaded.tags[1].values, (std::vector<std::int32_t>{4, 5}));
  EXPECT_EQ(loaded.notices, (Notices{"skipped 1 triangle: the body is made of its 2 volumes"}));
}

TEST(VtkKeywords, MayBeInSmallLetters) {
  const LoadedMesh loaded = parse_mesh(vtk_in_small_letters, MeshFormat::vtk_legacy, "file");
  expect_two_tetrahedra(loaded);
  ASSERT_EQ(loaded.tags.size(), 2u);
  EXPECT_EQ(loaded.tags[1].values, (std::vector<std::int32_t>{3, 4}));
  EXPECT_TRUE(loaded.notices.empty());
}

TEST(VtkGhosts, OfAnyFileAreLeftOutWhereTheyAreCopiesOrHidden) {
  const LoadedMesh loaded = parse_mesh(vtu_with_ghosts, MeshFormat::vtu, "file");
  expect_two_tetrahedra(loaded);
  ASSERT_EQ(loaded.tags.size(), 1u);
  EXPECT_EQ(loaded.tags[0].values, (std::vector<std::int32_t>{6, 7}));
  EXPECT_EQ(loaded.notices.front(), "left out 2 ghost cells: copies of cells of other pieces, or hidden ones");
  const auto legacy = with(vtk_of_freefem, "Scalars  Label int 1", "SCALARS vtkGhostType unsigned_char 1");
  EXPECT_EQ(parse_mesh(with(legacy, "7\n8\n1\n", "33\n2\n0\n"), MeshFormat::vtk_legacy, "file").mesh.cell_count(), 1u);
}

TEST(VtkContent, IsReadByWhatItIsAndNotByItsExtension) {
  const LoadedMesh xml = parse_mesh(vtu_ascii, MeshFormat::vtk_legacy, "file");
  expect_two_tetrahedra(xml);
  EXPECT_EQ(xml.format, "VTU");
  EXPECT_EQ(xml.notices.front(), "the text is in the format VTK XML (.vtu) and was read so, not as legacy VTK (.vtk)");
  expect_two_tetrahedra(parse_mesh(vtk4, MeshFormat::vtu, "file"));
  expect_part(refusal(with(vtu_ascii, "\"UnstructuredGrid\"", "\"ImageData\""), MeshFormat::vtk_legacy),
              "of type 'ImageData'; expected <VTKFile type=\"UnstructuredGrid\">");
}

// ---- surfaces

TEST(OffHeader, MayHaveItsNumbersOnOneLineAndNoEdges) {
  const auto square = [](std::string_view head) {
    return std::string(head) + std::string(off_of_one_line.substr(off_of_one_line.find('\n')));
  };
  for (const char* head : {"off4 2", "OFF4 2 5", "OFF 4 2 5", "OFF\n4 2", "Off # none\n# none\n4 2 # none",
                           "OFF\n4\n2\n5", "4 2 5", "4 2"})
    expect_square(parse_mesh(square(head), MeshFormat::off, "file"));
  expect_part(refusal(square("OFF 4 2 5 6"), MeshFormat::off), "file:1: '6' follows the numbers");
  expect_part(refusal(square("OFFX 4 2 5"), MeshFormat::off), "file:1: found 'OFFX'; expected the word OFF");
  expect_part(refusal(square("OFF 4"), MeshFormat::off), "expected");
}

TEST(StlText, MayBeInCapitals) {
  const LoadedMesh loaded = parse_mesh(stl_in_capitals, MeshFormat::stl, "file");
  expect_square(loaded);
  EXPECT_EQ(loaded.format, "STL");
  EXPECT_EQ(loaded.tags.at(0).values, (std::vector<std::int32_t>{1, 1}));
  expect_square(parse_mesh("\xEF\xBB\xBF" + std::string(stl_in_capitals), MeshFormat::stl, "file"));
}

TEST(StlFacets, WithTwoEqualCornersAreLeftOut) {
  EXPECT_EQ(parse_mesh(stl_in_capitals, MeshFormat::stl, "file").notices,
            (Notices{"left out 1 facet with two equal corners"}));
}

TEST(ObjPoints, OfTwoCoordinatesAreInThePlane) {
  const LoadedMesh loaded = parse_mesh(obj_in_the_plane, MeshFormat::obj, "file");
  expect_square(loaded);
  EXPECT_EQ(loaded.notices, (Notices{"put 4 points of two coordinates in the plane z = 0"}));
  expect_part(refusal(with(obj_in_the_plane, "v 0 1", "v 0"), MeshFormat::obj), "'f' is not a number");
}

TEST(PlyPoints, WithoutAPropertyZAreInThePlane) {
  const LoadedMesh loaded = parse_mesh(ply_in_the_plane, MeshFormat::ply, "file");
  expect_square(loaded);
  EXPECT_EQ(loaded.notices, (Notices{"put 4 points of two coordinates in the plane z = 0"}));
}

TEST(OffPoints, OfTwoCoordinatesAreInThePlaneWhereTheWordSaysSo) {
  const auto points = std::string(off_in_the_plane.substr(off_in_the_plane.find("4 2 0")));
  for (const char* head : {"nOFF 2\n", "nOFF\n2\n", "nOFF2 ", "2OFF\n", "2off "}) {
    const LoadedMesh loaded = parse_mesh(head + points, MeshFormat::off, "file");
    expect_square(loaded);
    EXPECT_EQ(loaded.notices, (Notices{"put 4 points of two coordinates in the plane z = 0"})) << head;
  }
  expect_part(refusal("OFF\n" + points, MeshFormat::off), "expected");
}

TEST(OffPoints, HaveTwoOrThreeCoordinates) {
  const auto points = std::string(off_of_one_line.substr(off_of_one_line.find('\n')));
  for (const char* head : {"nOFF 3 4 2", "3OFF 4 2 5"}) {
    const LoadedMesh loaded = parse_mesh(head + points, MeshFormat::off, "file");
    expect_square(loaded);
    EXPECT_TRUE(loaded.notices.empty()) << head;
  }
  for (const char* many : {"0", "1", "4"})
    expect_part(refusal("nOFF " + std::string(many) + "\n4 2" + points, MeshFormat::off),
                "file:1: points of " + std::string(many) + " coordinates; expected 2 or 3 coordinates");
}

TEST(OffPoints, HaveNormalsWhereTheNIsNoSmallLetterBeforeCapitals) {
  for (const char* head : {"NOFF", "noff"})
    expect_square(
        parse_mesh(head + std::string("\n4 2\n0 0 0 7 7 7\n1 0 0 7 7 7\n1 1 0 7 7 7\n0 1 0 7 7 7\n3 0 1 2\n3 0 2 3\n"),
                   MeshFormat::off, "file"));
}

}  // namespace
}  // namespace dartboard::mesh_writers_test
