#include "validation/motion_agreement.h"

#include <algorithm>

#include "reference/summation_bound.h"

namespace dartboard {
namespace {

double largest_difference(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).lpNorm<Eigen::Infinity>());
  return largest;
}

double largest_share_of_bound(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b,
                              const std::vector<double>& bound) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const double difference = (a[i] - b[i]).lpNorm<Eigen::Infinity>();
    if (difference > 0.0) largest = std::max(largest, difference / bound[i]);
  }
  return largest;
}

}  // namespace

std::vector<MotionAgreement> compare_motion(const Problem& problem, int steps) {
  // Off equilibrium in positions and velocities: some steps of the first contender from rest under gravity.
  const auto first = contenders()[0].make(problem);
  first->step(20);
  const PointState start = first->state();
  const auto first_forces = first->forces();
  first->step(steps);
  const PointState first_end = first->state();
  const std::uint64_t first_hash = state_hash(first_end);

  const auto force_bound = reference::force_bound(problem, start);
  const auto state_bound = reference::state_bound(problem, start, steps);

  std::vector<MotionAgreement> all;
  for (const Contender& c : contenders()) {
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
      a.agrees = a.hash == first_hash && forces == first_forces;
    } else {
      a.position_bound = state_bound.position;
      a.velocity_bound = state_bound.velocity;
      a.agrees = a.force_difference <= 1.0 && a.position_difference <= a.position_bound &&
                 a.velocity_difference <= a.velocity_bound;
    }
    all.push_back(a);
  }
  return all;
}

}  // namespace dartboard
