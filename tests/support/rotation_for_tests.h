#pragma once
// A rotation about a general axis by a general angle, for tests of results that must not depend on orientation.

#include <Eigen/Core>
#include <vector>

namespace dartboard {

/// The rotation of the quaternion (w, x, y, z), which need not be a unit one. Each entry is a sum of at most four whole
/// numbers over another, when the arguments are small whole numbers: its error is at most u.
inline Eigen::Matrix3d rotation(double w, double x, double y, double z) {
  Eigen::Matrix3d r;
  r << w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y),  //
      2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x),   //
      2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z;
  return r / (w * w + x * x + y * y + z * z);
}

inline std::vector<Eigen::Matrix3d> some_rotations() {
  return {rotation(7, 2, -3, 5), rotation(1, 4, 2, -6), rotation(-3, 8, 11, 1)};
}

}  // namespace dartboard
