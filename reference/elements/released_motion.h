#pragma once
// The small motion of a solid that is bent by forces and then released, in closed form.

#include <Eigen/Core>
#include <cstddef>

#include "reference/elements/held_factor.h"

namespace dartboard::reference {

/// M u'' = - K u from u(0) = K^-1 f, u'(0) = 0, in the space of the load's own Ritz vectors: K^-1 f, then K^-1 M of the
/// one before, each orthogonal to those before it. These are the Lanczos vectors from the start of the motion, so that
/// few of them represent it, and no vector is used for modes that the force does not excite: a body of few frequencies
/// is exact as soon as there are as many vectors.
///
/// source  Wilson, Yuan, Dickens: Dynamic analysis by direct superposition of Ritz vectors, 1982
class ReleasedMotion {
 public:
  /// pre  force is not zero where the solid is free
  ReleasedMotion(const HeldFactor& solid, const Eigen::VectorXd& force, std::size_t vectors = 60);

  /// The displacements [m] at t [s].
  Eigen::VectorXd displacements(double t) const;
  std::size_t vectors() const { return static_cast<std::size_t>(omega_.size()); }

 private:
  Eigen::MatrixXd shapes_;  // [m] one for each frequency, with the amplitude of its part
  Eigen::VectorXd omega_;   // [1/s]
};

}  // namespace dartboard::reference
