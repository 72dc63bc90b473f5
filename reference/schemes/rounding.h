#pragma once
// How exact what the witnesses judge can be.

#include <limits>

#include "reference/schemes/network_state.h"

namespace dartboard::reference {

inline constexpr Extended epsilon = std::numeric_limits<double>::epsilon();
inline constexpr Extended solver_tolerance = 1e-12L;  // relative, that core's linear solvers promise

}  // namespace dartboard::reference
