#pragma once
// A scale that changes no digit, for squares that would under- or overflow.

#include <algorithm>
#include <cmath>

namespace dartboard {

/// The power of two that brings `size` near 1: between 1/2 and 1, or as far as 2^600 goes, which leaves room for the
/// squares of what is left. 1 for zero and for what is not finite.
inline double scale_to_one(double size) {
  constexpr int furthest = 600;
  if (size == 0.0 || !std::isfinite(size)) return 1.0;
  int exponent = 0;
  std::frexp(size, &exponent);
  return std::ldexp(1.0, std::clamp(-exponent, -furthest, furthest));
}

}  // namespace dartboard
