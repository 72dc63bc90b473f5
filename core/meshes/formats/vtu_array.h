#pragma once
// The numbers of a <DataArray> of an XML VTK file.

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "core/meshes/text/xml_scanner.h"

namespace dartboard {

/// What <VTKFile> says about all binary arrays of its file.
struct VtuEncoding {
  bool big_endian = false;
  std::size_t header_bytes = 4;
  std::string compressor;  // empty for none
};

struct VtuArray {
  XmlTag tag;
  std::string name;  // as in errors: "Points" for the one that has no name of its own
  std::string_view text;
  std::size_t text_line = 0;
};

/// All values of an ASCII or inline base64 array.
///
/// throws  IoError for another format, compressed or big-endian binary data, malformed data, and values that are not
///         finite; for integers, when the array is of a floating-point type
std::vector<double> real_values(const VtuArray& array, const VtuEncoding& encoding, const std::string& file);
std::vector<std::int64_t> integer_values(const VtuArray& array, const VtuEncoding& encoding, const std::string& file);

}  // namespace dartboard
