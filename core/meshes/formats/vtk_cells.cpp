#include "core/meshes/formats/vtk_cells.h"

#include <fmt/format.h>

#include <array>
#include <optional>

#include "core/meshes/text/text_scanner.h"

namespace dartboard {
namespace {

struct LinearCell {
  int type;
  CellKind kind;
  std::array<std::size_t, 8> order;  // which of VTK's points each node is
};

constexpr LinearCell linear_cells[] = {
    {5, CellKind::triangle, {0, 1, 2}},
    {8, CellKind::quadrilateral, {0, 1, 3, 2}},  // pixel
    {9, CellKind::quadrilateral, {0, 1, 2, 3}},
    {10, CellKind::tetrahedron, {0, 1, 2, 3}},
    {11, CellKind::hexahedron, {0, 1, 3, 2, 4, 5, 7, 6}},  // voxel
    {12, CellKind::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}},
    {13, CellKind::prism, {0, 2, 1, 3, 5, 4}},
    {14, CellKind::pyramid, {0, 1, 2, 3, 4}},
};

struct HigherOrderCell {
  int type, dimension;
  std::string_view name;
};

constexpr HigherOrderCell higher_order_cells[] = {
    {22, 2, "6-node triangle"},      {23, 2, "8-node quadrilateral"},   {24, 3, "10-node tetrahedron"},
    {25, 3, "20-node hexahedron"},   {26, 3, "15-node prism"},          {27, 3, "13-node pyramid"},
    {28, 2, "9-node quadrilateral"}, {29, 3, "27-node hexahedron"},     {30, 2, "6-node quadrilateral"},
    {31, 3, "12-node prism"},        {32, 3, "18-node prism"},          {33, 3, "24-node hexahedron"},
    {34, 2, "7-node triangle"},      {36, 2, "quadratic polygon"},      {37, 3, "19-node pyramid"},
    {69, 2, "Lagrange triangle"},    {70, 2, "Lagrange quadrilateral"}, {71, 3, "Lagrange tetrahedron"},
    {72, 3, "Lagrange hexahedron"},  {73, 3, "Lagrange prism"},         {74, 3, "Lagrange pyramid"},
    {76, 2, "Bezier triangle"},      {77, 2, "Bezier quadrilateral"},   {78, 3, "Bezier tetrahedron"},
    {79, 3, "Bezier hexahedron"},    {80, 3, "Bezier prism"},           {81, 3, "Bezier pyramid"},
};

/// The dimension of a cell that no body is made of: vertices, edges, curves.
std::optional<int> dimension_of_skipped(std::int64_t type) {
  if (type == 1 || type == 2) return 0;
  if (type == 3 || type == 4 || type == 21 || type == 35 || type == 68 || type == 75) return 1;
  return std::nullopt;
}

}  // namespace

void add_vtk_cell(MeshBuilder& builder, std::int64_t type, std::span<const std::int64_t> points,
                  const VtkPlace& place) {
  const auto fail = [&](std::string_view found, std::string_view expected) {
    fail_at(builder.cell_file(), place.line, fmt::format("cell {} {}", place.cell, found), expected);
  };
  if (const auto dimension = dimension_of_skipped(type)) return builder.skip(*dimension);
  for (const auto& cell : higher_order_cells)
    if (cell.type == type) return builder.add_higher_order(cell.name, cell.dimension, place.line);
  if (type == 7 && points.size() == 3) type = 5;  // polygons of a size that has a type of its own
  if (type == 7 && points.size() == 4) type = 9;

  const LinearCell* found = nullptr;
  for (const auto& cell : linear_cells)
    if (cell.type == type) found = &cell;
  if (found == nullptr)
    fail(fmt::format("with {} points has the type {}", points.size(), type),
         "a triangle (5), pixel (8), quadrilateral (9), tetrahedron (10), voxel (11), hexahedron (12), wedge (13) or "
         "pyramid (14)");
  const auto size = static_cast<std::size_t>(node_count(found->kind));
  if (points.size() != size)
    fail(fmt::format("is a {} with {} points", name(found->kind), points.size()), fmt::format("{} points", size));
  for (const std::int64_t point : points)
    if (point < 0 || static_cast<std::uint64_t>(point) >= place.point_count)
      fail(fmt::format("has the point {}", point), fmt::format("a number from 0 to less than {}", place.point_count));

  std::array<std::uint64_t, 8> nodes{};
  for (std::size_t k = 0; k < size; ++k)
    nodes[k] = place.first_point + static_cast<std::uint64_t>(points[found->order[k]]);
  builder.add_cell(found->kind, std::span(nodes).first(size), place.line);
}

}  // namespace dartboard
