#include <array>

#include "core/meshes/vtk/vtk_cells.h"
#include "core/meshes/vtk/vtk_formats.h"
#include "core/meshes/vtk/vtk_xml.h"

namespace dartboard {
namespace {

/// The lists of a piece, in the order in which data of cells count them, and the type of the cells in each.
struct List {
  std::string_view name, count;
  std::int64_t type;
};

constexpr List lists[] = {{"Verts", "NumberOfVerts", vtk_poly_vertex},
                          {"Lines", "NumberOfLines", vtk_poly_line},
                          {"Polys", "NumberOfPolys", vtk_polygon},
                          {"Strips", "NumberOfStrips", vtk_triangle_strip}};
constexpr std::array<std::string_view, 4> names{lists[0].name, lists[1].name, lists[2].name, lists[3].name};

void add_cells(const VtkXml& file, std::size_t number, const VtkPiece& piece, std::uint64_t first_point,
               MeshBuilder& builder) {
  VtkCellPlaces places;
  for (const List& list : lists) {
    // a piece without lines may lack their attribute
    if (!file.elements[number].attribute(list.count)) continue;
    const std::uint64_t count = file.count_attribute(file.elements[number], list.count);
    if (count == 0) continue;
    const VtkXmlCells cells = read_vtk_cells(file, piece, list.name, count);
    for (std::size_t c = 0; c < cells.offsets.size(); ++c) {
      places.mark(builder);
      add_vtk_cell(
          builder, list.type, cells.points(c),
          {.line = cells.line, .cell = places.count(), .first_point = first_point, .point_count = piece.points});
    }
  }
  places.mark(builder);
  if (places.count() != 0) tag_vtk_cells(file, piece, places, builder);
}

}  // namespace

std::string read_vtp(std::string_view text, MeshBuilder& builder) {
  const VtkXml file = read_vtk_xml(text, builder.cell_file(), "PolyData");
  for (const std::size_t number : file.pieces()) {
    const VtkPiece piece = find_vtk_piece(file, number, names);
    add_cells(file, number, piece, add_vtk_points(file, piece, builder), builder);
  }
  note_ghost_cells(builder);
  return "VTP";
}

}  // namespace dartboard
