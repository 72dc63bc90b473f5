#pragma once
// What rounding acts on in the forces of elements.

#include <cmath>
#include <cstdint>

#include "core/forces/force_term.h"

namespace dartboard {

/// A bound of the line from vertex i to vertex j on the way [m]: of what it is the sum of.
inline double line_size(const StagePlaces& at, std::uint32_t i, std::uint32_t j) {
  const double length = (at.x[j] - at.x[i]).norm();
  return at.w.empty() ? length : length + std::abs(at.t) * (at.w[j] - at.w[i]).norm();
}

/// Of a stress [Pa] at a deformation gradient that was summed from numbers of this size: F is wrong by a few units of
/// that, and the stress by the Hessian times it; a law's Hessian grows with the square of F.
inline double stress_size(double modulus, double summed) { return modulus * (1.0 + summed) * (1.0 + summed * summed); }

}  // namespace dartboard
