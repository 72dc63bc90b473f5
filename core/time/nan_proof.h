#pragma once
// Maxima that do not lose a NaN.

#include <Eigen/Core>
#include <cmath>
#include <span>

namespace dartboard {

/// The larger of two numbers, NaN if either is. std::max(a, NaN) is a, so a residual that is no number would pass as
/// small.
inline double max_or_nan(double a, double b) {
  if (std::isnan(a) || std::isnan(b)) return a + b;
  return a < b ? b : a;
}

/// The largest absolute coordinate; NaN if one is NaN, 0 if there is none.
inline double max_abs_or_nan(std::span<const Eigen::Vector3d> v) {
  double largest = 0.0;
  for (const Eigen::Vector3d& p : v)
    for (int c = 0; c < 3; ++c) largest = max_or_nan(largest, std::abs(p[c]));
  return largest;
}

/// Is every coordinate a finite number?
inline bool all_finite(std::span<const Eigen::Vector3d> v) {
  for (const Eigen::Vector3d& p : v)
    if (!(std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]))) return false;
  return true;
}

}  // namespace dartboard
