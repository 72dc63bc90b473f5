#pragma once
// The cell types of VTK, for its legacy and its XML files.

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "core/meshes/formats/mesh_builder.h"

namespace dartboard {

/// The line of a cell, and the points that it may use: 0 .. point_count-1, numbered from first_point in the builder.
struct VtkPlace {
  std::size_t line;
  std::uint64_t cell;
  std::uint64_t first_point;
  std::uint64_t point_count;
};

/// VTK's numbers of the types that its polygon data is made of.
inline constexpr std::int64_t vtk_poly_vertex = 2, vtk_poly_line = 4, vtk_triangle_strip = 6, vtk_polygon = 7;

/// Add one cell of VTK's type number, by its corners; a strip is added as its triangles. Pixels and voxels become
/// quadrilaterals and hexahedra, and prisms of first order are mirrored: VTK documents them with the first triangle
/// turned outward.
///
/// throws  IoError for an unknown type, a wrong number of points, or a point out of range
void add_vtk_cell(MeshBuilder& builder, std::int64_t type, std::span<const std::int64_t> points, const VtkPlace& place);

/// The places of a file's cells among those of a builder, for the numbers that come after them.
class VtkCellPlaces {
 public:
  /// Call before each cell and after the last.
  void mark(const MeshBuilder& builder) { next_.push_back(builder.cell_count()); }
  std::size_t count() const { return next_.empty() ? 0 : next_.size() - 1; }
  /// Give every cell its number in the column of a name. VTK marks cells in a column of a name of its own: those that
  /// are copies of cells of another piece, or hidden, are left out.
  ///
  /// pre  values.size() == count()
  void tag(MeshBuilder& builder, std::string_view name, std::span<const std::int64_t> values) const;

 private:
  std::vector<std::size_t> next_;
};

/// Say in a notice how many cells were left out.
void note_ghost_cells(MeshBuilder& builder);

}  // namespace dartboard
