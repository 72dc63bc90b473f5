#include "validation/contact/ipctk/ipctk_placements.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "core/plain/nan_maximum.h"
#include "validation/contact/placed_bodies.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

/// The least width of a tetrahedron is an altitude, or the distance of the lines of two opposite edges.
double least_width(std::span<const CellCorners> cells, std::span<const Vector3d> x) {
  double least = std::numeric_limits<double>::infinity();
  for (const CellCorners& k : cells) {
    const Vector3d a = x[k[1]] - x[k[0]], b = x[k[2]] - x[k[0]], c = x[k[3]] - x[k[0]];
    const double volume = std::abs(a.dot(b.cross(c)));
    const std::array<Vector3d, 7> across{b.cross(c),     c.cross(a),     a.cross(b),    (b - a).cross(c - a),
                                         a.cross(c - b), b.cross(c - a), c.cross(b - a)};
    for (const Vector3d& normal : across) least = std::min(least, volume / normal.norm());
  }
  return least;
}

double longest_edge(std::span<const CellCorners> cells, std::span<const Vector3d> x) {
  double longest = 0.0;
  for (const CellCorners& k : cells)
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = 0; b < a; ++b) longest = std::max(longest, (x[k[a]] - x[k[b]]).norm());
  return longest;
}

}  // namespace

IpctkPlacements ipctk_placements(std::string bodies, const Mesh& first, const Mesh& second, const PlacementPlan& plan) {
  PlacedBodies placed(first, second, plan.seed);
  const IpctkSurfaces surfaces(placed.contact());
  IpctkPlacements made{.bodies = std::move(bodies),
                       .question = surfaces.question(false),
                       .overlap = {},
                       .width = least_width(placed.cells(), placed.x()),
                       .edge = longest_edge(placed.cells(), placed.x()),
                       .size = 0.0};
  for (std::size_t k = 0; k < plan.placements; ++k) {
    if (k % 2 == 0)
      placed.place(-1.0);
    else
      placed.shift(0.2);
    double deepest = 0.0;
    for (const JudgedOverlap& one : placed.overlaps()) deepest = std::max(deepest, one.overlap.depth);
    made.overlap.push_back(deepest / placed.least_altitude());
    made.question.places.push_back(surfaces.at(placed.x()));
    if (plan.loses && plan.loses(k)) made.question.places.back().felt = false;
    for (const Vector3d& x : made.question.places.back().x) made.size = std::max(made.size, x.cwiseAbs().maxCoeff());
  }
  return made;
}

IpctkPlacementsFound found_by_ipctk(const IpctkPlacements& placements, const IpctkAnswer& answer) {
  IpctkPlacementsFound found{.bodies = placements.bodies, .placements = placements.question.places.size()};
  for (std::size_t k = 0; k < found.placements; ++k) {
    const IpctkPlace& place = placements.question.places[k];
    const bool crossing = answer.crossing[k], overlapping = placements.overlap[k] > 0.0;
    found.crossing += crossing ? 1 : 0;
    found.disputed += crossing != overlapping ? 1 : 0;
    found.false_felt += place.felt && !crossing ? 1 : 0;
    if (crossing && !place.felt) {
      ++found.quiet;
      found.deepest_quiet = max_or_nan(found.deepest_quiet, placements.overlap[k]);
    }
    for (std::size_t s = 0; s < place.samples.size(); ++s) {
      const double depth = place.samples[s].depth, distance = std::sqrt(answer.squares[k][s]);
      ++found.contacts;
      const bool shallow = distance < placements.width;
      found.shallow += shallow ? 1 : 0;
      // the nearest depth that is right
      const double right = shallow ? distance : std::clamp(depth, distance, std::max(distance, placements.edge));
      found.apart = max_or_nan(found.apart, std::abs(depth - right) / placements.size);
      const double ratio = depth / distance;
      found.longer += !shallow && ratio > 1.0 + 1e-9 ? 1 : 0;
      found.longest = max_or_nan(found.longest, ratio);
    }
  }
  return found;
}

}  // namespace dartboard
