#include "core/meshes/formats/vtu_array.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <type_traits>

#include "core/meshes/text/base64.h"
#include "core/meshes/text/text_scanner.h"

namespace dartboard {
namespace {

static_assert(std::endian::native == std::endian::little, "binary arrays are copied as they are");

struct Source {
  const VtuArray& array;
  const VtuEncoding& encoding;
  const std::string& file;

  [[noreturn]] void fail(std::string_view found, std::string_view expected) const {
    fail_at(file, array.tag.line, fmt::format("<DataArray> {}: {}", in_quotes(array.name), found), expected);
  }
};

template <class T>
T load(std::string_view bytes, std::size_t at) {
  T value;
  std::memcpy(&value, bytes.data() + at, sizeof(T));
  return value;
}

/// The data of a binary array, without the length that stands before it.
std::string decode(const Source& source) {
  const VtuEncoding& encoding = source.encoding;
  if (!encoding.compressor.empty())
    source.fail(fmt::format("compressed with {}", in_quotes(encoding.compressor)), "uncompressed data, or ASCII");
  if (encoding.big_endian) source.fail("binary data in big-endian order", "little-endian order, or ASCII");
  auto bytes = decode_base64(source.array.text);
  if (!bytes) source.fail("malformed base64", "groups of four characters from A-Z a-z 0-9 + / and = at the end");
  const std::size_t header = encoding.header_bytes;
  if (bytes->size() < header)
    source.fail(fmt::format("{} bytes", bytes->size()), fmt::format("a header of {}", header));
  const std::uint64_t length = header == 4 ? load<std::uint32_t>(*bytes, 0) : load<std::uint64_t>(*bytes, 0);
  if (bytes->size() - header != length)
    source.fail(fmt::format("{} bytes of data", bytes->size() - header), fmt::format("{} as its header says", length));
  return bytes->substr(header);
}

template <class Stored, class Value>
std::vector<Value> convert(const Source& source, std::string_view bytes) {
  if (bytes.size() % sizeof(Stored) != 0)
    source.fail(fmt::format("{} bytes", bytes.size()), fmt::format("a multiple of {}", sizeof(Stored)));
  std::vector<Value> values;
  values.reserve(bytes.size() / sizeof(Stored));
  for (std::size_t at = 0; at < bytes.size(); at += sizeof(Stored)) {
    const Stored value = load<Stored>(bytes, at);
    if constexpr (std::is_floating_point_v<Stored>)
      if (!std::isfinite(value)) source.fail(fmt::format("value {} is {}", values.size(), value), "finite values");
    values.push_back(static_cast<Value>(value));
  }
  return values;
}

template <class Value>
std::vector<Value> convert(const Source& source, std::string_view type, std::string_view bytes) {
  if (type == "Int8") return convert<std::int8_t, Value>(source, bytes);
  if (type == "UInt8") return convert<std::uint8_t, Value>(source, bytes);
  if (type == "Int16") return convert<std::int16_t, Value>(source, bytes);
  if (type == "UInt16") return convert<std::uint16_t, Value>(source, bytes);
  if (type == "Int32") return convert<std::int32_t, Value>(source, bytes);
  if (type == "UInt32") return convert<std::uint32_t, Value>(source, bytes);
  if (type == "Int64") return convert<std::int64_t, Value>(source, bytes);
  if (type == "UInt64") return convert<std::uint64_t, Value>(source, bytes);
  if constexpr (std::is_same_v<Value, double>) {
    if (type == "Float32") return convert<float, Value>(source, bytes);
    if (type == "Float64") return convert<double, Value>(source, bytes);
    source.fail(fmt::format("type {}", in_quotes(type)), "Float32, Float64 or an integer type");
  }
  source.fail(fmt::format("type {}", in_quotes(type)), "an integer type, Int8 to UInt64");
}

template <class Value>
std::vector<Value> values_of(const Source& source) {
  const auto format = source.array.tag.attribute("format");
  if (format == "binary") {
    const std::string bytes = decode(source);
    return convert<Value>(source, source.array.tag.attribute("type").value_or(""), bytes);
  }
  if (format && format != "ascii")
    source.fail(fmt::format("format {}", in_quotes(*format)), "format 'ascii' or 'binary' (inline, not appended)");

  TextScanner scan(source.array.text, source.file, TextScanner::no_comment, source.array.text_line);
  const std::string what = fmt::format("<DataArray> {}: value", in_quotes(source.array.name));
  std::vector<Value> values;
  values.reserve(scan.plausible(source.array.text.size(), 4));
  while (!scan.at_end()) {
    const Wanted wanted{what, values.size()};
    if constexpr (std::is_same_v<Value, double>)
      values.push_back(scan.real(wanted));
    else
      values.push_back(scan.integer(wanted));
  }
  return values;
}

}  // namespace

std::vector<double> real_values(const VtuArray& array, const VtuEncoding& encoding, const std::string& file) {
  return values_of<double>({array, encoding, file});
}

std::vector<std::int64_t> integer_values(const VtuArray& array, const VtuEncoding& encoding, const std::string& file) {
  return values_of<std::int64_t>({array, encoding, file});
}

}  // namespace dartboard
