#pragma once
// The cell types of VTK, for its legacy and its XML files.

#include <cstdint>
#include <span>

#include "core/meshes/formats/mesh_builder.h"

namespace dartboard {

/// Where a cell was found, and the points that it may use: 0 .. point_count-1, called first_point .. in the builder.
struct VtkPlace {
  std::size_t line;
  std::uint64_t cell;
  std::uint64_t first_point;
  std::uint64_t point_count;
};

/// Add one cell of VTK's type number. Pixels and voxels become quadrilaterals and hexahedra, and prisms are mirrored:
/// VTK documents them with the first triangle turned outward.
///
/// throws  IoError for an unknown type, a wrong number of points, or a point out of range
void add_vtk_cell(MeshBuilder& builder, std::int64_t type, std::span<const std::int64_t> points, const VtkPlace& place);

}  // namespace dartboard
