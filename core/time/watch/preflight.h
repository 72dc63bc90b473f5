#pragma once
// The checks of a run before its first step.

#include <string>
#include <string_view>
#include <vector>

#include "core/time/method/integrator.h"
#include "core/time/watch/stable_step.h"

namespace dartboard {

/// The quantity of the warning that a stable step does not resolve the fastest motions.
inline constexpr std::string_view step_times_frequency = "step times highest frequency";

/// Diagnoses of a system, a motion and a step: `refused` keep a run from starting, `warnings` do not.
struct Preflight {
  StepResult refused;
  std::vector<StepResult> warnings;

  bool warns_of(StepCode code) const;
};

/// Refused are numbers that are not finite, masses of free vertices that are not positive, negative springs, steps that
/// are not positive, and squares that would overflow. Warned of are steps that are unstable (as `limits` say) or lost
/// in the rounding of most positions (unless the scheme is compensated), springs of zero length, coordinates rounded by
/// more than 1e-6 of a spring, denormal numbers, and frequencies that a stable step does not resolve. One warning of
/// each kind.
///
/// cost  O(springs + vertices)
Preflight check_before_run(const SpringSystem& system, Motion motion, const Scheme& scheme, double h,
                           const StableStep& limits, const Horizon& horizon = {});

/// A warning and its meaning for the run: "BAD_SCALING: step times highest frequency = 15.5; motions that fast are
/// not resolved".
std::string explained(const StepResult& warning);

}  // namespace dartboard
