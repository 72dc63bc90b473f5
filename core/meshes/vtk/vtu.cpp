#include <algorithm>
#include <array>
#include <optional>

#include "core/meshes/vtk/vtk_cells.h"
#include "core/meshes/vtk/vtk_formats.h"
#include "core/meshes/vtk/vtk_xml.h"

namespace dartboard {
namespace {

constexpr std::array<std::string_view, 1> lists{"Cells"};

/// Of each cell whether it is a copy of a cell of another piece. VTK says it in bits of which the lowest is that of
/// copies, and said it in layers before version 7.
std::vector<bool> find_copies(const VtkXml& file, VtkPiece& piece, std::uint64_t count) {
  std::vector<bool> is_copy(count, false);
  std::erase_if(piece.tags, [&](const VtuArray& array) {
    const bool are_bits = array.name == "vtkGhostType", are_layers = array.name == "vtkGhostLevels";
    if (!are_bits && !are_layers) return false;
    const auto values = read_vtk_integers(file, array, count);
    for (std::size_t c = 0; c < values.size(); ++c)
      if (are_layers ? values[c] > 0 : values[c] % 2 != 0) is_copy[c] = true;
    return true;
  });
  return is_copy;
}

std::size_t add_cells(const VtkXml& file, VtkPiece& piece, std::uint64_t count, std::uint64_t first_point,
                      GhostCells ghosts, MeshBuilder& builder) {
  const VtkXmlCells cells = read_vtk_cells(file, piece, "Cells", count);
  const auto types = read_vtk_integers(file, piece.array("Cells", "types", file), count);
  std::vector<bool> is_left_out(types.size(), false);
  if (ghosts == GhostCells::left_out) is_left_out = find_copies(file, piece, types.size());
  VtkCellPlaces places;
  for (std::size_t c = 0; c < types.size(); ++c) {
    places.mark(builder);
    if (is_left_out[c]) continue;
    add_vtk_cell(builder, types[c], cells.points(c),
                 {.line = cells.line, .cell = c, .first_point = first_point, .point_count = piece.points});
  }
  places.mark(builder);
  tag_vtk_cells(file, piece, places, builder);
  return static_cast<std::size_t>(std::ranges::count(is_left_out, true));
}

}  // namespace

std::size_t add_vtu(std::string_view text, GhostCells ghosts, MeshBuilder& builder) {
  const std::string name = builder.cell_file();
  const VtkXml file = read_vtk_xml(text, name, "UnstructuredGrid");
  std::size_t left_out = 0;
  for (const std::size_t number : file.pieces()) {
    VtkPiece piece = find_vtk_piece(file, number, lists);
    const std::uint64_t count = file.count_attribute(file.elements[number], "NumberOfCells");
    const std::uint64_t first_point = add_vtk_points(file, piece, builder);
    if (count != 0) left_out += add_cells(file, piece, count, first_point, ghosts, builder);
  }
  return left_out;
}

std::string read_vtu(std::string_view text, MeshBuilder& builder) {
  add_vtu(text, GhostCells::read, builder);
  return "VTU";
}

}  // namespace dartboard
