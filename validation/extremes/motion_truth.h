#pragma once
// The motion of a body of the matrix by a code that shares nothing with the integrators.

#include <optional>

#include "validation/scenes/spring_columns.h"

namespace dartboard {

/// How far the end of a run is from where the body really goes, and how far it goes: the largest over all vertices of
/// positions and of velocities over the fastest rate, both in m.
struct MotionDistance {
  double positions = 0.0;  // of these alone
  double distance = 0.0;
  double moved = 0.0;

  /// Is the motion resolved: to a tenth of itself? A run that does nothing is off by all of it.
  bool resolved() const { return distance <= 0.1 * moved; }
};

/// Odeint's Runge-Kutta-Fehlberg method of order 8 in long double, in steps of a quarter of the fastest rate; nothing
/// where that takes more than 1,200 steps, or the witnesses know no such body.
std::optional<MotionDistance> distance_from_truth(const SpringColumns& start, const SpringColumns& end,
                                                  double duration);

}  // namespace dartboard
