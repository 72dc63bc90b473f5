#pragma once
// The motion of a body of the matrix by a code that shares nothing with the integrators.

#include <optional>
#include <span>

#include "core/plain/problem.h"
#include "validation/scenes/spring_columns.h"

namespace dartboard {

/// The distance of the end of a run from the true one, and the true displacement: the largest over all vertices of
/// positions and of velocities over the fastest rate, both in m.
struct MotionDistance {
  double positions = 0.0;  // of positions only
  double distance = 0.0;
  double moved = 0.0;

  /// Is the motion resolved, to a tenth of itself? A run that stays at rest is off by all of it.
  bool resolved() const { return distance <= 0.1 * moved; }
};

/// The distance of a run from its start to its end from a true end: all positions, then all velocities. `slow` [s] is
/// the time in which a velocity counts as a distance.
MotionDistance distance_between(std::span<const long double> truth, const PointState& start, const PointState& end,
                                double slow);

/// [1] The longest step of the true motion times the fastest rate, and the most steps that it may take.
inline constexpr double truth_step_times_rate = 0.25, most_truth_steps = 1200;

/// Odeint's Runge-Kutta-Fehlberg method of order 8 in long double, in steps of a quarter of the fastest rate; nothing
/// if that takes more than 1,200 steps, or the witnesses do not support the body.
std::optional<MotionDistance> distance_from_truth(const SpringColumns& start, const SpringColumns& end,
                                                  double duration);

}  // namespace dartboard
