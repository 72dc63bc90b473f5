// Legacy VTK and Gmsh as bytes, and the numbers that come with cells.

#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "tests/support/meshes/binary_mesh_samples.h"
#include "tests/support/meshes/mesh_samples.h"

namespace dartboard::binary_variants_test {
namespace {

using namespace samples;

using Values = std::vector<std::int32_t>;

LoadedMesh parse(std::string_view text, MeshFormat format) { return parse_mesh(text, format, "file"); }

// ---- legacy VTK

TEST(VtkBinary, ReadsBothListsOfCellsAndTheNumbersAfterThem) {
  for (const std::string& text : {vtk_binary(), vtk_binary_offsets()}) {
    const LoadedMesh loaded = parse(text, MeshFormat::vtk_legacy);
    expect_two_tetrahedra(loaded);
    EXPECT_TRUE(loaded.notices.empty());
    ASSERT_EQ(loaded.tags.size(), 1u);
    EXPECT_EQ(loaded.tags[0].name, "material");
    EXPECT_EQ(loaded.tags[0].values, (Values{7, -3}));
  }
}

TEST(VtkBinary, NamesTheByteOfWhatIsWrong) {
  const std::string text = vtk_binary();
  const std::size_t points = text.find("POINTS 5 double\n") + 16;
  std::string bad = text;
  bad.replace(points + 8, 8, bytes_of<double>({std::numeric_limits<double>::quiet_NaN()}, true));
  EXPECT_EQ(refusal(bad, MeshFormat::vtk_legacy),
            "file: byte " + std::to_string(points + 8) + ": nan is not finite; expected a coordinate of point 0");
  const std::string cut = text.substr(0, points + 100);
  EXPECT_EQ(refusal(cut, MeshFormat::vtk_legacy),
            "file: byte " + std::to_string(points + 96) + ": 4 bytes are left; expected a coordinate of point 4");
}

TEST(VtkBinary, RefusesCountsThatTheFileCannotHold) {
  const std::string huge = "1000000000000000000";
  for (const char* count : {"POINTS 5", "CELLS 2", "CELL_TYPES 2"}) {
    const std::string keyword(count, std::strchr(count, ' ') + 1);
    expect_part(refusal(with(vtk_binary(), count, keyword + huge), MeshFormat::vtk_legacy), "expected");
  }
  expect_part(refusal(with(vtk_binary(), "TIME 1 1", "TIME 1 " + huge), MeshFormat::vtk_legacy), " bytes are left");
}

TEST(VtkData, OfCellsThatAreSkippedAreSkippedToo) {
  const std::string text =
      with(vtk4, "POINT_DATA 5", "CELL_DATA 3\nSCALARS part int\nLOOKUP_TABLE default\n5 6 7\nPOINT_DATA 5");
  const auto tags = parse(text, MeshFormat::vtk_legacy).tags;
  ASSERT_EQ(tags.size(), 1u);
  EXPECT_EQ(tags[0].values, (Values{6, 7}));
}

TEST(VtkData, OfAnotherNumberOfCellsAreRefused) {
  expect_part(refusal(with(vtk4, "POINT_DATA 5", "CELL_DATA 5"), MeshFormat::vtk_legacy),
              "CELL_DATA for 5; expected 3");
}

TEST(VtkData, ThatAreNotKnownEndTheReadingWithANotice) {
  const auto loaded =
      parse(with(vtk5, "CELL_TYPES 2\n10 10\n", "CELL_TYPES 2\n10 10\nSELECTION a 2 float\n"), MeshFormat::vtk_legacy);
  EXPECT_EQ(loaded.notices,
            (std::vector<std::string>{"did not read the data from 'SELECTION' on: of a kind that is not known"}));
}

// ---- Gmsh

TEST(GmshBinary, ReadsVersionTwoOfEitherByteOrderWithItsGroups) {
  for (const bool big_endian : {false, true}) {
    const LoadedMesh loaded = parse(gmsh2_binary(big_endian), MeshFormat::gmsh);
    expect_two_tetrahedra(loaded);
    EXPECT_EQ(loaded.format, "Gmsh MSH 2.2 binary");
    ASSERT_EQ(loaded.tags.size(), 2u);
    EXPECT_EQ(loaded.tags[0].name, "physical group");
    EXPECT_EQ(loaded.tags[0].values, (Values{7, 8}));
    EXPECT_EQ(loaded.tags[0].names, (std::map<std::int32_t, std::string>{{7, "the body"}}));
  }
}

// The second volume is in two groups, the first of them with the other orientation.
TEST(GmshBinary, ReadsVersionFourWithTheGroupsOfItsEntities) {
  const LoadedMesh loaded = parse(gmsh41_binary(), MeshFormat::gmsh);
  expect_two_tetrahedra(loaded);
  EXPECT_EQ(loaded.format, "Gmsh MSH 4.1 binary");
  EXPECT_EQ(loaded.notices,
            (std::vector<std::string>{"1 entity is in more than one physical group: only the first is kept",
                                      "skipped 1 triangle: the body is made of its 2 volumes"}));
  ASSERT_EQ(loaded.tags.size(), 2u);
  EXPECT_EQ(loaded.tags[0].values, (Values{7, 8}));
  EXPECT_EQ(loaded.tags[1].name, "entity");
  EXPECT_EQ(loaded.tags[1].values, (Values{1, 2}));
}

TEST(GmshBinary, RefusesAnOrderOfBytesThatIsNone) {
  const std::string text = gmsh2_binary(false);
  expect_part(refusal(with(text, "2.2 1 8\n\x01", "2.2 1 8\n\x02"), MeshFormat::gmsh), "file: byte 20: found '\\x02");
}

TEST(GmshBinary, RefusesCountsThatTheFileCannotHold) {
  const std::string text = gmsh2_binary(false);
  expect_part(refusal(with(text, "$Nodes\n5", "$Nodes\n1000000000000000000"), MeshFormat::gmsh), "; expected");
  expect_part(refusal(with(text, "$Elements\n3", "$Elements\n2"), MeshFormat::gmsh),
              "2 elements follow; expected 1 to 1");
  const std::string blocks = gmsh41_binary();
  const std::string right = bytes_of<std::uint64_t>({2, 5, 1, 5}),
                    huge = bytes_of<std::uint64_t>({2, 1ull << 60, 1, 5});
  expect_part(refusal(with(blocks, right, huge), MeshFormat::gmsh), "the blocks hold 5; expected 1152921504606846976");
}

TEST(Gmsh, ReadsVersionFourPointZero) {
  const auto text = with(
      with(with(with(with(gmsh4, "4.1 0 8", "4 0 8"),
                     "2 5 1 5\n2 1 1 2\n1\n2\n0 0 0 0.25 0.75\n1 0 0 0.5 0.5\n3 1 0 3\n3\n4\n5\n0 1 0\n0 0 1\n1 1 1\n",
                     "2 5\n1 2 1 2\n1 0 0 0 0.25 0.75\n2 1 0 0 0.5 0.5\n1 3 0 3\n3 0 1 0\n4 0 0 1\n5 1 1 1\n"),
                "2 3 1 3\n2 1 2 1", "2 3\n1 2 2 1"),
           "3 1 4 2\n", "1 3 4 2\n"),
      "1 0 0 0 1 1 1 0 0", "1 0 0 0 1 1 1 1 9 0");
  const auto loaded = parse(text, MeshFormat::gmsh);
  expect_two_tetrahedra(loaded);
  EXPECT_EQ(loaded.format, "Gmsh MSH 4");
  EXPECT_EQ(loaded.tags.at(0).values, (Values{9, 9}));
}

// ---- others

TEST(CellTags, AreTheReferencesOfMeditWhereThereAreAny) {
  EXPECT_TRUE(parse(medit, MeshFormat::medit).tags.empty());
  const auto tags = parse(with(medit, "2 3 4 5 0", "2 3 4 5 -6"), MeshFormat::medit).tags;
  ASSERT_EQ(tags.size(), 1u);
  EXPECT_EQ(tags[0].name, "reference");
  EXPECT_EQ(tags[0].values, (Values{0, -6}));
}

TEST(CellTags, AreTheRegionsOfTetGen) {
  const auto tags = parse(tetgen(), MeshFormat::tetgen).tags;
  ASSERT_EQ(tags.size(), 1u);
  EXPECT_EQ(tags[0].name, "region");
  EXPECT_EQ(tags[0].values, (Values{7, 7}));
}

}  // namespace
}  // namespace dartboard::binary_variants_test
