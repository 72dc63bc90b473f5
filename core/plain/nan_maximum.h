#pragma once
// Maxima that keep NaN: std::max(a, NaN) is a, so that an error of NaN would pass as small.

#include <cmath>
#include <concepts>
#include <span>

namespace dartboard {

/// The larger of two numbers, NaN if either is.
template <std::floating_point Real>
Real max_or_nan(Real a, Real b) {
  if (std::isnan(a) || std::isnan(b)) return a + b;
  return a < b ? b : a;
}

/// The largest of some numbers that are not negative, NaN if one is NaN; 0 of an empty list.
inline double max_or_nan(std::span<const double> values) {
  double largest = 0.0;
  for (const double value : values) largest = max_or_nan(largest, value);
  return largest;
}

}  // namespace dartboard
