#pragma once
// The distance of a point from a straight line between two others.

#include <Eigen/Core>
#include <algorithm>

namespace dartboard {

inline double distance_to_segment(const Eigen::Vector3d& x, const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d along = to - from;
  const double length_2 = along.squaredNorm();
  const double t = length_2 > 0.0 ? std::clamp((x - from).dot(along) / length_2, 0.0, 1.0) : 0.0;
  return (x - from - t * along).norm();
}

}  // namespace dartboard
