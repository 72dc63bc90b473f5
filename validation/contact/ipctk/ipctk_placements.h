#pragma once
// Bodies put to each other at random, some of them apart: what ipctk finds of their surfaces, and what contact feels.

#include <cstddef>
#include <string>
#include <vector>

#include "core/plain/mesh.h"
#include "validation/contact/ipctk/ipctk_questions.h"
#include "validation/contact/random_placements.h"

namespace dartboard {

struct IpctkPlacements {
  std::string bodies;
  IpctkQuestion question;
  std::vector<double> overlap;  // by place: the deepest of two cells by CGAL, in least altitudes; 0 without one
  double width = 0.0;           // [m] the least distance of two parallel planes with a cell between them
  double edge = 0.0;            // [m] the longest of a cell
  double size = 0.0;            // [m] the largest coordinate
};

/// Placements as those of judge_placements, from one least altitude apart to one deep; every second one is the one
/// before, moved on by less than a fifth of an altitude.
///
/// pre     meshes of tetrahedra, of convex bodies; plan.placements > 0
/// units   meshes [m]
IpctkPlacements ipctk_placements(std::string bodies, const Mesh& first, const Mesh& second, const PlacementPlan& plan);

struct IpctkPlacementsFound {
  std::string bodies;
  std::size_t placements = 0;
  std::size_t crossing = 0;    // by ipctk
  std::size_t disputed = 0;    // surfaces cross, but CGAL finds no cells that overlap, or the other way round
  std::size_t false_felt = 0;  // something is felt where no surfaces cross
  std::size_t quiet = 0;       // surfaces cross, and nothing is felt
  double deepest_quiet = 0.0;  // of these the deepest overlap, in least altitudes

  std::size_t contacts = 0;
  std::size_t shallow = 0;  // nearer to the surface, by ipctk, than the least width of a cell
  std::size_t longer = 0;   // of the others: deeper than the surface is far
  // The largest distance of our depths from those of ipctk, as a share of the size. A contact that is not shallow may
  // be deeper, up to the longest edge.
  double apart = 0.0;
  double longest = 1.0;  // depth over distance
};

/// The **depth** of a contact is the distance of the nearest triangle among those at the corners of the tetrahedron
/// that the sample is in. That triangle is the nearest of all where the nearest of all is not further than the least
/// width: the sum of the hat functions of the tetrahedron's corners is 1 in it and 0 on a triangle without any of them,
/// and in no cell steeper than 1 over its width; the way to the nearest triangle is within the body. Otherwise the way
/// out may be longer, but not longer than an edge: a corner of the tetrahedron is on the boundary.
IpctkPlacementsFound found_by_ipctk(const IpctkPlacements& placements, const IpctkAnswer& answer);

}  // namespace dartboard
