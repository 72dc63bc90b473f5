#include <fmt/format.h>

#include <array>
#include <cmath>

#include "core/meshes/formats/mesh_formats.h"

namespace dartboard {
namespace {

/// A header field that TetGen lets its writers leave out.
std::uint64_t optional_count(TextScanner& scan, Wanted wanted, std::uint64_t otherwise) {
  return scan.more_on_line() ? scan.count(wanted) : otherwise;
}

void read_nodes(TextScanner& node, MeshBuilder& builder) {
  const std::uint64_t count = node.count("the number of points");
  const std::uint64_t dimension = optional_count(node, "the dimension", 3);
  if (dimension != 2 && dimension != 3) node.fail(fmt::format("dimension {}", dimension), "dimension 2 or 3");
  const std::uint64_t attributes = optional_count(node, "the number of attributes", 0);
  const std::uint64_t markers = optional_count(node, "the number of boundary markers", 0);
  if (markers > 1) node.fail(fmt::format("{} boundary markers", markers), "0 or 1");

  builder.reserve_points(node.plausible(count, 6));
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t number = node.count("the number of a point");
    if (i == 0 && number > 1) node.fail(fmt::format("the first point is {}", number), "points numbered from 0 or 1");
    const std::size_t line = node.line();
    Eigen::Vector3d x = Eigen::Vector3d::Zero();
    for (int k = 0; k < static_cast<int>(dimension); ++k) x[k] = node.real({"a coordinate of point", number});
    for (std::uint64_t k = 0; k < attributes; ++k) node.real({"an attribute of point", number});
    // some writers announce a marker and leave it out
    if (markers == 1 && node.more_on_line()) node.integer({"the boundary marker of point", number});
    builder.add_point(number, x, line);
  }
}

/// The first attribute of a cell is its region, where it is a whole number.
void read_attribute(TextScanner& ele, std::uint64_t cell, std::uint64_t k, MeshBuilder& builder) {
  const double value = ele.real({"an attribute of cell", cell});
  constexpr double most = 9007199254740992.0;  // 2^53
  if (k != 0 || value != std::trunc(value) || std::abs(value) > most) return;
  builder.tags().set(builder.tags().column("region", true), builder.cell_count(), static_cast<std::int64_t>(value));
}

}  // namespace

std::string read_tetgen(TextScanner& node, TextScanner& ele, MeshBuilder& builder) {
  read_nodes(node, builder);
  if (&node != &ele && !node.at_end()) {
    const auto extra = node.token("nothing");
    node.fail(fmt::format("{} follows the last point", in_quotes(extra)), "as many points as the first line announces");
  }

  const std::uint64_t count = ele.count("the number of cells");
  const std::uint64_t size = optional_count(ele, "the number of points of a cell", 4);
  const std::uint64_t attributes = optional_count(ele, "the number of attributes", 0);
  if (size != 3 && size != 4 && size != 6 && size != 10)
    ele.fail(fmt::format("cells of {} points", size), "3 or 6 (triangles), 4 or 10 (tetrahedra)");

  std::array<std::uint64_t, 10> points{};
  const auto nodes = std::span(points).first(static_cast<std::size_t>(size));
  for (std::uint64_t i = 0; i < count; ++i) {
    const std::uint64_t number = ele.count("the number of a cell");
    const std::size_t line = ele.line();
    for (auto& p : nodes) p = ele.count({"a point of cell", number});
    for (std::uint64_t k = 0; k < attributes; ++k) read_attribute(ele, number, k, builder);
    if (size == 3 || size == 6)
      builder.add_cell(CellKind::triangle, nodes.first(3), line, size == 6 ? "6-node triangle" : "");
    else
      builder.add_cell(CellKind::tetrahedron, nodes.first(4), line, size == 10 ? "10-node tetrahedron" : "");
  }
  if (!ele.at_end()) {
    const auto extra = ele.token("nothing");
    ele.fail(fmt::format("{} follows the last cell", in_quotes(extra)), "as many cells as the first line announces");
  }
  return "TetGen";
}

}  // namespace dartboard
