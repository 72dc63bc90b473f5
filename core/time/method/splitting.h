#pragma once
// The tables of drifts and kicks of the splitting methods.

#include <Eigen/Core>
#include <span>

namespace dartboard {

/// Drifts x += a h v and kicks v += b h a(x) in turn, a drift first and `last_drift` at the end.
struct Splitting {
  std::span<const double> drifts, kicks;  // in units of h; each drift comes before the kick of its number
  double last_drift = 0.0;
};

/// Drift, kick, drift: h/2, h, h/2.
const Splitting& verlet_splitting();

/// a1 b1 a2 b2 a3 b3 a4 b3 a3 b2 a2 b1 a1; each of a and b sums to 1.
/// source  Blanes, Moan: Practical symplectic partitioned Runge-Kutta and Runge-Kutta-Nystrom methods, 2002, S6
const Splitting& blanes_moan_4_splitting();

/// One step on the test oscillator (scheme.h) where a kick for t is the flow of v' = a - B v at fixed x to order 4 in
/// t: v + t (1 - z/2 + z^2/6 - z^3/24) (a - B v), z = t B.
Eigen::MatrixXd splitting_amplification(const Splitting& splitting, double theta, double zeta);

}  // namespace dartboard
