#include <gtest/gtest.h>

#include "core/meshes/text/base64.h"
#include "tests/support/meshes/mesh_samples.h"

namespace dartboard::vtu_test {
namespace {

using namespace samples;

LoadedMesh parse(std::string_view text) { return parse_mesh(text, MeshFormat::vtu, "file"); }
std::string refused(std::string_view text) { return refusal(text, MeshFormat::vtu); }

TEST(Vtu, ReadsAsciiWhateverItsByteOrder) {
  const LoadedMesh loaded = parse(vtu_ascii);
  expect_two_tetrahedra(loaded);
  EXPECT_EQ(loaded.format, "VTU");
  EXPECT_TRUE(loaded.notices.empty());
}

TEST(Vtu, ReadsInlineBase64WithNarrowHeaders) { expect_two_tetrahedra(parse(vtu_base64)); }

TEST(Vtu, ReadsInlineBase64WithWideHeadersEncodedOnTheirOwn) { expect_two_tetrahedra(parse(vtu_base64_wide)); }

TEST(Vtu, PutsPiecesOneAfterTheOther) {
  const std::string one(vtu_ascii);
  const auto begin = one.find("<Piece"), end = one.find("</Piece>") + 8;
  const std::string other = with(one.substr(begin, end - begin), "0 0 0", "0 0 -1");
  const auto loaded = parse(one.substr(0, end) + other + one.substr(end));
  EXPECT_EQ(loaded.mesh.points.size(), 10u);
  EXPECT_EQ(loaded.mesh.cell_count(), 4u);
  ASSERT_EQ(loaded.notices.size(), 1u);
  expect_part(loaded.notices[0], "4 points coincide with another one");
}

TEST(Vtu, RefusesAFileWithoutPieces) {
  expect_part(refused("<VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid/></VTKFile>"),
              "the file has no <Piece>; expected <UnstructuredGrid> with a <Piece>");
}

TEST(Vtu, RefusesAnotherKindOfFile) {
  for (const std::string type : {"ImageData", "PolyData", "PUnstructuredGrid"})
    expect_part(refused(with(vtu_ascii, "\"UnstructuredGrid\"", "\"" + type + "\"")),
                "file:3: found <'VTKFile'> of type '" + type + "'; expected <VTKFile type=\"UnstructuredGrid\">");
  expect_part(refused("not xml at all"), "file:1: this is not XML: syntax error");
}

TEST(Vtu, NamesArrayAndLineOfABadValue) {
  EXPECT_EQ(refused(with(vtu_ascii, "0 1 0\n", "0 nan 0\n")),
            "file:11: 'nan' is not finite; expected <DataArray> 'Points': value 7");
  expect_part(refused(with(vtu_ascii, "4 8<", "4 8.5<")), "file:18: '8.5' is not an integer");
  expect_part(refused(with(vtu_base64_wide, "AADwPw", "AAD4fw")), "<DataArray> 'Points': value 7 is nan");
}

TEST(Vtu, RefusesMalformedBase64) {
  expect_part(refused(with(vtu_base64, "format=\"binary\">", "format=\"binary\">*")), "malformed or incomplete base64");
  expect_part(refused(with(vtu_base64, "format=\"binary\">", "format=\"binary\">AAAA")),
              "its header says 1006632960 bytes");
}

TEST(Vtu, RefusesArraysThatAreMissingOrOfTheWrongSize) {
  expect_part(refused(with(vtu_ascii, "\"types\"", "\"tapes\"")), "the <Piece> has no <DataArray> 'types'");
  expect_part(refused(with(vtu_ascii, "NumberOfPoints=\"5\"", "NumberOfPoints=\"4000000000\"")), "has 15 values");
  expect_part(refused(with(vtu_ascii, "NumberOfCells=\"2\"", "NumberOfCells=\"3\"")), "has 2 values; expected 3");
  expect_part(refused(with(vtu_ascii, "4 8<", "4 7<")), "'connectivity' has 8 values; expected 7");
  expect_part(refused(with(vtu_ascii, "4 8<", "9 8<")), "offset 0 is 9");
}

TEST(Vtu, NamesAPointOutOfRange) {
  expect_part(refused(with(vtu_ascii, "1 2 3 4<", "1 2 3 9<")), "file:17: cell 1 has the point 9");
}

TEST(Vtu, RefusesTagsThatDoNotNest) {
  expect_part(refused(with(vtu_ascii, "</Points>", "</Cells>")),
              "file:15: this is not XML: mismatched tag; expected the end of <Points>, begun in line 7");
  expect_part(refused(vtu_ascii.substr(0, vtu_ascii.find("</UnstructuredGrid>"))),
              "expected the end of <UnstructuredGrid>, begun in line 4");
}

TEST(Base64, DecodesEveryLengthOfTheLastGroup) {
  EXPECT_EQ(decode_base64(""), "");
  EXPECT_EQ(decode_base64("YQ=="), "a");
  EXPECT_EQ(decode_base64(" Y W I = "), "ab");
  EXPECT_EQ(decode_base64("YWJj"), "abc");
  EXPECT_EQ(decode_base64("YQ==YWJj"), "aabc");
}

TEST(Base64, RefusesIncompleteGroupsAndStrayPadding) {
  for (const char* bad : {"Y", "YWJ", "Y===", "YQ=a", "====", "YW-j"}) EXPECT_FALSE(decode_base64(bad)) << bad;
}

// Blank and padding at any place, and bytes taken in pieces of any size.
TEST(Base64, IsTheSameInPiecesAndWithBlanks) {
  std::string bytes;
  for (int k = 0; k < 100; ++k) bytes.push_back(static_cast<char>(k * 37 + k / 7));
  const std::string plain = encode_base64(bytes);
  for (std::size_t at = 0; at <= plain.size(); ++at) {
    std::string text = plain;
    text.insert(at, at % 2 == 0 ? " " : "\n\n");
    EXPECT_EQ(decode_base64(text), bytes) << at;
    for (const std::size_t piece : {1u, 2u, 3u, 7u, 12u, 100u}) {
      Base64Reader reader(text);
      std::string taken = "x";
      for (std::size_t left = bytes.size(); left > 0; left -= std::min(piece, left))
        ASSERT_TRUE(reader.take(std::min(piece, left), taken));
      EXPECT_EQ(taken, "x" + bytes) << at << " " << piece;
      EXPECT_TRUE(reader.at_end());
    }
    if (at == plain.size()) continue;
    text = plain;
    text[at] = '*';
    Base64Reader reader(text);
    std::string taken;
    EXPECT_FALSE(reader.take(bytes.size(), taken));
    EXPECT_EQ(taken, bytes.substr(0, at / 4 * 3));
  }
}

}  // namespace
}  // namespace dartboard::vtu_test
