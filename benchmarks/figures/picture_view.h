#pragma once
// The direction from which bodies are seen.

#include <Eigen/Geometry>

namespace dartboard {

/// A view along parallels.
class PictureView {
 public:
  /// `up` is the direction that is shown upwards; z where it is zero. Bodies are seen from the direction `from`; where
  /// that is zero, from the front, a little from the right and above.
  explicit PictureView(const Eigen::Vector3d& up = Eigen::Vector3d::UnitZ(),
                       const Eigen::Vector3d& from = Eigen::Vector3d::Zero()) {
    const Eigen::Matrix3d upright = axes_towards(Eigen::Vector3d(0.45, -0.8, 0.4), Eigen::Vector3d::UnitZ());
    light_ = upright * Eigen::Vector3d(-0.3, -0.6, 0.74).normalized();
    const bool is_z = up.isZero(0.0) || up.normalized() == Eigen::Vector3d::UnitZ();
    if (!from.isZero(0.0))
      axes_ = axes_towards(from, is_z ? Eigen::Vector3d::UnitZ() : up);
    else
      axes_ = is_z ? upright
                   : upright * Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  }

  /// A place of the scene as it is seen [m]: to the right, upwards, towards the viewer.
  Eigen::Vector3d seen(const Eigen::Vector3d& x) const { return axes_ * x; }
  /// The direction towards the light, as seen: of length 1.
  const Eigen::Vector3d& light() const { return light_; }

 private:
  /// Rows: to the right, upwards, towards the viewer. Where that is up or down, y is upwards, or else z.
  static Eigen::Matrix3d axes_towards(const Eigen::Vector3d& viewer, const Eigen::Vector3d& up) {
    const Eigen::Vector3d towards = viewer.normalized();
    Eigen::Vector3d right = up.normalized().cross(towards);
    if (right.norm() < 1e-9) right = Eigen::Vector3d::UnitY().cross(towards);
    if (right.norm() < 1e-9) right = Eigen::Vector3d::UnitZ().cross(towards);
    Eigen::Matrix3d axes;
    axes << right.normalized().transpose(), towards.cross(right.normalized()).transpose(), towards.transpose();
    return axes;
  }

  Eigen::Matrix3d axes_;
  Eigen::Vector3d light_;
};

}  // namespace dartboard
