// Faults that readers of meshes must not accept, and data that they must not lose: numbers, points that no cell uses,
// counts, lines; and written meshes must read back.

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <tuple>

#include "core/meshes/generators/mesh_generators.h"
#include "core/meshes/text/base64.h"
#include "core/meshes/vtk/vtu_array.h"
#include "tests/support/folder_for_tests.h"
#include "tests/support/meshes/mesh_samples.h"

namespace dartboard::mesh_reading_test {
namespace {

using namespace samples;

std::string refused_medit(std::string_view text) { return refusal(text, MeshFormat::medit); }
std::string refused_vtk(std::string_view text) { return refusal(text, MeshFormat::vtk_legacy); }
std::string refused_vtu(std::string_view text) { return refusal(text, MeshFormat::vtu); }

// ---- numbers and words

TEST(MeshText, RefusesANumberThatGoesOnAsAWord) {
  expect_part(refused_medit(with(medit, "0 1 0 1", "0 1x 0 1")), "file:9: '1x' is not a number");
  expect_part(refused_medit(with(medit, "1 2 3 4 0", "1 2 3.0 4 0")), "file:16: '3.0' is not an integer");
}

TEST(MeshText, TakesOneSignAndNotTwo) {
  EXPECT_EQ(parse_mesh(with(medit, "0 1 0 1", "0 +1 0 1"), MeshFormat::medit, "file").mesh.points[2].y(), 1.0);
  for (const char* bad : {"+-1", "++1", "-+1", "+"})
    expect_part(refused_medit(with(medit, "0 1 0 1", std::string("0 ") + bad + " 0 1")), "is not a number");
}

TEST(MeshText, PassesOverAByteOrderMark) {
  const std::string mark = "\xEF\xBB\xBF";
  expect_two_tetrahedra(parse_mesh(mark + std::string(medit), MeshFormat::medit, "file"));
  expect_two_tetrahedra(parse_mesh(mark + std::string(vtu_ascii), MeshFormat::vtu, "file"));
}

TEST(MeshText, QuotesFortyLettersOfAWordAndNoEscapeSequence) {
  const std::string said = refused_medit(with(medit, "Tetrahedra", "\x1b[31m" + std::string(1000, 'x')));
  expect_part(said, "'\\x1b[31m" + std::string(35, 'x') + "...'");
  EXPECT_LT(said.size(), 400u);
  for (const char c : said) EXPECT_TRUE(c >= ' ' && c <= '~');
}

// ---- points and cells

TEST(MeshReading, DropsPointsWithoutACellAndTellsWhereTheOthersAre) {
  const auto text = with(with(with(with(medit, "Vertices\n5\n", "Vertices\n6\n9 9 9 0\n"), "1 2 3 7", "2 3 4 7"),
                              "1 2 3 4 0", "2 3 4 5 0"),
                         "2 3 4 5 0\nEnd", "3 4 5 6 0\nEnd");
  const LoadedMesh loaded = parse_mesh(text, MeshFormat::medit, "file");
  expect_two_tetrahedra(loaded);
  ASSERT_EQ(loaded.notices.size(), 2u);
  EXPECT_EQ(loaded.notices[1], "dropped 1 point that belongs to no cell");
  constexpr auto none = std::numeric_limits<std::uint32_t>::max();
  EXPECT_EQ(loaded.place_of_point, (std::vector<std::uint32_t>{none, 0, 1, 2, 3, 4}));
}

TEST(MeshReading, SaysWhatItHasSkippedByKindAndNumber) {
  const std::string more =
      "Quadrilaterals 2 1 2 3 4 7 1 2 3 5 7 TrianglesP2 1 1 2 3 4 5 1 0 TrianglesP2 2 1 2 3 4 5 1 0 1 "
      "2 3 4 5 1 0 End";
  EXPECT_EQ(parse_mesh(with(medit, "End", more), MeshFormat::medit, "file").notices,
            (std::vector<std::string>{
                "skipped 1 triangle, 2 quadrilaterals, 3 6-node triangles: the body is made of its 2 volumes"}));
}

// The triangle before them has a line of its own: the fifth point moved onto the second flattens the second volume.
TEST(MeshReading, NamesTheLineOfACellAmongOthersThatAreSkipped) {
  expect_part(refused_medit(with(medit, "1 1 1 2", "1 0 0 2")), "file:17: cell 1 (tetrahedron) has the measure 0");
}

TEST(MeshReading, RefusesEdgesTooLongOrTooShortToMeasure) {
  for (const auto& [scale, why] :
       {std::pair{"e200", "too long to measure it"}, {"e-105", "has the measure 1.67e-316"}}) {
    std::string text = "MeshVersionFormatted 2 Dimension 3 Vertices 4 ";
    for (const char* point : {"0 0 0", "@ 0 0", "0 @ 0", "0 0 @"}) {
      std::string x = point;
      if (const auto at = x.find('@'); at != x.npos) x.replace(at, 1, std::string("1") + scale);
      text += x + " 0 ";
    }
    expect_part(refused_medit(text + "Tetrahedra 1 1 2 3 4 0 End"), why);
  }
}

// ---- counts

TEST(MeditSections, EndWithTheWordForIt) {
  expect_part(refused_medit(medit.substr(0, medit.find("Tetrahedra") + 10)), "the text ends here");
}

TEST(MeditSections, OfVerticesAreNotAdded) {
  expect_part(refused_medit(with(medit, "Triangles 1", "Vertices\n1\n2 2 2 0\nTriangles 1")), "found Vertices again");
}

TEST(TetGenNodes, MayLeaveOutTheMarkerThatTheyAnnounce) {
  expect_two_tetrahedra(
      parse_mesh("5 3 0 1\n1 0 0 0\n2 1 0 0\n3 0 1 0 1\n4 0 0 1\n5 1 1 1\n2 4 0\n1 1 2 3 4\n2 2 3 4 5\n",
                 MeshFormat::tetgen, "file"));
}

TEST(VtkCounts, OfPointsAreThoseOfTheKindOfCell) {
  EXPECT_EQ(refused_vtk(with(with(vtk4, "CELLS 3 14", "CELLS 3 15"), "4 1 2 3 4\n", "5 1 2 3 4 0\n")),
            "file:14: cell 2 is a tetrahedron with 5 points; expected 4 points");
}

TEST(VtkCounts, OffsetsDoNotGoBack) {
  expect_part(refused_vtk(with(with(vtk5, "CELLS 3 8", "CELLS 4 8"), "0 4 8", "0 6 4 8")), "the offset of cell 2 is 4");
  expect_part(refused_vtk(with(vtk5, "0 4 8", "1 4 8")), "the offset of cell 0 is 1");
}

TEST(VtkCounts, PointsAreListedOnce) {
  expect_part(refused_vtk(with(vtk4, "METADATA", "POINTS 1 double 2 2 2 METADATA")), "found POINTS again");
  expect_part(refused_vtk(with(vtk4, "CELL_TYPES 3", "CELLS 1 4 3 0 1 2 CELL_TYPES 3")), "found CELLS again");
}

TEST(VtuCounts, OffsetsDoNotGoBack) {
  expect_part(refused_vtu(with(with(vtu_ascii, "4 8<", "8 4<"), "10 10<", "12 10<")), "offset 1 is 4");
}

TEST(VtuCounts, AreThoseOfThePieceAndNoMore) {
  expect_part(refused_vtu(with(vtu_ascii, "4 8<", "4 8 8<")), "has 3 values; expected 2");
  expect_part(refused_vtu(with(vtu_ascii, "10 10<", "10 10 10<")), "has 3 values; expected 2");
  expect_part(refused_vtu(with(vtu_ascii, "1 2 3 4<", "1 2 3 4 0<")), "has 9 values; expected 8");
}

TEST(VtuCounts, OfPointsAreThreeCoordinates) {
  expect_part(refused_vtu(with(vtu_ascii, "NumberOfComponents=\"3\"", "NumberOfComponents=\"2\"")), "not 3 components");
}

// ---- values and tags of VTU

// One number whose highest bit is set, after the length of its bytes.
TEST(VtuValues, HaveTheSignOfTheirType) {
  for (const auto& [type, size, value] : {std::tuple{"UInt8", 1, 200ll},
                                          {"Int8", 1, -56ll},
                                          {"UInt16", 2, 60000ll},
                                          {"Int16", 2, -5536ll},
                                          {"UInt32", 4, 4000000000ll},
                                          {"Int32", 4, -294967296ll},
                                          {"Int64", 8, -2ll},
                                          {"UInt64", 8, 1ll << 62}}) {
    std::string bytes{static_cast<char>(size), 0, 0, 0};
    for (int k = 0; k < size; ++k) bytes += static_cast<char>(value >> (8 * k) & 0xff);
    const std::string text = encode_base64(bytes);
    const XmlElement tag{
        .name = "DataArray", .attributes = {{"type", type}, {"format", "binary"}}, .text = text, .text_line = 1};
    const VtuArray array{.tag = &tag, .name = "one"};
    EXPECT_EQ(integer_values(array, {}, "file"), std::vector<std::int64_t>{value}) << type;
    EXPECT_EQ(real_values(array, {}, "file"), std::vector<double>{static_cast<double>(value)}) << type;
  }
}

TEST(VtuTags, HaveEachAttributeOnce) {
  expect_part(refused_vtu(with(vtu_ascii, "type=\"UnstructuredGrid\"", "type=\"UnstructuredGrid\" type=\"PolyData\"")),
              "file:3: this is not XML: duplicate attribute");
}

TEST(VtuTags, InACommentAreNone) {
  expect_two_tetrahedra(
      parse_mesh(with(vtu_ascii, "<Points>", "<!-- <Piece> </Points> & < > --><Points>"), MeshFormat::vtu, "file"));
  expect_part(refused_vtu(with(vtu_ascii, "<Points>", "<!-- <Points>")),
              ": this is not XML: unclosed token; expected the end of <Piece>, begun in line 5");
}

// The examples of RFC 4648, section 10.
TEST(Base64, IsThatOfTheStandard) {
  for (const auto& [bytes, text] : {std::pair{"", ""},
                                    {"f", "Zg=="},
                                    {"fo", "Zm8="},
                                    {"foo", "Zm9v"},
                                    {"foob", "Zm9vYg=="},
                                    {"fooba", "Zm9vYmE="},
                                    {"foobar", "Zm9vYmFy"}}) {
    EXPECT_EQ(encode_base64(bytes), text);
    EXPECT_EQ(decode_base64(text), bytes);
  }
}

// ---- files

class MeshFiles : public FolderTest {};

TEST_F(MeshFiles, OfTetGenHaveNoMorePointsThanTheyAnnounce) {
  std::ofstream(folder_ / "a.node") << tetgen_node << "5 2 2 2 0.5 1\n";
  std::ofstream(folder_ / "a.ele") << tetgen_ele;
  try {
    read_mesh_file(folder_ / "a.node");
    FAIL();
  } catch (const IoError& error) {
    expect_part(error.what(), "'5' follows the last point");
  }
}

TEST_F(MeshFiles, MayEndTheirLinesInCarriageReturnsAlone) {
  std::string text(medit);
  std::ranges::replace(text, '\n', '\r');
  std::ofstream(folder_ / "a.mesh") << "# a comment\r" << text;
  expect_two_tetrahedra(read_mesh_file(folder_ / "a.mesh"));
  std::string points(tetgen_node), cells(tetgen_ele);
  std::ranges::replace(points, '\n', '\r');
  std::ranges::replace(cells, '\n', '\r');
  std::ofstream(folder_ / "b.node") << points;
  std::ofstream(folder_ / "b.ele") << cells;
  expect_two_tetrahedra(read_mesh_file(folder_ / "b.node"));
}

TEST_F(MeshFiles, AreNamedAsWhatStandsInTheirPlace) {
  using namespace std::string_view_literals;
  const std::tuple<std::string_view, std::string_view, std::string_view> others[] = {
      {"PK\x03\x04\x14\0\0\0"sv, "this is a ZIP archive", "the file in it: unpack it first"},
      {"\x1f\x8b\x08\0\0"sv, "this is compressed by gzip", "unpack it first"},
      {"BZh91AY&SY..."sv, "this is compressed by bzip2", "unpack it first"},
      {"\xfd\x37zXZ\0\0"sv, "this is compressed by xz", "unpack it first"},
      {"\x28\xb5\x2f\xfd\x04"sv, "this is compressed by Zstandard", "unpack it first"},
      {"7z\xbc\xaf\x27\x1c\0"sv, "this is a 7-Zip archive", "unpack it first"},
      {"Rar!\x1a\x07\x01"sv, "this is a RAR archive", "unpack it first"},
      {"version https://git-lfs.github.com/spec/v1\noid sha256:0\n"sv, "this is a pointer of Git LFS", "git lfs pull"},
      {"/annex/objects/SHA256E-s1--0.stl\n"sv, "this is a pointer of git-annex", "git annex get"},
      {"<!DOCTYPE html>\n<html>"sv, "this is a page of HTML", "the file itself"},
      {"<html>"sv, "this is a page of HTML", "the file itself"},
      {"\xff\xfe#\0 \0"sv, "this is text in UTF-16", "ASCII or UTF-8"}};
  for (const char* extension : {".stl", ".ply", ".msh", ".mesh", ".vtu", ".node"})
    for (const auto& [text, is, expected] : others) {
      const auto path = folder_ / (std::string("a") + extension);
      std::ofstream(path, std::ios::binary) << text;
      try {
        read_mesh_file(path);
        FAIL();
      } catch (const IoError& error) {
        expect_part(error.what(), path.string() + ": " + std::string(is) + "; expected ");
        expect_part(error.what(), expected);
      }
    }
}

// Cells are grouped by kind in the file: the kind and nodes of each are compared, in any order.
TEST_F(MeshFiles, OfEveryKindOfCellReadBackAsTheyWereWritten) {
  const auto cells = [](const Mesh& mesh) {
    std::vector<std::pair<CellKind, std::vector<std::uint32_t>>> all;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      const auto nodes = mesh.cell(c);
      all.emplace_back(mesh.kinds[c], std::vector<std::uint32_t>(nodes.begin(), nodes.end()));
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  int number = 0;
  for (const Mesh& mesh : {mixed_box(2, 2, 2, 0.5), hexahedron_box(2, 1, 1, 1.0), triangle_sheet(2, 2, 1.0),
                           quad_sheet(2, 2, 1.0), kuhn_box(1, 1, 1, 1.0)}) {
    const auto path = folder_ / (std::to_string(number++) + ".mesh");
    write_medit(path, mesh);
    const LoadedMesh again = read_mesh_file(path);
    EXPECT_TRUE(again.notices.empty());
    EXPECT_EQ(again.mesh.points, mesh.points);
    EXPECT_EQ(cells(again.mesh), cells(mesh));
  }
}

}  // namespace
}  // namespace dartboard::mesh_reading_test
