#pragma once
// Integrators on a linear oscillator against the exact n-step map of their method: the code is tested, not the
// truncation error.

#include <cstdint>
#include <string>

#include "core/time/integrators.h"

namespace dartboard {

/// The deviation of an integrator from the n-th power of the map of its scheme.
struct DiscreteExact {
  std::string integrator;
  double zeta = 0.0, h_omega = 0.0;
  std::uint64_t steps = 0;
  double deviation = 0.0;  // the larger of |omega q| and |v|, where the start has sqrt(omega^2 q^2 + v^2) = 0.35
  std::string diagnosis;   // of a run that ended early
};

/// A mass on a spring of rest length 2 at a wall, omega = 2, moving along the spring.
///
/// The step is the largest h omega = 1/4, 1/8, ... at which the scheme neither grows nor decays by more than e over all
/// steps. A method of several steps is compared from its first full set of states on.
/// throws  InputError if the scheme has no amplification
DiscreteExact compare_with_discrete_map(const IntegratorEntry& entry, double zeta, std::uint64_t steps);

}  // namespace dartboard
