#pragma once
// Functions of columns of vectors that may hold NaN.

#include <Eigen/Core>
#include <cmath>
#include <span>

#include "core/plain/nan_maximum.h"

namespace dartboard {

/// The largest absolute coordinate; NaN if one is NaN, 0 of an empty column.
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
