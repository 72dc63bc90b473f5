#pragma once
// Which tetrahedra overlap, by the exact predicates of CGAL, and how deep.

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace dartboard::reference {

/// Two tetrahedra that overlap or touch, the lower number first.
struct Overlap {
  std::uint32_t first = 0, second = 0;
  double depth = 0.0;              // [m] least translation that parts them; 0, to rounding, where they just touch
  Eigen::Vector3d along{0, 0, 0};  // of length 1: the direction in which the second one has to move

  friend bool operator==(const Overlap&, const Overlap&) = default;
};

/// All pairs of tetrahedra that have a point in common and share no corner, by numbers. The common point is decided
/// exactly for the places in double precision; the depth is that of `least_translation`. Candidates are pairs whose
/// boxes along the axes overlap (CGAL::box_intersection_d). Tetrahedra may be inside out. Those that are exactly flat
/// overlap nothing.
///
/// units   x [m], by corner
/// cost    O(n log^2 n) for n tetrahedra, and some microseconds for each pair of overlapping boxes
/// throws  InputError for a corner beyond x, or a place that is not finite
std::vector<Overlap> overlaps(std::span<const Eigen::Vector3d> x,
                              std::span<const std::array<std::uint32_t, 4>> tetrahedra);

}  // namespace dartboard::reference
