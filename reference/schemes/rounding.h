#pragma once
// The accuracy that the witnesses can expect of what they judge.

#include <limits>

#include "reference/schemes/network_state.h"

namespace dartboard::reference {

inline constexpr Extended epsilon = std::numeric_limits<double>::epsilon();
inline constexpr Extended solver_tolerance = 1e-12L;  // relative, as promised by core's linear solvers

}  // namespace dartboard::reference
