#pragma once
// The motion of a body of the matrix by a code that shares nothing with the integrators.

#include <optional>

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

/// Odeint's Runge-Kutta-Fehlberg method of order 8 in long double, in steps of a quarter of the fastest rate; nothing
/// if that takes more than 1,200 steps, or the witnesses do not support the body.
std::optional<MotionDistance> distance_from_truth(const SpringColumns& start, const SpringColumns& end,
                                                  double duration);

}  // namespace dartboard
