#include "validation/conservation/remaining_cells.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>

#include "core/plain/error.h"
#include "reference/cell_shape.h"

namespace dartboard {
namespace {

double measure_at_rest(const Mesh& mesh, std::span<const std::uint32_t> cycle) {
  if (cycle.size() == 2) return (mesh.points[cycle[1]] - mesh.points[cycle[0]]).norm();
  Eigen::Vector3d twice = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& p = mesh.points[cycle[0]];
  for (std::size_t k = 2; k < cycle.size(); ++k)
    twice += (mesh.points[cycle[k - 1]] - p).cross(mesh.points[cycle[k]] - p);
  return twice.norm() / 2.0;
}

std::vector<std::vector<int>> edges_of_polygon(int nodes) {
  std::vector<std::vector<int>> edges;
  for (int k = 0; k < nodes; ++k) edges.push_back({k, (k + 1) % nodes});
  return edges;
}

}  // namespace

std::span<const std::vector<int>> sides_of(CellKind kind) {
  static const auto triangle = edges_of_polygon(3), quadrilateral = edges_of_polygon(4);
  if (kind == CellKind::triangle) return triangle;
  if (kind == CellKind::quadrilateral) return quadrilateral;
  return reference::own_faces(kind);
}

RemainingCells::RemainingCells(const Mesh& mesh) : mesh_(&mesh), count_(mesh.cell_count()), there_(count_, 1) {
  first_side_.push_back(0);
  first_edge_.push_back(0);
  first_point_.push_back(0);
  std::map<std::vector<std::uint32_t>, std::uint32_t> side_with;  // by its points, ascending
  for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
    const std::uint32_t corner = mesh.first[c];
    for (std::size_t k = 0; k < mesh.cell(c).size(); ++k) cell_of_corner_.push_back(c);
    for (const auto& cycle : sides_of(mesh.kinds[c])) {
      const auto side = static_cast<std::uint32_t>(opposite_.size());
      std::vector<std::uint32_t> points;
      for (std::size_t k = 0; k < cycle.size(); ++k) {
        const auto a = corner + static_cast<std::uint32_t>(cycle[k]);
        const auto b = corner + static_cast<std::uint32_t>(cycle[(k + 1) % cycle.size()]);
        points.push_back(mesh.nodes[a]);
        const bool known = std::any_of(ends_.begin() + first_edge_[c], ends_.end(),
                                       [&](Ends e) { return (e.a == a && e.b == b) || (e.a == b && e.b == a); });
        if (known) continue;
        ends_.push_back({a, b});
        cell_of_edge_.push_back(c);
      }
      side_points_.insert(side_points_.end(), points.begin(), points.end());
      first_point_.push_back(static_cast<std::uint32_t>(side_points_.size()));
      cell_of_side_.push_back(c);
      opposite_.push_back(side);
      measure_.push_back(measure_at_rest(mesh, points));
      std::sort(points.begin(), points.end());
      const auto [found, is_new] = side_with.try_emplace(points, side);
      if (is_new) continue;
      const std::uint32_t other = found->second;
      if (is_joined(other)) throw InputError(fmt::format("cell {} shares a side with two others", c));
      opposite_[side] = other;
      opposite_[other] = side;
      measure_[side] = measure_[other];
    }
    first_side_.push_back(static_cast<std::uint32_t>(opposite_.size()));
    first_edge_.push_back(static_cast<std::uint32_t>(ends_.size()));
  }
}

void RemainingCells::dissociate(std::uint32_t side) {
  const std::uint32_t other = opposite_[side];
  opposite_[side] = side;
  opposite_[other] = other;
}

void RemainingCells::remove(std::uint32_t cell) {
  for (std::uint32_t side = first_side_[cell]; side < first_side_[cell + 1]; ++side) dissociate(side);
  there_[cell] = 0;
  --count_;
}

std::uint32_t RemainingCells::corner_at(std::uint32_t cell, std::uint32_t point) const {
  std::uint32_t k = mesh_->first[cell];
  while (mesh_->nodes[k] != point) ++k;
  return k;
}

std::uint32_t RemainingCells::edge_at(std::uint32_t cell, std::uint32_t p, std::uint32_t q) const {
  const std::uint32_t a = corner_at(cell, p), b = corner_at(cell, q);
  std::uint32_t k = first_edge_[cell];
  while (!(ends_[k].a == a && ends_[k].b == b) && !(ends_[k].a == b && ends_[k].b == a)) ++k;
  return k;
}

std::uint32_t RemainingCells::same_corner(std::uint32_t corner, std::uint32_t cell) const {
  return corner_at(cell, mesh_->nodes[corner]);
}

std::uint32_t RemainingCells::same_edge(std::uint32_t edge, std::uint32_t cell) const {
  return edge_at(cell, mesh_->nodes[ends_[edge].a], mesh_->nodes[ends_[edge].b]);
}

std::optional<std::uint32_t> RemainingCells::joined_side(SplitMix64& random) const {
  const auto sides = static_cast<std::uint32_t>(opposite_.size());
  const std::uint32_t from = random.below(sides);
  for (std::uint32_t k = 0; k < sides; ++k)
    if (const std::uint32_t side = (from + k) % sides; is_joined(side)) return side;
  return std::nullopt;
}

bool RemainingCells::has_point(std::uint32_t side, std::uint32_t point) const {
  const auto begin = side_points_.begin();
  return std::find(begin + first_point_[side], begin + first_point_[side + 1], point) != begin + first_point_[side + 1];
}

std::span<const std::uint32_t> RemainingCells::vertex(std::uint32_t corner) const {
  const std::uint32_t point = mesh_->nodes[corner];
  found_.assign(1, corner);
  for (std::size_t at = 0; at < found_.size(); ++at) {
    const std::uint32_t c = cell_of_corner_[found_[at]];
    for (std::uint32_t side = first_side_[c]; side < first_side_[c + 1]; ++side) {
      if (!is_joined(side) || !has_point(side, point)) continue;
      const std::uint32_t next = corner_at(cell_of_side_[opposite_[side]], point);
      if (std::find(found_.begin(), found_.end(), next) == found_.end()) found_.push_back(next);
    }
  }
  return found_;
}

std::span<const std::uint32_t> RemainingCells::edge(std::uint32_t edge) const {
  const std::uint32_t p = mesh_->nodes[ends_[edge].a], q = mesh_->nodes[ends_[edge].b];
  found_.assign(1, edge);
  for (std::size_t at = 0; at < found_.size(); ++at) {
    const std::uint32_t c = cell_of_edge_[found_[at]];
    for (std::uint32_t side = first_side_[c]; side < first_side_[c + 1]; ++side) {
      if (!is_joined(side) || !has_point(side, p) || !has_point(side, q)) continue;
      const std::uint32_t next = edge_at(cell_of_side_[opposite_[side]], p, q);
      if (std::find(found_.begin(), found_.end(), next) == found_.end()) found_.push_back(next);
    }
  }
  return found_;
}

std::vector<std::uint32_t> RemainingCells::component(std::uint32_t cell) const {
  std::vector<char> met(there_.size(), 0);
  return component(cell, met);
}

std::vector<std::uint32_t> RemainingCells::component(std::uint32_t cell, std::vector<char>& met) const {
  std::vector<std::uint32_t> cells{cell};
  met[cell] = 1;
  for (std::size_t at = 0; at < cells.size(); ++at)
    for (std::uint32_t side = first_side_[cells[at]]; side < first_side_[cells[at] + 1]; ++side) {
      const std::uint32_t next = cell_of_side_[opposite_[side]];
      if (!met[next]) cells.push_back(next);
      met[next] = 1;
    }
  return cells;
}

std::size_t RemainingCells::count_components() const {
  std::vector<char> met(there_.size(), 0);
  std::size_t components = 0;
  for (std::uint32_t c = 0; c < there_.size(); ++c) {
    if (!there_[c] || met[c]) continue;
    component(c, met);
    ++components;
  }
  return components;
}

std::size_t RemainingCells::count_sides() const {
  std::size_t sides = 0;
  for (std::uint32_t side = 0; side < opposite_.size(); ++side)
    sides += there_[cell_of_side_[side]] && side <= opposite_[side] ? 1 : 0;
  return sides;
}

}  // namespace dartboard
