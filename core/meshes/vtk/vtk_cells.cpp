#include "core/meshes/vtk/vtk_cells.h"

#include <fmt/format.h>

#include <array>
#include <optional>
#include <string>

#include "core/base/counted.h"
#include "core/meshes/formats/triangle_strip.h"
#include "core/meshes/text/text_scanner.h"

namespace dartboard {
namespace {

constexpr std::size_t any_order = 0;

struct CellType {
  int type;
  CellKind kind;
  std::size_t points;                                             // or any_order
  std::string_view element = {};                                  // of higher order
  std::array<std::size_t, 8> corners = {0, 1, 2, 3, 4, 5, 6, 7};  // by corner: its place among VTK's points
};

// VTK documents the first triangle of its wedge as turned outward, but that of its curved wedges as turned inward
constexpr CellType cell_types[] = {
    {5, CellKind::triangle, 3},
    {8, CellKind::quadrilateral, 4, {}, {0, 1, 3, 2}},  // pixel
    {9, CellKind::quadrilateral, 4},
    {10, CellKind::tetrahedron, 4},
    {11, CellKind::hexahedron, 8, {}, {0, 1, 3, 2, 4, 5, 7, 6}},  // voxel
    {12, CellKind::hexahedron, 8},
    {13, CellKind::prism, 6, {}, {0, 2, 1, 3, 5, 4}},
    {14, CellKind::pyramid, 5},
    {22, CellKind::triangle, 6, "6-node triangle"},
    {23, CellKind::quadrilateral, 8, "8-node quadrilateral"},
    {24, CellKind::tetrahedron, 10, "10-node tetrahedron"},
    {25, CellKind::hexahedron, 20, "20-node hexahedron"},
    {26, CellKind::prism, 15, "15-node prism"},
    {27, CellKind::pyramid, 13, "13-node pyramid"},
    {28, CellKind::quadrilateral, 9, "9-node quadrilateral"},
    {29, CellKind::hexahedron, 27, "27-node hexahedron"},
    {30, CellKind::quadrilateral, 6, "6-node quadrilateral"},
    {31, CellKind::prism, 12, "12-node prism"},
    {32, CellKind::prism, 18, "18-node prism"},
    {33, CellKind::hexahedron, 24, "24-node hexahedron"},
    {34, CellKind::triangle, 7, "7-node triangle"},
    {37, CellKind::pyramid, 19, "19-node pyramid"},
    {69, CellKind::triangle, any_order, "Lagrange triangle"},
    {70, CellKind::quadrilateral, any_order, "Lagrange quadrilateral"},
    {71, CellKind::tetrahedron, any_order, "Lagrange tetrahedron"},
    {72, CellKind::hexahedron, any_order, "Lagrange hexahedron"},
    {73, CellKind::prism, any_order, "Lagrange prism"},
    {74, CellKind::pyramid, any_order, "Lagrange pyramid"},
    {76, CellKind::triangle, any_order, "Bezier triangle"},
    {77, CellKind::quadrilateral, any_order, "Bezier quadrilateral"},
    {78, CellKind::tetrahedron, any_order, "Bezier tetrahedron"},
    {79, CellKind::hexahedron, any_order, "Bezier hexahedron"},
    {80, CellKind::prism, any_order, "Bezier prism"},
    {81, CellKind::pyramid, any_order, "Bezier pyramid"},
};

/// The dimension of a cell that bodies do not have: vertices, edges, curves.
std::optional<int> dimension_of_skipped(std::int64_t type) {
  if (type == 1 || type == 2) return 0;
  if (type == 3 || type == 4 || type == 21 || type == 35 || type == 68 || type == 75) return 1;
  return std::nullopt;
}

constexpr std::int64_t triangle = 5, quadrilateral = 9;

void add_strip(MeshBuilder& builder, std::span<const std::int64_t> points, const VtkPlace& place) {
  if (points.size() < 3)
    fail_at(builder.cell_file(), place.line,
            fmt::format("cell {} is a triangle strip with {} points", place.cell, points.size()), "3 points or more");
  for_each_triangle(points, [&](const auto& corners) { add_vtk_cell(builder, triangle, corners, place); });
}

}  // namespace

void add_vtk_cell(MeshBuilder& builder, std::int64_t type, std::span<const std::int64_t> points,
                  const VtkPlace& place) {
  const auto fail = [&](std::string_view found, std::string_view expected) {
    fail_at(builder.cell_file(), place.line, fmt::format("cell {} {}", place.cell, found), expected);
  };
  if (const auto dimension = dimension_of_skipped(type)) return builder.skip(*dimension);
  if (type == vtk_triangle_strip) return add_strip(builder, points, place);
  if (type == vtk_polygon) {  // of a size that has a type of its own
    if (points.size() != 3 && points.size() != 4)
      fail(fmt::format("is a polygon of {} corners", points.size()),
           "triangles and quadrilaterals: split larger polygons");
    type = points.size() == 3 ? triangle : quadrilateral;
  }

  const CellType* found = nullptr;
  for (const auto& cell : cell_types)
    if (cell.type == type) found = &cell;
  if (found == nullptr)
    fail(fmt::format("with {} points has the type {}", points.size(), type),
         "a triangle (5), pixel (8), quadrilateral (9), tetrahedron (10), voxel (11), hexahedron (12), wedge (13), "
         "pyramid (14), or one of these of higher order");
  const auto corners = static_cast<std::size_t>(node_count(found->kind));
  const std::string_view called = found->element.empty() ? name(found->kind) : found->element;
  if (found->points == any_order && points.size() < corners)
    fail(fmt::format("is a {} with {} points", called, points.size()), fmt::format("{} points or more", corners));
  if (found->points != any_order && points.size() != found->points)
    fail(fmt::format("is a {} with {} points", called, points.size()), fmt::format("{} points", found->points));
  for (const std::int64_t point : points)
    if (point < 0 || static_cast<std::uint64_t>(point) >= place.point_count)
      fail(fmt::format("has the point {}", point), fmt::format("a number from 0 to less than {}", place.point_count));

  std::array<std::uint64_t, 8> nodes{};
  for (std::size_t k = 0; k < corners; ++k)
    nodes[k] = place.first_point + static_cast<std::uint64_t>(points[found->corners[k]]);
  builder.add_cell(found->kind, std::span(nodes).first(corners), place.line, found->element);
}

void VtkCellPlaces::tag(MeshBuilder& builder, std::string_view name, std::span<const std::int64_t> values) const {
  // bits of vtkGhostType; before version 7 VTK counted layers of copies
  constexpr std::int64_t duplicate_cell = 1, hidden_cell = 32;
  const bool are_bits = name == "vtkGhostType", are_layers = name == "vtkGhostLevels";
  if (are_bits || are_layers) {
    for (std::size_t c = 0; c < count(); ++c)
      for (std::size_t cell = next_[c]; cell < next_[c + 1]; ++cell)
        if (are_layers ? values[c] > 0 : (values[c] & (duplicate_cell | hidden_cell)) != 0) builder.leave_out(cell);
    return;
  }
  const std::size_t column = builder.tags().column(name, false);
  for (std::size_t c = 0; c < count(); ++c)
    for (std::size_t cell = next_[c]; cell < next_[c + 1]; ++cell) builder.tags().set(column, cell, values[c]);
}

void note_ghost_cells(MeshBuilder& builder) {
  if (const std::size_t count = builder.left_out_count(); count != 0)
    builder.add_notice(
        fmt::format("left out {}: copies of cells of other pieces, or hidden ones", counted(count, "ghost cell")));
}

}  // namespace dartboard
