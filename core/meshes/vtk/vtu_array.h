#pragma once
// The numbers of a <DataArray> of an XML VTK file.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "core/meshes/bytes/scalar.h"
#include "core/meshes/text/xml_elements.h"

namespace dartboard {

/// The data after the underscore of <AppendedData>.
struct VtuAppended {
  std::string_view data;
  bool is_raw = false;  // false: base64
};

/// The properties that a file declares for all its binary arrays.
struct VtuEncoding {
  bool big_endian = false;
  std::size_t header_bytes = 4;
  std::string compressor = {};  // empty without compression
  std::optional<VtuAppended> appended = {};
};

struct VtuArray {
  const XmlElement* tag;
  std::string name;  // as in errors: "Points" for the one that has no name of its own
};

/// The type with this name in VTK, such as Float64.
std::optional<Scalar> scalar_of_vtu(std::string_view name);

/// All values of an array: ASCII, base64 or raw, inline or appended, compressed or not.
///
/// throws  IoError for malformed data, data that claim to be more than they can be, and values that are not finite; for
///         integers, when the array is of a floating-point type
std::vector<double> real_values(const VtuArray& array, const VtuEncoding& encoding, const std::string& file);
std::vector<std::int64_t> integer_values(const VtuArray& array, const VtuEncoding& encoding, const std::string& file);

}  // namespace dartboard
