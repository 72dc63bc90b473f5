#pragma once
// The bytes of a binary <DataArray>: found, decoded and decompressed.

#include <string>

#include "core/meshes/vtk/vtu_array.h"

namespace dartboard {

/// Throw IoError with the line and the name of an array.
[[noreturn]] void fail_in_array(const VtuArray& array, const std::string& file, std::string_view found,
                                std::string_view expected);

/// The data of an array whose format is "binary" or "appended", without their header.
std::string vtu_bytes(const VtuArray& array, const VtuEncoding& encoding, const std::string& file);

}  // namespace dartboard
