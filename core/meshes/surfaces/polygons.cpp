#include <fmt/format.h>

#include "core/meshes/surfaces/surface_formats.h"
#include "core/meshes/text/text_scanner.h"

namespace dartboard {

void add_polygon(MeshBuilder& builder, std::span<const std::uint64_t> corners, std::size_t line) {
  if (corners.size() != 3 && corners.size() != 4)
    fail_at(builder.cell_file(), line,
            fmt::format("cell {} is a polygon of {} corners", builder.cell_count(), corners.size()),
            "triangles and quadrilaterals: split larger polygons");
  builder.add_cell(corners.size() == 3 ? CellKind::triangle : CellKind::quadrilateral, corners, line);
}

}  // namespace dartboard
