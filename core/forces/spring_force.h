#pragma once
// The force of one spring (section 4.1), written once for every walk and every integrator.

#include <Eigen/Core>
#include <cmath>
#include <type_traits>

#include "core/forces/springs.h"

namespace dartboard {

/// a'b, in the order of its terms. Compilers do not find by themselves that two of its products are one instruction.
inline double dot(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  using Two = double __attribute__((vector_size(16)));
  const Two products = Two{a[0], a[1]} * Two{b[0], b[1]};
  return products[0] + products[1] + a[2] * b[2];
}

/// Force [N] that a spring exerts on its first end; the second end gets the opposite.
///
/// k (l - L) + c (dv . u) along u, the direction from the first end to the second; zero for zero length, where there
/// is no direction. Exchanging the ends changes the sign of every intermediate exactly, so either end may come first.
template <class SomeSpring = Spring>  // or UndampedSpring
inline Eigen::Vector3d spring_force(const SomeSpring& spring, const Eigen::Vector3d& dx,
                                    [[maybe_unused]] const Eigen::Vector3d& dv) {
  const double length = std::sqrt(dot(dx, dx));
  if (length == 0.0) return Eigen::Vector3d::Zero();
  const double inverse = 1.0 / length;
  double tension = spring.stiffness * (length - spring.rest_length);
  if constexpr (std::is_same_v<SomeSpring, Spring>) tension += spring.damping * (dot(dv, dx) * inverse);
  return (tension * inverse) * dx;
}

}  // namespace dartboard
