#pragma once
// The least box along the axes around some places, or around the ways that places have gone.

#include <Eigen/Core>
#include <limits>
#include <span>

#include "core/forces/force_term.h"

namespace dartboard {

/// What is not a number is in no box.
struct BoxAround {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  Eigen::Vector3d low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};

  /// Of two points in it, the largest distance.
  double diagonal() const { return (high - low).norm(); }
};

BoxAround box_around(std::span<const Eigen::Vector3d> x);

/// Widens a box of ways by those from `from` to the places of as many vertices, of which the first is `first`.
void add_ways(BoxAround& box, std::span<const Eigen::Vector3d> from, const StagePlaces& to, std::size_t first);

}  // namespace dartboard
