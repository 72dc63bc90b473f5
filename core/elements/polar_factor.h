#pragma once
// The rotation of a deformation: its polar factor.

#include <Eigen/Core>

namespace dartboard {

/// The rotation R nearest to F, det R = +1 also where F is inverted: F = R S with S symmetric.
///
/// It depends on F alone, so that forces are a function of positions: rotations that are kept and improved from step to
/// step cost an order of accuracy and the angular momentum. If F is flat in two directions, or turned inside out with
/// equal smallest stretches, the nearest rotation is not unique; one of them is returned. Zero gives the identity, and
/// an F that is not finite a result that is not finite.
/// cost    the largest root of a quartic by Newton's method; if F is nearly singular in two directions, an eigenvalue
///         problem
/// source  Markley, Journal of the Astronautical Sciences 41, 1993 (FOAM)
Eigen::Matrix3d polar_rotation(const Eigen::Matrix3d& f);

/// The matrix of cofactors, det(F) F^-T.
inline Eigen::Matrix3d cofactors(const Eigen::Matrix3d& f) {
  Eigen::Matrix3d c;
  c << f(1, 1) * f(2, 2) - f(1, 2) * f(2, 1), f(1, 2) * f(2, 0) - f(1, 0) * f(2, 2),
      f(1, 0) * f(2, 1) - f(1, 1) * f(2, 0),  //
      f(0, 2) * f(2, 1) - f(0, 1) * f(2, 2), f(0, 0) * f(2, 2) - f(0, 2) * f(2, 0),
      f(0, 1) * f(2, 0) - f(0, 0) * f(2, 1),  //
      f(0, 1) * f(1, 2) - f(0, 2) * f(1, 1), f(0, 2) * f(1, 0) - f(0, 0) * f(1, 2),
      f(0, 0) * f(1, 1) - f(0, 1) * f(1, 0);
  return c;
}

}  // namespace dartboard
