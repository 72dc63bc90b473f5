#pragma once
// A step as a run took it in double precision, and the result of a judgement of it.

#include <Eigen/Core>
#include <algorithm>
#include <vector>

#include "reference/spring_network.h"

namespace dartboard::reference {

/// Positions [m] and velocities [m/s] before and after one step.
struct TakenStep {
  double h;  // [s]
  PointState before, after;
  PointState earlier{};  // one step of the same h further back; empty if the method starts anew
};

/// The distance of a step from that of its scheme, as a multiple of what rounding can explain.
struct StepJudgement {
  double excess = 0.0;  // of the step: correct up to 1
  double idle = 0.0;    // of a step that leaves the state as it was
  double nudged = 0.0;  // of the right step displaced by a millionth

  bool right() const { return excess <= 1.0; }
  /// Would a wrong step have been seen: one that does nothing, or, where a right one does nothing, a small one?
  bool sees() const { return idle > 1.0 || nudged > 1.0; }
};

}  // namespace dartboard::reference
