#pragma once
// The two tetrahedra of mesh_samples.h as bytes: every variant of VTU, binary legacy VTK and Gmsh; and a square of two
// triangles in the formats of surfaces. Cells have the numbers 7 and -3 where the format has a place for them.

#include <lz4.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "core/meshes/text/base64.h"

namespace dartboard::samples {

inline const std::vector<double> coordinates{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};

/// Numbers as bytes, on a little-endian machine: the last byte first.
template <class T>
std::string bytes_of(const std::vector<T>& values, bool big_endian = false) {
  std::string bytes;
  for (const T& value : values) {
    char stored[sizeof(T)];
    std::memcpy(stored, &value, sizeof(T));
    if (big_endian) std::reverse(stored, stored + sizeof(T));
    bytes.append(stored, sizeof(T));
  }
  return bytes;
}

// ---- VTU

struct VtuVariant {
  std::string encoding = "inline";  // or raw, base64: appended
  std::string compressor = {};      // ZLib, LZ4
  bool wide = false, big_endian = false;
  std::size_t block = 50;  // bytes that are compressed together
};

inline std::string compressed(const std::string& bytes, const std::string& compressor) {
  std::string out(bytes.size() + 1000, '\0');
  if (compressor == "ZLib") {
    uLongf size = out.size();
    compress2(reinterpret_cast<unsigned char*>(out.data()), &size, reinterpret_cast<const unsigned char*>(bytes.data()),
              bytes.size(), 6);
    out.resize(size);
  } else {
    out.resize(static_cast<std::size_t>(
        LZ4_compress_default(bytes.data(), out.data(), static_cast<int>(bytes.size()), static_cast<int>(out.size()))));
  }
  return out;
}

inline std::string lengths(const std::vector<std::uint64_t>& values, const VtuVariant& v) {
  if (v.wide) return bytes_of(values, v.big_endian);
  return bytes_of(std::vector<std::uint32_t>(values.begin(), values.end()), v.big_endian);
}

/// An array as VTK stores it: its length and itself; or, compressed, the number of blocks, their size, the size of a
/// smaller last one, their compressed sizes, and the blocks.
inline std::string stored(const std::string& bytes, const VtuVariant& v) {
  const bool is_raw = v.encoding == "raw";
  if (v.compressor.empty()) {
    const std::string all = lengths({bytes.size()}, v) + bytes;
    return is_raw ? all : encode_base64(all);
  }
  std::vector<std::uint64_t> head{(bytes.size() + v.block - 1) / v.block, v.block, bytes.size() % v.block};
  std::string blocks;
  for (std::size_t at = 0; at < bytes.size(); at += v.block) {
    const std::string block = compressed(bytes.substr(at, v.block), v.compressor);
    head.push_back(block.size());
    blocks += block;
  }
  return is_raw ? lengths(head, v) + blocks : encode_base64(lengths(head, v)) + encode_base64(blocks);
}

inline std::string vtu(const VtuVariant& v) {
  std::string appended;
  const auto array = [&](const std::string& attributes, const std::string& bytes) {
    const std::string data = stored(bytes, v), tag = "<DataArray " + attributes;
    if (v.encoding == "inline") return tag + " format=\"binary\">\n" + data + "\n</DataArray>\n";
    const std::string offset = std::to_string(appended.size());
    appended += data;
    return tag + " format=\"appended\" offset=\"" + offset + "\"/>\n";
  };
  const std::string compressor = v.compressor.empty() ? "" : " compressor=\"vtk" + v.compressor + "DataCompressor\"";
  std::string text = std::string("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\"") +
                     " byte_order=\"" + (v.big_endian ? "BigEndian" : "LittleEndian") + "\" header_type=\"" +
                     (v.wide ? "UInt64" : "UInt32") + "\"" + compressor +
                     ">\n<UnstructuredGrid>\n<Piece NumberOfPoints=\"5\" NumberOfCells=\"2\">\n<CellData>\n";
  text += array("type=\"Int32\" Name=\"material\"", bytes_of<std::int32_t>({7, -3}, v.big_endian));
  text += array("type=\"Float32\" Name=\"result\"", bytes_of<float>({0.5f, 1.5f}, v.big_endian));
  text += "</CellData>\n<Points>\n";
  text += array("type=\"Float64\" NumberOfComponents=\"3\" Name=\"Points\"", bytes_of(coordinates, v.big_endian));
  text += "</Points>\n<Cells>\n";
  text += array("type=\"Int64\" Name=\"connectivity\"", bytes_of<std::int64_t>({0, 1, 2, 3, 1, 2, 3, 4}, v.big_endian));
  text += array("type=\"Int64\" Name=\"offsets\"", bytes_of<std::int64_t>({4, 8}, v.big_endian));
  text += array("type=\"UInt8\" Name=\"types\"", "\x0a\x0a");
  text += "</Cells>\n</Piece>\n</UnstructuredGrid>\n";
  if (v.encoding != "inline")
    text += "<AppendedData encoding=\"" + v.encoding + "\">\n_" + appended + "\n</AppendedData>\n";
  return text + "</VTKFile>\n";
}

inline std::vector<VtuVariant> vtu_variants() {
  std::vector<VtuVariant> variants;
  for (const char* encoding : {"inline", "raw", "base64"})
    for (const char* compressor : {"", "ZLib", "LZ4"})
      for (const bool wide : {false, true})
        for (const bool big_endian : {false, true})
          variants.push_back({.encoding = encoding, .compressor = compressor, .wide = wide, .big_endian = big_endian});
  return variants;
}

// ---- legacy VTK, which is always big-endian

inline std::string vtk_binary() {
  return "# vtk DataFile Version 3.0\ntwo tetrahedra\nBINARY\nDATASET UNSTRUCTURED_GRID\nFIELD FieldData 1\n"
         "TIME 1 1 double\n" +
         bytes_of<double>({0.25}, true) + "\nPOINTS 5 double\n" + bytes_of(coordinates, true) +
         "\nMETADATA\nINFORMATION 0\n\nCELLS 2 10\n" + bytes_of<std::int32_t>({4, 0, 1, 2, 3, 4, 1, 2, 3, 4}, true) +
         "\nCELL_TYPES 2\n" + bytes_of<std::int32_t>({10, 10}, true) + "\nPOINT_DATA 5\nVECTORS velocity float\n" +
         bytes_of(std::vector<float>(15, 1.0f), true) +
         "\nCELL_DATA 2\nSCALARS material short 1\nLOOKUP_TABLE default\n" + bytes_of<std::int16_t>({7, -3}, true) +
         "\n";
}

inline std::string vtk_binary_offsets() {
  return "# vtk DataFile Version 5.1\ntwo tetrahedra\nBINARY\nDATASET UNSTRUCTURED_GRID\nPOINTS 5 float\n" +
         bytes_of(std::vector<float>(coordinates.begin(), coordinates.end()), true) +
         "\nCELLS 3 8\nOFFSETS vtktypeint64\n" + bytes_of<std::int64_t>({0, 4, 8}, true) +
         "\nCONNECTIVITY vtktypeint64\n" + bytes_of<std::int64_t>({0, 1, 2, 3, 1, 2, 3, 4}, true) + "\nCELL_TYPES 2\n" +
         bytes_of<std::int32_t>({10, 10}, true) + "\nCELL_DATA 2\nFIELD FieldData 1\nmaterial 1 2 int\n" +
         bytes_of<std::int32_t>({7, -3}, true) + "\nMETADATA\nINFORMATION 0\n\n";
}

// ---- Gmsh

inline std::string gmsh2_binary(bool big_endian) {
  const auto ints = [&](const std::vector<std::int32_t>& values) { return bytes_of(values, big_endian); };
  std::string nodes;
  for (int k = 0; k < 5; ++k)
    nodes += ints({k + 1}) +
             bytes_of(std::vector<double>(coordinates.begin() + 3 * k, coordinates.begin() + 3 * k + 3), big_endian);
  return "$MeshFormat\n2.2 1 8\n" + ints({1}) +
         "\n$EndMeshFormat\n$PhysicalNames\n2\n2 7 \"skin\"\n3 7 \"the body\"\n$EndPhysicalNames\n$Nodes\n5\n" + nodes +
         "\n$EndNodes\n$Elements\n3\n" + ints({2, 1, 2, 1, 7, 1, 1, 2, 3}) +
         ints({4, 2, 2, 2, 7, 1, 1, 2, 3, 4, 3, 8, 1, 2, 3, 4, 5}) + "\n$EndElements\n";
}

inline std::string gmsh41_binary() {
  const auto ints = [](const std::vector<std::int32_t>& values) { return bytes_of(values); };
  const auto sizes = [](const std::vector<std::uint64_t>& values) { return bytes_of(values); };
  const std::string box = bytes_of<double>({0, 0, 0, 1, 1, 1});
  return "$MeshFormat\n4.1 1 8\n" + ints({1}) +
         "\n$EndMeshFormat\n$PhysicalNames\n1\n3 7 \"the body\"\n$EndPhysicalNames\n$Entities\n" + sizes({1, 0, 1, 2}) +
         ints({1}) + box.substr(0, 24) + sizes({0}) +                             // a point
         ints({1}) + box + sizes({1}) + ints({5}) + sizes({0}) +                  // a surface
         ints({1}) + box + sizes({1}) + ints({7}) + sizes({1}) + ints({1}) +      // volumes
         ints({2}) + box + sizes({2}) + ints({-8, 7}) + sizes({1}) + ints({1}) +  //
         "\n$EndEntities\n$Periodic\n" + sizes({0, 0, 0}) + "\n$EndPeriodic\n$Nodes\n" + sizes({2, 5, 1, 5}) +
         ints({2, 1, 1}) + sizes({2, 1, 2}) + bytes_of<double>({0, 0, 0, .25, .75, 1, 0, 0, .5, .5}) + ints({3, 1, 0}) +
         sizes({3, 3, 4, 5}) + bytes_of<double>({0, 1, 0, 0, 0, 1, 1, 1, 1}) + "\n$EndNodes\n$Elements\n" +
         sizes({3, 3, 1, 3}) + ints({2, 1, 2}) + sizes({1, 1, 1, 2, 3}) + ints({3, 1, 4}) + sizes({1, 2, 1, 2, 3, 4}) +
         ints({3, 2, 4}) + sizes({1, 3, 2, 3, 4, 5}) + "\n$EndElements\n";
}

// ---- surfaces: the square of the points 0, x, x + y and y, in two triangles

inline const std::vector<std::vector<float>> square_facets{{0, 0, 0, 1, 0, 0, 1, 1, 0}, {0, 0, 0, 1, 1, 0, 0, 1, 0}};

inline std::string stl_binary() {
  std::string out(80, ' ');
  out.replace(0, 5, "solid");  // as some writers begin
  out += bytes_of<std::uint32_t>({2});
  for (const auto& facet : square_facets)
    out += bytes_of<float>({0, 0, 1}) + bytes_of(facet) + bytes_of<std::uint16_t>({0});
  return out;
}

inline constexpr std::string_view stl_text = R"(solid lower half
facet normal 0 0 1
  outer loop
    vertex 0 0 0
    vertex 1 0 0
    vertex 1 1 0
  endloop
endfacet
endsolid lower half
solid
facet normal nan 0 1
  outer loop
    vertex 0 -0.0 0
    vertex 1 1 0
    vertex 0 1 0
  endloop
endfacet
endsolid
)";

inline constexpr std::string_view obj = R"(# a square
mtllib none.mtl
v 0 0 0
v 1 0 0 1.0
v 1 1 0
v 0 1 0 0.5 0.5 0.5
vn 0 0 1
vt 0 0
g left side
usemtl wood
f 1/1/1 2//1 3
usemtl steel
f -4 \
  -2 -1
l 1 2
)";

inline constexpr std::string_view off = R"(OFF
# a square
4 2 0
0 0 0
1 0 0
1 1 0
0 1 0
3 0 1 2 255 0 0
3 0 2 3
)";

/// Big-endian numbers of 32 bits; each point has an opacity and a colour, the second polygon a colour.
inline std::string off_binary(std::string_view word = "COFF") {
  const auto ints = [](const std::vector<std::int32_t>& values) { return bytes_of(values, true); };
  const auto reals = [](const std::vector<float>& values) { return bytes_of(values, true); };
  std::string out = std::string(word) + " BINARY\n" + ints({4, 2, 0});
  for (const auto& [x, y] : {std::pair{0.0f, 0.0f}, {1.0f, 0.0f}, {1.0f, 1.0f}, {0.0f, 1.0f}})
    out += reals({x, y, 0.0f}) + (word == "COFF" ? reals({0.25f, 0.5f, 0.75f, 1.0f}) : "");
  return out + ints({3, 0, 1, 2, 0, 3, 0, 2, 3, 3}) + reals({0.25f, 0.5f, 0.75f});
}

inline constexpr std::string_view ply_text = R"(ply
format ascii 1.0
comment a square
element vertex 4
property float x
property float y
property float z
property uchar red
element face 2
property list uchar int vertex_indices
property float quality
element edge 1
property int vertex1
property int vertex2
end_header
0 0 0 255
1 0 0 255
1 1 0 255
0 1 0 255
3 0 1 2 0.5
3 0 2 3 nan
0 1
)";

inline std::string ply_binary(bool big_endian) {
  const auto part = [&](auto value) { return bytes_of(std::vector{value}, big_endian); };
  std::string out = std::string("ply\nformat binary_") + (big_endian ? "big" : "little") +
                    "_endian 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty uchar red\n"
                    "property float z\nelement face 2\nproperty list ushort uint vertex_index\nend_header\n";
  for (const auto& [x, y] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
    out += part(x) + part(y) + "\xff" + part(0.0f);
  for (const auto& [b, c] : {std::pair{1u, 2u}, {2u, 3u}}) out += part(std::uint16_t{3}) + part(0u) + part(b) + part(c);
  return out;
}

}  // namespace dartboard::samples
