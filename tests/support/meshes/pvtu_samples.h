#pragma once
// The two tetrahedra of mesh_samples.h, one in each of two files, and the file that names them.

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace dartboard::samples {

/// A tetrahedron on four points; `more` is added to the data of cells.
inline std::string vtu_piece(std::string_view points, std::string_view more = "") {
  return "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>\n"
         "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\">\n<CellData>" +
         std::string(more) +
         "</CellData>\n<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">" +
         std::string(points) +
         "</DataArray></Points>\n<Cells>\n"
         "<DataArray type=\"Int32\" Name=\"connectivity\" format=\"ascii\">0 1 2 3</DataArray>\n"
         "<DataArray type=\"Int32\" Name=\"offsets\" format=\"ascii\">4</DataArray>\n"
         "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">10</DataArray>\n"
         "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

inline std::string cell_array(const std::string& type, const std::string& name, const std::string& values) {
  return "<DataArray type=\"" + type + "\" Name=\"" + name + "\" format=\"ascii\">" + values + "</DataArray>";
}

inline constexpr std::string_view first_points = "0 0 0 1 0 0 0 1 0 0 0 1",
                                  second_points = "1 0 0 0 1 0 -0.0 0 1 1 1 1";

inline std::string pvtu(const std::string& first, const std::string& second) {
  return "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
         "<PUnstructuredGrid GhostLevel=\"0\">\n"
         "<PPoints><PDataArray type=\"Float64\" NumberOfComponents=\"3\"/></PPoints>\n"
         "<Piece Source=\"" +
         first + "\"/>\n<Piece Source=\"" + second + "\"/>\n</PUnstructuredGrid>\n</VTKFile>\n";
}

/// Write both pieces into a folder.
inline void write_pieces(const std::filesystem::path& folder, const std::string& first = vtu_piece(first_points),
                         const std::string& second = vtu_piece(second_points)) {
  std::ofstream(folder / "a.vtu") << first;
  std::ofstream(folder / "b.vtu") << second;
}

}  // namespace dartboard::samples
