#pragma once
// The extent of points along a direction.

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <span>

namespace dartboard {

/// [m] From the lowest to the highest of some points along a direction of length 1; 0 without points.
inline double extent_along(const Eigen::Vector3d& direction, std::span<const Eigen::Vector3d> points) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Eigen::Vector3d& x : points) {
    low = std::min(low, x.dot(direction));
    high = std::max(high, x.dot(direction));
  }
  return points.empty() ? 0.0 : high - low;
}

}  // namespace dartboard
