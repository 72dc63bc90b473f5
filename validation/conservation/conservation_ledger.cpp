#include "validation/conservation/conservation_ledger.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/plain/nan_maximum.h"

namespace dartboard {
namespace {

constexpr std::array<const char*, check_count> names{"vertices, edges, faces, volumes",
                                                     "Euler characteristic",
                                                     "map valid, numbers match cells",
                                                     "mass of a vertex",
                                                     "mass of a vertex, exact volumes (relative)",
                                                     "stiffness, damping, rest length of an edge",
                                                     "position, velocity, fixed: duplicated",
                                                     "ends of springs in the views, from the cells left",
                                                     "all views: apply = rebuild",
                                                     "total mass (relative)",
                                                     "total stiffness (relative)",
                                                     "total damping (relative)",
                                                     "linear momentum (relative)",
                                                     "angular momentum (relative)",
                                                     "kinetic energy (relative)",
                                                     "elastic energy (relative)",
                                                     "boundary area or length (relative)",
                                                     "springs side by side, summed (relative)",
                                                     "cells of a body from scratch",
                                                     "its motion, edges in the same order",
                                                     "its motion, own order: position [m]",
                                                     "its motion, own order: velocity [m/s]",
                                                     "motion, by the reference alone: position [m]",
                                                     "motion, by the reference alone: velocity [m/s]",
                                                     "parts split off: what they have of the body",
                                                     "parts split off: sums of part and rest (relative)",
                                                     "parts split off: motion as within the body",
                                                     "vertices put in: means of their cell (relative)",
                                                     "mass of a refined cell: its volume (relative)",
                                                     "forces around a refinement (relative)",
                                                     "drift of total mass (relative)",
                                                     "drift of total stiffness (relative)"};

}  // namespace

ConservationLedger::ConservationLedger(ConservationResult& result, std::uint64_t seed, std::span<const Check> checks)
    : result_(result), seed_(seed) {
  row_.fill(check_count);  // beyond the rows
  for (std::size_t k = 0; k < check_count; ++k) {
    if (std::find(checks.begin(), checks.end(), static_cast<Check>(k)) == checks.end()) continue;
    row_[k] = result_.rows.size();
    result_.rows.push_back({names[k], 0, {}, 0.0, 0.0, true});
  }
}

void ConservationLedger::within(Check check, double deviation, double bound, double scale, double actual,
                                double expected) {
  ConservedRow& r = row(check);
  ++r.checks;
  const double share = deviation == 0.0 ? 0.0 : deviation / bound;
  if (scale > 0.0) {
    double& closest = share_[static_cast<std::size_t>(check)];
    r.largest = max_or_nan(r.largest, deviation / scale);
    // of several checks without any deviation, the one with the widest bound; a share that is NaN stays
    const bool farther = !(share <= closest) && !std::isnan(closest);
    if (!r.bound || farther || (share == closest && bound / scale > *r.bound)) {
      r.deviation = deviation / scale;
      r.bound = bound / scale;
      closest = share;
    }
  }
  if (!(share <= 1.0))
    fail(check, "", fmt::format("{:.17g}", actual), fmt::format("{:.17g}", expected), fmt::format("{:.3g}", bound));
}

void ConservationLedger::fail(Check check, const std::string& whose, std::string actual, std::string expected,
                              std::string bound) {
  row(check).holds = false;
  if (broken()) return;
  result_.violation = {row(check).what + whose, result_.operations(), seed_,
                       std::move(actual),       std::move(expected),  std::move(bound)};
}

std::string to_string(const Violation& v) {
  return fmt::format("after operation {} of seed {}: {}: {}, expected {} (bound: {})", v.operation, v.seed, v.what,
                     v.actual, v.expected, v.bound);
}

}  // namespace dartboard
