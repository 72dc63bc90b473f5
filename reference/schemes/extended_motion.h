#pragma once
// The classical Runge-Kutta method in extended precision, and how far rounding carries a run in doubles from it.

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "reference/spring_network.h"
#include "reference/summation_bound.h"

namespace dartboard::reference {

/// Positions [m] and velocities [m/s] of the points of a network, three numbers each.
struct ExtendedState {
  std::vector<long double> x, v;
};
ExtendedState extended(const PointState& state);

/// The largest difference of any coordinate, NaN if one is not a number or the sizes differ.
StateBound distance(const ExtendedState& a, const ExtendedState& b);

/// `steps` steps of size h of the classical Runge-Kutta method in long double over the network's forces. With a seed
/// that is not zero, every number of the state is changed by up to half a unit in the last place of a double, at
/// random, after each step: the effect of rounding the result of a step.
ExtendedState extended_run(const SpringNetwork& network, const PointState& start, double h, int steps,
                           std::uint64_t rounding_seed = 0);

/// A run in extended precision, and the spread: the largest distance from it of some runs that are rounded after each
/// step. A program that takes the same steps in doubles rounds some ten times in each, not once, and ends within a few
/// spreads. The spread includes the growth of errors in ill-conditioned or chaotic motions: disturbances grow alike.
///
/// cost    1 + rounded_runs runs
struct WitnessedMotion {
  ExtendedState end;
  StateBound spread;
};
WitnessedMotion witnessed_motion(const SpringNetwork& network, const PointState& start, double h, int steps,
                                 int rounded_runs = 3);

}  // namespace dartboard::reference
