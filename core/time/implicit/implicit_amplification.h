#pragma once
// Stability functions of the implicit methods, as matrices on the test oscillator (scheme.h).

#include <Eigen/Core>

namespace dartboard {

/// (I - Z)^-1.
Eigen::MatrixXd backward_euler_amplification(double theta, double zeta);
/// (I - Z/2)^-1 (I + Z/2).
Eigen::MatrixXd midpoint_amplification(double theta, double zeta);
/// (I + (1 - 2 gamma) Z) (I - gamma Z)^-2 with gamma = 1 - 1/sqrt(2): of the L-stable methods of two stages.
Eigen::MatrixXd two_stage_amplification(double theta, double zeta);
/// 3 y_n+1 = 4 y_n - y_n-1 + 2 Z y_n+1, on (y_n, y_n-1).
Eigen::MatrixXd bdf2_amplification(double theta, double zeta);

}  // namespace dartboard
