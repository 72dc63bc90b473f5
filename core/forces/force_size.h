#pragma once
// Bounds of the terms in the forces of elements, for their rounding.

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/forces/force_term.h"

namespace dartboard {

/// A bound [m] of the terms that the line from vertex i to vertex j within a step is the sum of.
inline double line_size(const StagePlaces& at, std::uint32_t i, std::uint32_t j) {
  const double length = (at.x[j] - at.x[i]).norm();
  return at.w.empty() ? length : length + std::abs(at.t) * (at.w[j] - at.w[i]).norm();
}

/// A bound [Pa] for the stress at a deformation gradient F of this norm that was summed from numbers as large as
/// `summed`: F is wrong by a few units of rounding of that, and the stress by the Hessian times it; a law's Hessian
/// grows with the square of F, taken for four times as large as it is. In a thin element the numbers are far larger.
inline double stress_size(double modulus, double summed, double norm) {
  const double most = std::min(summed, 4.0 * norm);
  return modulus * (1.0 + summed) * (1.0 + most * most);
}

}  // namespace dartboard
