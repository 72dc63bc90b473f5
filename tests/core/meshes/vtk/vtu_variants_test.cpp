// VTU as VTK, ParaView and others write it: appended, compressed, with wide lengths, of either byte order. The bytes
// are put together by binary_mesh_samples.h, which shares with the reader nothing but the letters of base64.

#include <gtest/gtest.h>

#include "tests/support/meshes/binary_mesh_samples.h"
#include "tests/support/meshes/mesh_samples.h"

namespace dartboard::vtu_variants_test {
namespace {

using namespace samples;

std::string refused(std::string_view text) { return refusal(text, MeshFormat::vtu); }

/// The lengths at the head of a raw array, replaced by others of the same size.
std::string with_head(const VtuVariant& v, std::vector<std::uint64_t> head, std::size_t array_bytes) {
  std::vector<std::uint64_t> right{array_bytes};
  if (!v.compressor.empty()) right = {(array_bytes + v.block - 1) / v.block, v.block, array_bytes % v.block};
  return with(vtu(v), lengths(right, v), lengths(head, v));
}

TEST(VtuVariants, AllReadToTheSameBits) {
  for (const VtuVariant& v : vtu_variants()) {
    SCOPED_TRACE(v.encoding + " " + v.compressor + (v.wide ? " wide" : "") + (v.big_endian ? " big-endian" : ""));
    const LoadedMesh loaded = parse_mesh(vtu(v), MeshFormat::vtu, "file");
    expect_two_tetrahedra(loaded);
    ASSERT_EQ(loaded.tags.size(), 1u);
    EXPECT_EQ(loaded.tags[0].name, "material");
    EXPECT_EQ(loaded.tags[0].values, (std::vector<std::int32_t>{7, -3}));
  }
}

// Where the last block is as large as the others its own size is 0.
TEST(VtuVariants, LastBlocksMayBeFull) {
  for (const std::size_t block : {std::size_t{120}, std::size_t{8}, std::size_t{1000}})
    expect_two_tetrahedra(
        parse_mesh(vtu({.encoding = "raw", .compressor = "ZLib", .block = block}), MeshFormat::vtu, "file"));
}

TEST(VtuClaims, OfMoreBytesThanTheFileHasAreRefused) {
  constexpr std::uint64_t huge = std::uint64_t{1} << 60;
  const VtuVariant plain{.encoding = "raw", .wide = true};
  EXPECT_NE(with_head(plain, {huge}, 120), vtu(plain));
  expect_part(refused(with_head(plain, {huge}, 120)),
              "'Points': its header says 1152921504606846976 bytes, of at most");
  const VtuVariant packed{.encoding = "raw", .compressor = "ZLib", .wide = true};
  expect_part(refused(with_head(packed, {huge, 50, 20}, 120)), "'Points': its header says");
  for (const char* compressor : {"ZLib", "LZ4"}) {
    const VtuVariant v{.encoding = "raw", .compressor = compressor, .wide = true};
    expect_part(refused(with_head(v, {3, huge, 20}, 120)), "expected as many as its compressor needs at least");
  }
}

// Four bytes more than the length says, as a whole group of base64 after the last.
TEST(VtuClaims, OfFewerBytesThanAnArrayHasAreRefused) {
  const std::string types = stored("\x0a\x0a", {});
  expect_part(refused(with(vtu({}), types, types + "AAAA")), "'types': more data than its header says");
}

TEST(VtuClaims, OfAnotherSizeThanABlockHasAreRefused) {
  for (const char* compressor : {"ZLib", "LZ4"}) {
    const VtuVariant v{.encoding = "raw", .compressor = compressor};
    expect_part(refused(with_head(v, {3, 51, 20}, 120)), "block 0 does not decompress to 51 bytes");
    expect_part(refused(with_head(v, {3, 49, 20}, 120)), "block 0 does not decompress to 49 bytes");
    expect_part(refused(with_head(v, {3, 50, 51}, 120)), "a last block of 51 bytes; expected at most 50");
  }
}

TEST(VtuAppended, IsRefusedWhereItIsNotThere) {
  const std::string text = vtu({.encoding = "raw"});
  expect_part(refused(with(text, "\n_", "\n?")), "<AppendedData> does not begin with _");
  expect_part(refused(text.substr(0, text.find("</AppendedData>"))), "<AppendedData> has no end");
  expect_part(refused(with(text, "encoding=\"raw\"", "encoding=\"hex\"")), "<AppendedData> has the encoding 'hex'");
  expect_part(refused(with(text, "offset=\"0\"", "offset=\"99999\"")), "offset 99999; expected at most");
  expect_part(refused(with(text, "offset=\"0\"", "start=\"0\"")), "no offset");
  expect_part(refused(with(vtu_ascii, "format=\"ascii\">4", "format=\"appended\">4")),
              "file:18: <DataArray> 'offsets': appended data; expected <AppendedData> in the file");
}

TEST(VtuCompressor, IsOneOfTwo) {
  for (const std::string other : {"vtkLZMA", "vtkOther"})
    expect_part(
        refused(with(vtu({.compressor = "ZLib"}), "vtkZLib", other)),
        "compressed with '" + other + "DataCompressor'; expected vtkZLibDataCompressor or vtkLZ4DataCompressor");
}

TEST(VtuTagsOfCells, AreAsManyAsThereAreCells) {
  const std::string array = "<DataArray type=\"Int32\" Name=\"part\" format=\"ascii\">1 2 3</DataArray>";
  expect_part(refused(with(vtu({}), "<CellData>", "<CellData>" + array)), "'part' has 3 values; expected 2");
}

TEST(VtuTagsOfCells, ThatNeedMoreThan32BitsAreLeftOutWithANotice) {
  const std::string array = "<DataArray type=\"Int64\" Name=\"part\" format=\"ascii\">1 4294967296</DataArray>";
  const auto loaded = parse_mesh(with(vtu({}), "<CellData>", "<CellData>" + array), MeshFormat::vtu, "file");
  EXPECT_EQ(loaded.notices,
            (std::vector<std::string>{"left out 'part' of the cells: 4294967296 does not fit in 32 bits"}));
  EXPECT_EQ(loaded.tags.size(), 1u);
}

TEST(XmlText, HasNoDocumentType) {
  expect_part(refused(with(vtu_ascii, "<VTKFile", "<!DOCTYPE a [<!ENTITY b \"c\">]><VTKFile")),
              "found a document type; expected no document type");
}

}  // namespace
}  // namespace dartboard::vtu_variants_test
