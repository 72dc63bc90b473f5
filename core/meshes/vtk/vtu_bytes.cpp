#include "core/meshes/vtk/vtu_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/meshes/bytes/compressed_block.h"
#include "core/meshes/text/base64.h"
#include "core/meshes/text/text_scanner.h"

namespace dartboard {
namespace {

/// Bytes from a place on, raw or base64. The first of them give the number that belongs to the array.
class Stored {
 public:
  Stored(const VtuArray& array, const VtuEncoding& encoding, const std::string& file)
      : array_(array), encoding_(encoding), file_(file), base64_(array.tag->text) {
    if (array.tag->attribute("format") != "appended") return;
    if (!encoding.appended) fail("appended data", "<AppendedData> in the file");
    const VtuAppended& appended = *encoding.appended;
    const auto text = array.tag->attribute("offset");
    if (!text) fail("no offset", "offset=\"a number\" into <AppendedData>");
    TextScanner scan(*text, file, TextScanner::no_comment, array.tag->line);
    const std::uint64_t offset = scan.count("an offset into <AppendedData>");
    if (offset > appended.data.size())
      fail(fmt::format("offset {}", offset),
           fmt::format("at most {}, the size of <AppendedData>", appended.data.size()));
    const std::string_view data = appended.data.substr(static_cast<std::size_t>(offset));
    is_inline_ = false;
    is_raw_ = appended.is_raw;
    if (is_raw_)
      raw_ = data;
    else
      base64_ = Base64Reader(data);
  }

  /// Take `count` bytes; the number is checked before memory is allocated.
  std::string take(std::uint64_t count) {
    const std::size_t most = is_raw_ ? raw_.size() : base64_.most_left();
    if (count > most)
      fail(fmt::format("its header says {} bytes, of at most {} that are left", count, most), "all of its bytes");
    std::string bytes;
    if (is_raw_) {
      bytes = raw_.substr(0, static_cast<std::size_t>(count));
      raw_.remove_prefix(bytes.size());
    } else if (!base64_.take(static_cast<std::size_t>(count), bytes)) {
      fail("malformed or incomplete base64",
           fmt::format("{} bytes in groups of four characters from A-Z a-z 0-9 + / and = at the end", count));
    }
    return bytes;
  }

  /// A length, in the type that the file has for them.
  std::uint64_t length() {
    const std::string bytes = take(encoding_.header_bytes);
    return encoding_.header_bytes == 4 ? load<std::uint32_t>(bytes, encoding_.big_endian)
                                       : load<std::uint64_t>(bytes, encoding_.big_endian);
  }

  /// An inline array has nothing after its last byte.
  void finish() {
    if (is_inline_ && !base64_.at_end()) fail("more data than its header says", "as many bytes as it says");
  }

  [[noreturn]] void fail(std::string_view found, std::string_view expected) const {
    fail_in_array(array_, file_, found, expected);
  }

 private:
  const VtuArray& array_;
  const VtuEncoding& encoding_;
  const std::string& file_;
  bool is_inline_ = true, is_raw_ = false;
  Base64Reader base64_;
  std::string_view raw_ = {};
};

/// The number of blocks, their size, that of a smaller last one, and the compressed size of each; then the blocks.
std::string read_blocks(Stored& stored, const VtuEncoding& encoding) {
  const auto compressor = compressor_of_vtk(encoding.compressor);
  if (!compressor)
    stored.fail(fmt::format("compressed with {}", in_quotes(encoding.compressor)),
                "vtkZLibDataCompressor or vtkLZ4DataCompressor");
  const std::uint64_t count = stored.length();
  if (count == 0) return {};
  const std::uint64_t size = stored.length(), last = stored.length();
  if (last > size) stored.fail(fmt::format("a last block of {} bytes", last), fmt::format("at most {}", size));
  std::vector<std::uint64_t> compressed;  // grows with the bytes present, not with the number declared
  for (std::uint64_t k = 0; k < count; ++k) compressed.push_back(stored.length());
  std::string bytes;
  for (std::uint64_t k = 0; k < count; ++k) {
    const std::uint64_t expected = k + 1 == count && last != 0 ? last : size;
    const std::string block = stored.take(compressed[k]);
    if (expected > largest_expansion(*compressor, block.size()))
      stored.fail(fmt::format("block {} has {} bytes for {}", k, block.size(), expected),
                  "as many as its compressor needs at least");
    if (!decompress(*compressor, block, static_cast<std::size_t>(expected), bytes))
      stored.fail(fmt::format("block {} does not decompress to {} bytes", k, expected),
                  fmt::format("data of {}", encoding.compressor));
  }
  stored.finish();
  return bytes;
}

}  // namespace

void fail_in_array(const VtuArray& array, const std::string& file, std::string_view found, std::string_view expected) {
  fail_at(file, array.tag->line, fmt::format("<DataArray> {}: {}", in_quotes(array.name), found), expected);
}

std::string vtu_bytes(const VtuArray& array, const VtuEncoding& encoding, const std::string& file) {
  Stored stored(array, encoding, file);
  if (!encoding.compressor.empty()) return read_blocks(stored, encoding);
  std::string bytes = stored.take(stored.length());
  stored.finish();
  return bytes;
}

}  // namespace dartboard
