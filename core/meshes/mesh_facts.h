#pragma once
// The facts of a mesh before it becomes a body: its size, its edges, its worst cells, its boundary.

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/plain/mesh.h"

namespace dartboard {

/// A figure, and the cell that has it.
struct OfCell {
  double value;
  std::uint32_t cell;
};

struct MeshFacts {
  Eigen::Vector3d low{0, 0, 0}, high{0, 0, 0};                     // [m] corners of the bounding box
  std::size_t edges = 0;                                           // pairs of points
  double least_edge = 0.0, median_edge = 0.0, largest_edge = 0.0;  // [m]
  double measure = 0.0;                                            // [m^3], of a surface [m^2]: that of all cells
  /// [degrees] between two faces of a volume, along an edge; in a polygon at a corner.
  std::optional<OfCell> smallest_angle, largest_angle;
  /// 3 r / R for tetrahedra, 2 r / R for triangles, r and R the radii of the spheres or circles in and around them: 1
  /// for a regular one, 0 for a flat one. No value for other kinds.
  std::optional<OfCell> least_radius_ratio;
  std::vector<std::uint32_t> flat;  // cells with an angle below one degree, ascending
  std::size_t boundary_parts = 0;   // closed surfaces; of a surface, boundary curves
  /// Handles of the boundary of a solid, over all its parts; no value if the boundary is not a surface everywhere, or
  /// is empty.
  std::optional<std::size_t> genus;
};

/// The facts of a mesh with a point for each vertex (split_touching_points).
///
/// cost  O(n log n) in the cells
MeshFacts facts_of(const Mesh& mesh);

inline constexpr double flat_below_degrees = 1.0;

}  // namespace dartboard
