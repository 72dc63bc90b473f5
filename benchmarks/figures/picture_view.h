#pragma once
// The direction from which bodies are seen.

#include <Eigen/Geometry>

namespace dartboard {

/// A view along parallels from the front, a little from the right and above.
class PictureView {
 public:
  /// `up` is the direction that is shown upwards; z where it is zero.
  explicit PictureView(const Eigen::Vector3d& up = Eigen::Vector3d::UnitZ()) {
    const Eigen::Vector3d towards = Eigen::Vector3d(0.45, -0.8, 0.4).normalized();
    const Eigen::Vector3d right = Eigen::Vector3d::UnitZ().cross(towards).normalized();
    axes_ << right.transpose(), towards.cross(right).transpose(), towards.transpose();
    light_ = axes_ * Eigen::Vector3d(-0.3, -0.6, 0.74).normalized();
    if (!up.isZero(0.0) && up.normalized() != Eigen::Vector3d::UnitZ())
      axes_ *= Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  }

  /// A place of the scene as it is seen [m]: to the right, upwards, towards the viewer.
  Eigen::Vector3d seen(const Eigen::Vector3d& x) const { return axes_ * x; }
  /// The direction towards the light, as seen: of length 1.
  const Eigen::Vector3d& light() const { return light_; }

 private:
  Eigen::Matrix3d axes_;
  Eigen::Vector3d light_;
};

}  // namespace dartboard
