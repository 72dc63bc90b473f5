#pragma once
// The square of binary_mesh_samples.h as polygon data of VTK: a vertex, a line, a triangle and a strip of one, with the
// numbers 1, 2, 7 and -3.

#include <string>
#include <string_view>

#include "tests/support/meshes/binary_mesh_samples.h"

namespace dartboard::samples {

inline constexpr std::string_view vtp_ascii = R"(<?xml version="1.0"?>
<VTKFile type="PolyData" version="0.1" byte_order="LittleEndian">
  <PolyData>
    <Piece NumberOfPoints="4" NumberOfVerts="1" NumberOfLines="1" NumberOfStrips="1" NumberOfPolys="1">
      <CellData>
        <DataArray type="Int32" Name="material" format="ascii">1 2 7 -3</DataArray>
      </CellData>
      <Points>
        <DataArray type="Float32" Name="Points" NumberOfComponents="3" format="ascii">
          0 0 0 1 0 0 1 1 0 0 1 0
        </DataArray>
      </Points>
      <Verts>
        <DataArray type="Int64" Name="connectivity" format="ascii">3</DataArray>
        <DataArray type="Int64" Name="offsets" format="ascii">1</DataArray>
      </Verts>
      <Lines>
        <DataArray type="Int64" Name="connectivity" format="ascii">0 1 3</DataArray>
        <DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>
      </Lines>
      <Strips>
        <DataArray type="Int64" Name="connectivity" format="ascii">0 2 3</DataArray>
        <DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>
      </Strips>
      <Polys>
        <DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
        <DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>
      </Polys>
    </Piece>
  </PolyData>
</VTKFile>
)";

inline std::string vtp(const VtuVariant& v) {
  const char* const counts =
      "NumberOfPoints=\"4\" NumberOfVerts=\"1\" NumberOfLines=\"1\" NumberOfStrips=\"1\" NumberOfPolys=\"1\"";
  return vtk_xml(v, "PolyData", counts, [&v](const auto& array) {
    const auto list = [&](const std::string& name, const std::vector<std::int64_t>& points) {
      const std::vector<std::int64_t> end{static_cast<std::int64_t>(points.size())};
      return "<" + name + ">\n" + array("type=\"Int64\" Name=\"connectivity\"", bytes_of(points, v.big_endian)) +
             array("type=\"Int64\" Name=\"offsets\"", bytes_of(end, v.big_endian)) + "</" + name + ">\n";
    };
    std::string text = "<CellData>\n";
    text += array("type=\"Int32\" Name=\"material\"", bytes_of<std::int32_t>({1, 2, 7, -3}, v.big_endian));
    text += "</CellData>\n<Points>\n";
    text += array("type=\"Float64\" NumberOfComponents=\"3\" Name=\"Points\"",
                  bytes_of<double>({0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, v.big_endian));
    text += "</Points>\n";
    // one after the other: the places of arrays in the appended data depend on it
    for (const auto& [name, points] : {std::pair{"Verts", std::vector<std::int64_t>{3}},
                                       {"Lines", {0, 1, 3}},
                                       {"Strips", {0, 2, 3}},
                                       {"Polys", {0, 1, 2}}})
      text += list(name, points);
    return text;
  });
}

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
