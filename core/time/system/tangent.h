#pragma once
// The derivatives of the spring forces: stiffness and damping, in 3x3 blocks per spring.

#include <Eigen/Core>
#include <span>
#include <vector>

#include "core/forces/compression.h"
#include "core/time/system/spring_system.h"

namespace dartboard {

/// The 3x3 blocks of one spring, by their eigenvalues along its direction d and across it.
///
/// K_e = k [(1 - L/l)(I - d d') + d d'] and C_e = c d d'. The force on the first end changes by K_e and C_e times the
/// motion of the second end relative to the first, plus a change of damping as the direction turns: that part,
/// c/l [(dv.d)(I - d d') + d dv' (I - d d')], is unsymmetric and left out, which every user of the tangent allows.
///
/// A spring of zero length has no direction and exerts no force (`spring_force`). Its K_e is k I, so that it resists
/// being pulled apart in every direction, and its C_e is zero.
struct SpringTangent {
  Eigen::Vector3d direction;  // unit, or zero for zero length
  double along;               // [N/m] k
  double across;              // [N/m] k (1 - L/l): negative where the spring is compressed
  double damping;             // [N s/m]

  Eigen::Matrix3d stiffness() const {
    return across * Eigen::Matrix3d::Identity() + (along - across) * direction * direction.transpose();
  }
  Eigen::Matrix3d damping_block() const { return damping * direction * direction.transpose(); }
};

/// The blocks of a spring from its length vector.
SpringTangent tangent_of(const Spring& spring, const Eigen::Vector3d& dx, Compression compression);

/// The blocks of all springs at positions x.
void evaluate_tangents(const SpringSystem& system, std::span<const Eigen::Vector3d> x, Compression compression,
                       std::vector<SpringTangent>& tangents);

/// y = K x; zero at fixed vertices and along held axes, whatever acts there.
void multiply_stiffness(const SpringSystem& system, std::span<const SpringTangent> tangents,
                        std::span<const Eigen::Vector3d> x, std::span<Eigen::Vector3d> y);

}  // namespace dartboard
