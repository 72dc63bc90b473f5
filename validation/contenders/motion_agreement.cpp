#include "validation/contenders/motion_agreement.h"

#include <cmath>
#include <limits>

#include "core/plain/nan_maximum.h"
#include "reference/summation_bound.h"

namespace dartboard {
namespace {

using Vectors = std::vector<Eigen::Vector3d>;

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

// Eigen's norms and std::max lose a NaN.
double largest_coordinate(const Eigen::Vector3d& d) {
  return max_or_nan(max_or_nan(std::abs(d[0]), std::abs(d[1])), std::abs(d[2]));
}

double largest_difference(const Vectors& a, const Vectors& b) {
  if (a.size() != b.size()) return no_number;
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = max_or_nan(largest, largest_coordinate(a[i] - b[i]));
  return largest;
}

double largest_share_of_bound(const Vectors& a, const Vectors& b, const std::vector<double>& bound) {
  if (a.size() != b.size() || a.size() != bound.size()) return no_number;
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = largest_coordinate(a[i] - b[i]);
    if (!std::isfinite(bound[i])) return no_number;
    if (difference != 0.0) largest = max_or_nan(largest, difference / bound[i]);
  }
  return largest;
}

}  // namespace

std::vector<MotionAgreement> compare_motion(const Problem& problem, int steps, std::span<const Contender> all) {
  // Off equilibrium in positions and velocities: some steps of the first contender from rest under gravity.
  const auto first = all.front().make(problem);
  first->step(20);
  const PointState start = first->state();
  const auto first_forces = first->forces();
  first->step(steps);
  const PointState first_end = first->state();
  const std::uint64_t first_hash = state_hash(first_end);

  const auto force_bound = reference::force_bound(problem, start);
  const auto state_bound = reference::state_bound(problem, start, steps);

  std::vector<MotionAgreement> compared;
  for (const Contender& c : all) {
    const auto simulation = c.make(problem);
    simulation->set_state(start);
    const auto forces = simulation->forces();
    simulation->step(steps);
    const PointState end = simulation->state();

    MotionAgreement a;
    a.id = c.id;
    a.hash = state_hash(end);
    a.force_difference = largest_share_of_bound(forces, first_forces, force_bound);
    a.position_difference = largest_difference(end.x, first_end.x);
    a.velocity_difference = largest_difference(end.v, first_end.v);
    if (c.carrier == Carrier::core_map) {
      // equal hashes of states with NaN are no agreement
      a.agrees = a.hash == first_hash && forces == first_forces && a.position_difference == 0.0 &&
                 a.velocity_difference == 0.0;
    } else {
      a.position_bound = state_bound.position;
      a.velocity_bound = state_bound.velocity;
      a.agrees = std::isfinite(a.position_bound) && std::isfinite(a.velocity_bound) && a.force_difference <= 1.0 &&
                 a.position_difference <= a.position_bound && a.velocity_difference <= a.velocity_bound;
    }
    compared.push_back(a);
  }
  return compared;
}

}  // namespace dartboard
