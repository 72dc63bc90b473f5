#pragma once
// Bounds of the terms in the forces of elements, for their rounding.

#include <cmath>
#include <cstdint>

#include "core/forces/force_term.h"

namespace dartboard {

/// A bound [m] of the terms that the line from vertex i to vertex j within a step is the sum of.
inline double line_size(const StagePlaces& at, std::uint32_t i, std::uint32_t j) {
  const double length = (at.x[j] - at.x[i]).norm();
  return at.w.empty() ? length : length + std::abs(at.t) * (at.w[j] - at.w[i]).norm();
}

/// A bound [Pa] for the stress at a deformation gradient F that was summed from numbers of this size: F is wrong by a
/// few units of rounding of that, and the stress by the Hessian times it; a law's Hessian grows with the square of F.
inline double stress_size(double modulus, double summed) { return modulus * (1.0 + summed) * (1.0 + summed * summed); }

}  // namespace dartboard
