#pragma once
// The equation that implicit methods solve in a stage, and the residual of given velocities in it.

#include <vector>

#include "reference/schemes/network_state.h"

namespace dartboard::reference {

/// Forces of a network at positions and velocities, and the sizes of their terms; in extended precision.
struct StageForces {
  std::vector<Vector3<Extended>> acceleration;  // [m/s^2], zero where fixed
  std::vector<Extended> sizes;                  // [m/s^2] sums of the terms' sizes
};

/// r(w) = M (w - vh) - tau f(xh + tau w, w), f the forces at the end or Gonzalez's discrete gradient between xh and
/// xh + 2 tau w. A solution is w with r(w) = 0.
struct StageEquation {
  const SpringNetwork& network;
  std::vector<Vector3<Extended>> xh, vh;  // [m], [m/s]
  Extended tau;                           // [s]
  bool discrete_gradient = false;
  std::vector<Vector3<Extended>> guess{};  // [m/s] that a solver starts from; empty: vh
  Extended tolerance = 0;  // at which a solver may stop, of the largest of |vh| and tau |f| / m at its start
  Extended top_speed = 0;  // [m/s] of the step, for the rounding of tau w
  Extended xh_rounding = 0, speed_rounding = 0;  // [m], [m/s] the accuracy of xh, and of vh and w

  StageForces forces(const std::vector<Vector3<Extended>>& w) const;
  /// [m/s] The largest |r_i| / m_i that the tolerance and rounding in double allow; `at` are the forces at w.
  std::vector<Extended> allowed(const std::vector<Vector3<Extended>>& w, const StageForces& at) const;
  /// The largest |r_i| over the one allowed there. A fixed point has to keep vh.
  Extended excess(const std::vector<Vector3<Extended>>& w) const;
  /// [m/s] The start of a solver: the guess, or free points at rest if that has the lower incremental
  /// potential.
  std::vector<Vector3<Extended>> start() const;

  /// [J] The incremental potential at one w less that at another, and the sizes of its terms.
  struct Change {
    Extended value = 0, sizes = 0;
  };
  Change potential_change(const std::vector<Vector3<Extended>>& from, const std::vector<Vector3<Extended>>& to) const;

 private:
  void add_elements(const std::vector<Vector3<Extended>>& w, StageForces& result) const;
};

}  // namespace dartboard::reference
