#pragma once
// The square of binary_mesh_samples.h as polygon data of VTK: a vertex, a line, a triangle and a strip of one, with the
// numbers 1, 2, 7 and -3.

#include <string>
#include <string_view>

#include "tests/support/meshes/binary_mesh_samples.h"

namespace dartboard::samples {

inline constexpr std::string_view vtk_polygons = R"(# vtk DataFile Version 4.2
a square
ASCII
DATASET POLYDATA
POINTS 4 double
0 0 0 1 0 0
1 1 0 0 1 0
METADATA
INFORMATION 0

VERTICES 1 2
1 3
LINES 1 4
3 0 1 3
TRIANGLE_STRIPS 1 4
3 0 2 3
POLYGONS 1 4
3 0 1 2
CELL_DATA 4
SCALARS material int 1
LOOKUP_TABLE default
1 2 7 -3
)";

inline std::string vtk_polygons_binary(bool has_offsets) {
  const auto list = [&](const std::string& keyword, const std::vector<std::int32_t>& points) {
    const auto size = static_cast<std::int32_t>(points.size());
    if (has_offsets)
      return keyword + " 2 " + std::to_string(size) + "\nOFFSETS vtktypeint64\n" +
             bytes_of<std::int64_t>({0, size}, true) + "\nCONNECTIVITY vtktypeint64\n" +
             bytes_of(std::vector<std::int64_t>(points.begin(), points.end()), true) + "\n";
    return keyword + " 1 " + std::to_string(size + 1) + "\n" + bytes_of<std::int32_t>({size}, true) +
           bytes_of(points, true) + "\n";
  };
  return std::string("# vtk DataFile Version ") + (has_offsets ? "5.1" : "4.2") +
         "\na square\nBINARY\nDATASET POLYDATA\nPOINTS 4 double\n" +
         bytes_of<double>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, true) + "\n" + list("VERTICES", {3}) +
         list("LINES", {0, 1, 3}) + list("POLYGONS", {0, 1, 2}) + list("TRIANGLE_STRIPS", {0, 2, 3}) +
         "CELL_DATA 4\nFIELD FieldData 1\nmaterial 1 4 int\n" + bytes_of<std::int32_t>({1, 2, 7, -3}, true) + "\n";
}

}  // namespace dartboard::samples
