#pragma once
// Points that lie close to each other.

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>

#include "core/plain/mesh.h"

namespace dartboard {

/// Call found(a, b, distance), a < b, for each pair of points that are at most `near` apart. `spacing` is about the
/// distance of most points from the next one: it decides the cost alone.
///
/// pre   finite coordinates; near >= 0
/// cost  O(n) where few points are nearer to each other than max(near, spacing)
void for_near_points(std::span<const Eigen::Vector3d> points, double near, double spacing,
                     const std::function<void(std::uint32_t, std::uint32_t, double)>& found);

/// The distance below which points without a common edge are taken for a seam: a millionth of the size of the points or
/// a thousandth of the shortest edge, whichever is less.
double seam_distance(std::span<const Eigen::Vector3d> points, double shortest_edge);

/// An edge of a cell, between two points.
struct CellEdge {
  double length;
  std::size_t cell;
  std::uint32_t a, b;  // its points
};
/// The shortest edge; infinite without any.
CellEdge shortest_edge(const Mesh& mesh);

}  // namespace dartboard
