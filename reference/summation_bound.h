#pragma once
// Bounds of how far two correct implementations of the mechanics may drift apart because they round differently.

#include <vector>

#include "core/plain/problem.h"

namespace dartboard::reference {

/// Largest difference of any coordinate of any point.
struct StateBound {
  double position;  // m
  double velocity;  // m/s
};

/// For every point, a bound of the difference of two implementations' f_i - viscosity m_i v_i in `state`, as the
/// Euclidean length [N]. It holds for every order of sums and for every usual way of writing the formula, with
/// IEEE doubles, correctly rounded division and square root, with or without fused multiply-add, and no underflow.
/// The derivation is in the source. Compare directly: the factor two for two implementations is included.
///
/// throws  InputError if the mesh is malformed or `state` has another number of points
std::vector<double> force_bound(const Problem& problem, const PointState& state);

/// A bound of the distance of two implementations after `steps` steps of classical Runge-Kutta from the same `start`.
///
/// It is a bound, not an estimate: rounding and its growth are followed stage by stage along the run, with Lipschitz
/// constants of the accelerations that hold in a tube around it. Growth is that of the absolute values, about
/// exp(h omega steps) with the Gershgorin omega: meant for some tens of steps, and infinite when a spring gets so short
/// that the tube touches zero length, or when the run diverges.
///
/// throws  as force_bound
/// cost    some RK4 steps in plain loops
StateBound state_bound(const Problem& problem, const PointState& start, int steps);

}  // namespace dartboard::reference
