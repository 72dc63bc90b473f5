#include <gtest/gtest.h>

#include "core/meshes/gmsh/gmsh_elements.h"
#include "tests/support/meshes/mesh_samples.h"

namespace dartboard::gmsh_test {
namespace {

using namespace samples;

LoadedMesh parse(std::string_view text) { return parse_mesh(text, MeshFormat::gmsh, "file"); }
std::string refused(std::string_view text) { return refusal(text, MeshFormat::gmsh); }

TEST(Gmsh, ReadsVersionOneWithGapsInNodeNumbers) {
  const LoadedMesh loaded = parse(gmsh1);
  expect_two_tetrahedra(loaded);
  EXPECT_EQ(loaded.format, "Gmsh MSH 1");
  EXPECT_EQ(loaded.notices, (std::vector<std::string>{"skipped 1 triangle: the body is made of its 2 volumes"}));
}

TEST(Gmsh, ReadsVersionTwoAndSkipsOtherSections) {
  const LoadedMesh loaded = parse(gmsh2);
  expect_two_tetrahedra(loaded);
  EXPECT_EQ(loaded.format, "Gmsh MSH 2.2");
  EXPECT_EQ(loaded.notices,
            (std::vector<std::string>{"skipped 1 edge, 1 point element: the body is made of its 2 volumes"}));
}

TEST(Gmsh, ReadsVersionFourWithParametricNodes) {
  const LoadedMesh loaded = parse(gmsh4);
  expect_two_tetrahedra(loaded);
  EXPECT_EQ(loaded.format, "Gmsh MSH 4.1");
}

TEST(Gmsh, ReadsWindowsLineEndsWithTheRightLineNumbers) {
  std::string text;
  for (char c : gmsh1) text += c == '\n' ? "\r\n" : std::string(1, c);
  expect_two_tetrahedra(parse(text));
  expect_part(refused(with(text, "2 3 40 7", "2 3 40 8")), "file:13: a tetrahedron has the point 8");
}

TEST(Gmsh, RefusesAnotherFileTypeAndAnotherVersion) {
  EXPECT_EQ(refused(with(gmsh2, "2.2 0 8", "2.2 2 8")),
            "file:2: file type 2; expected file type 0 (text) or 1 (binary)");
  EXPECT_EQ(refused(with(gmsh4, "4.1 0 8", "3 0 8")), "file:2: version '3'; expected version 1, 2.x, 4.0 or 4.1");
}

TEST(Gmsh, TakesElementsOfSecondOrderByTheirCornersAndSaysSo) {
  const auto loaded = parse(with(gmsh2, "4 4 2 0 1 2 3 4 5", "4 11 2 0 1 2 3 4 5 1 1 1 1 1 1"));
  expect_two_tetrahedra(loaded);
  EXPECT_EQ(loaded.notices.at(1), "took 1 10-node tetrahedron by their corners: edges of a body are straight");
}

// Elements of higher order are named by their number of nodes; those used for cells have as many as these.
TEST(Gmsh, KnowsHowManyNodesEachElementHas) {
  int elements = 0;
  for (std::uint64_t type = 0; type < 200; ++type) {
    const GmshElement* element = gmsh_element(type);
    if (element == nullptr) continue;
    ++elements;
    const std::string name(element->name);
    if (element->kind) {
      EXPECT_EQ(element->dimension, dimension(*element->kind)) << name;
    }
    if (element->kind && element->is_first_order()) {
      EXPECT_EQ(element->name, dartboard::name(*element->kind));
    } else if (const auto end = name.find("-node "); end != name.npos) {
      EXPECT_EQ(element->nodes, std::stoi(name.substr(0, end))) << name;
      const std::string shape = name.substr(end + 6);
      const int expected = shape == "edge" ? 1 : shape == "triangle" || shape == "quadrilateral" ? 2 : 3;
      EXPECT_EQ(element->dimension, expected) << name;
    }
  }
  EXPECT_EQ(elements, 33);
}

TEST(Gmsh, EndsASectionByItsOwnNameAlone) { EXPECT_NE(refused("$Words{ 1 $EndWords[ " + std::string(gmsh2)), ""); }

TEST(Gmsh, SkipsElementsOfSecondOrderWithLowerDimension) {
  EXPECT_EQ(parse(with(gmsh2, "2 1 2 0 1 1 2", "2 9 2 0 1 1 2 3 4 5 6")).notices.at(0),
            "skipped 1 6-node triangle, 1 point element: the body is made of its 2 volumes");
}

TEST(Gmsh, TakesASurfaceOfSecondOrderByItsCorners) {
  const auto loaded = parse("$NOD 3 1 0 0 0 2 1 0 0 3 0 1 0 $ENDNOD $ELM 1 1 9 1 1 6 1 2 3 1 2 3 $ENDELM");
  EXPECT_EQ(loaded.mesh.kinds, std::vector{CellKind::triangle});
  EXPECT_EQ(loaded.mesh.nodes, (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(Gmsh, RefusesAnUnknownElementType) {
  expect_part(refused(with(gmsh2, "4 4 2 0 1 2 3 4 5", "4 140 2 0 1 2 3 4 5")), "file:21: found element type 140");
}

TEST(Gmsh, RefusesANodeNumberThatOccursTwice) {
  EXPECT_EQ(refused(with(gmsh1, "40 0 0 1", "3 0 0 1")),
            "file:6: point 3 occurs already in line 5; expected every point number once");
}

TEST(Gmsh, RefusesWrongCountsOfNodesAndElements) {
  expect_part(refused(with(gmsh1, "4 1 1 4 1 2", "4 1 1 3 1 2")), "file:12: 3 nodes in a tetrahedron; expected 4");
  expect_part(refused(with(gmsh1, "$NOD\n5", "$NOD\n4")), "file:7: found '7'; expected the end of the section $NOD");
  expect_part(refused(with(gmsh1, "$NOD\n5", "$NOD\n6")), "file:8: '$ENDNOD' is not an integer");
  expect_part(refused(with(gmsh4, "2 5 1 5", "2 6 1 6")), "the blocks hold 5; expected 6");
  expect_part(refused(with(gmsh1, "$NOD\n5", "$NOD\n4000000000")), "is not an integer");
}

TEST(Gmsh, RefusesATruncatedFile) {
  expect_part(refused(with(gmsh2, "$EndElements\n", "")), "file:21: the text ends here; expected the end of the");
  expect_part(refused(gmsh1.substr(0, gmsh1.find("$ELM"))), "file:8: the file has no cells");
}

TEST(Gmsh, RefusesAFileOfLinesAndPointsAndSaysThatItHasThem) {
  const auto file = [](const std::string& elements) {
    return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 2 0 0\n$EndNodes\n$Elements\n" +
           elements + "$EndElements\n";
  };
  expect_part(refused(file("2\n1 1 0 1 2\n2 1 0 2 3\n")),
              "the file has 2 edges and no cells; expected at least one triangle, quadrilateral or volume");
  expect_part(refused(file("2\n1 1 0 1 2\n2 15 0 3\n")), "the file has 1 edge, 1 point element and no cells; expected");
}

TEST(Gmsh, RefusesSectionsBeforeTheFormatIsKnown) {
  expect_part(refused("$Nodes\n0\n$EndNodes\n"), "file:1: found $Nodes; expected $MeshFormat before it");
  expect_part(refused("\x7f"
                      "ELF\x01"),
              "file:1: found '\\x7fELF\\x01'");
}

}  // namespace
}  // namespace dartboard::gmsh_test
