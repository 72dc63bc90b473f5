#include "core/meshes/vtk/vtk_cells.h"
#include "core/meshes/vtk/vtk_formats.h"
#include "core/meshes/vtk/vtk_xml.h"

namespace dartboard {
namespace {

void add_cells(const VtkXml& file, const VtkPiece& piece, std::uint64_t count, std::uint64_t first_point,
               MeshBuilder& builder) {
  const VtkXmlCells cells = read_vtk_cells(file, piece, count);
  const auto types = read_vtk_integers(file, piece.array("Cells", "types", file), count);
  VtkCellPlaces places;
  for (std::size_t c = 0; c < types.size(); ++c) {
    places.mark(builder);
    add_vtk_cell(builder, types[c], cells.points(c),
                 {.line = cells.line, .cell = c, .first_point = first_point, .point_count = piece.points});
  }
  places.mark(builder);
  tag_vtk_cells(file, piece, places, builder);
}

}  // namespace

std::string read_vtu(std::string_view text, MeshBuilder& builder) {
  const VtkXml file = read_vtk_xml(text, builder.cell_file());
  for (const std::size_t number : file.pieces()) {
    const VtkPiece piece = find_vtk_piece(file, number);
    const std::uint64_t count = file.count_attribute(file.elements[number], "NumberOfCells");
    const std::uint64_t first_point = add_vtk_points(file, piece, builder);
    if (count != 0) add_cells(file, piece, count, first_point, builder);
  }
  note_ghost_cells(builder);
  return "VTU";
}

}  // namespace dartboard
