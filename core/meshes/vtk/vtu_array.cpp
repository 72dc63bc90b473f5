#include "core/meshes/vtk/vtu_array.h"

#include <fmt/format.h>

#include <cmath>
#include <type_traits>

#include "core/meshes/text/text_scanner.h"
#include "core/meshes/vtk/vtu_bytes.h"

namespace dartboard {
namespace {

template <class Value>
Scalar type_of(const VtuArray& array, const std::string& file) {
  const std::string_view name = array.tag->attribute("type").value_or("");
  const auto type = scalar_of_vtu(name);
  constexpr bool may_be_real = std::is_same_v<Value, double>;
  if (!type || (!may_be_real && is_real(*type)))
    fail_in_array(array, file, fmt::format("type {}", in_quotes(name)),
                  may_be_real ? "Float32, Float64 or an integer type" : "an integer type, Int8 to UInt64");
  return *type;
}

template <class Value>
std::vector<Value> stored_values(const VtuArray& array, const VtuEncoding& encoding, const std::string& file) {
  const Scalar type = type_of<Value>(array, file);
  const std::string bytes = vtu_bytes(array, encoding, file);
  const std::size_t size = size_of(type);
  if (bytes.size() % size != 0)
    fail_in_array(array, file, fmt::format("{} bytes", bytes.size()), fmt::format("a multiple of {}", size));
  std::vector<Value> values;
  values.reserve(bytes.size() / size);
  for (std::size_t at = 0; at < bytes.size(); at += size) {
    const std::string_view stored(bytes.data() + at, size);
    if constexpr (std::is_same_v<Value, double>) {
      const double value = real_of(type, stored, encoding.big_endian);
      if (!std::isfinite(value))
        fail_in_array(array, file, fmt::format("value {} is {}", values.size(), value), "finite values");
      values.push_back(value);
    } else {
      values.push_back(integer_of(type, stored, encoding.big_endian));
    }
  }
  return values;
}

template <class Value>
std::vector<Value> values_of(const VtuArray& array, const VtuEncoding& encoding, const std::string& file) {
  const auto format = array.tag->attribute("format");
  if (format == "binary" || format == "appended") return stored_values<Value>(array, encoding, file);
  if (format && format != "ascii")
    fail_in_array(array, file, fmt::format("format {}", in_quotes(*format)), "format 'ascii', 'binary' or 'appended'");

  TextScanner scan(array.tag->text, file, TextScanner::no_comment, array.tag->text_line);
  const std::string what = fmt::format("<DataArray> {}: value", in_quotes(array.name));
  std::vector<Value> values;
  values.reserve(scan.plausible(array.tag->text.size(), 4));
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

std::optional<Scalar> scalar_of_vtu(std::string_view name) {
  if (name == "Int8") return Scalar::int8;
  if (name == "UInt8") return Scalar::uint8;
  if (name == "Int16") return Scalar::int16;
  if (name == "UInt16") return Scalar::uint16;
  if (name == "Int32") return Scalar::int32;
  if (name == "UInt32") return Scalar::uint32;
  if (name == "Int64") return Scalar::int64;
  if (name == "UInt64") return Scalar::uint64;
  if (name == "Float32") return Scalar::float32;
  if (name == "Float64") return Scalar::float64;
  return std::nullopt;
}

std::vector<double> real_values(const VtuArray& array, const VtuEncoding& encoding, const std::string& file) {
  return values_of<double>(array, encoding, file);
}

std::vector<std::int64_t> integer_values(const VtuArray& array, const VtuEncoding& encoding, const std::string& file) {
  return values_of<std::int64_t>(array, encoding, file);
}

}  // namespace dartboard
