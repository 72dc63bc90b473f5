#pragma once
// Two bodies put a little into each other at random, and whether the overlap is felt.

#include <cstddef>
#include <cstdint>
#include <functional>

#include "core/plain/mesh.h"
#include "validation/contact/judged_overlaps.h"

namespace dartboard {

struct PlacementPlan {
  std::size_t placements = 1000;
  std::uint64_t seed = 1;
  // for tests: the contacts of this placement are lost
  std::function<bool(std::size_t placement)> loses{};
};

struct PlacementsFound {
  std::size_t placements = 0;
  std::size_t overlapping = 0;  // placements in which cells overlap
  std::size_t quiet = 0;        // of these without a single contact
  double deepest_quiet = 0.0;   // of these the deepest overlap, in least altitudes
  double least_altitude = 0.0;  // [m] of the cells at the boundary
  OverlapTally by_depth{};      // pairs of cells, in least altitudes

  /// Adds the results of another series of the same bodies.
  void add(const PlacementsFound& other);
};

/// Put the second body to the first at random: a place on the surface of one (a corner, on an edge, in a face, as often
/// each) into such a place of the other by up to one least altitude, turned so that the outward directions at both are
/// opposite; and judge all overlaps.
///
/// pre     meshes of tetrahedra, of convex bodies: outwards is away from the mean of the vertices
/// units   meshes [m]
PlacementsFound judge_placements(const Mesh& first, const Mesh& second, const PlacementPlan& plan);

}  // namespace dartboard
