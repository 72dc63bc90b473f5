#include "validation/contact/random_placements.h"

#include <algorithm>

#include "validation/contact/placed_bodies.h"

namespace dartboard {

void PlacementsFound::add(const PlacementsFound& other) {
  placements += other.placements;
  overlapping += other.overlapping;
  quiet += other.quiet;
  deepest_quiet = std::max(deepest_quiet, other.deepest_quiet);
  least_altitude = other.least_altitude;
  by_depth.add(other.by_depth);
}

PlacementsFound judge_placements(const Mesh& first, const Mesh& second, const PlacementPlan& plan) {
  PlacedBodies placing(first, second, plan.seed);
  PlacementsFound found;
  found.placements = plan.placements;
  found.least_altitude = placing.least_altitude();
  for (std::size_t k = 0; k < plan.placements; ++k) {
    placing.place();
    const bool lost = plan.loses && plan.loses(k);
    bool quiet = true;
    double deepest = 0.0;
    const auto judged = placing.overlaps();
    for (const JudgedOverlap& one : judged) {
      const double share = one.overlap.depth / found.least_altitude;
      const bool felt = one.felt && !lost;
      found.by_depth.add(share, felt);
      quiet = quiet && !felt;
      deepest = std::max(deepest, share);
    }
    if (judged.empty()) continue;
    ++found.overlapping;
    if (!quiet) continue;
    ++found.quiet;
    found.deepest_quiet = std::max(found.deepest_quiet, deepest);
  }
  return found;
}

}  // namespace dartboard
