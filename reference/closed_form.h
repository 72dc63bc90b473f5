#pragma once
// Motions that can be written down: what any simulator of the same mechanics has to reproduce.

#include <Eigen/Core>
#include <complex>

namespace dartboard::reference {

/// Position and velocity of one point [m, m/s].
struct Flight {
  Eigen::Vector3d x, v;
};

/// A point falling for `t` seconds through a medium whose drag is viscosity * mass * velocity.
Flight free_fall(const Flight& start, const Eigen::Vector3d& gravity, double viscosity, double t);

/// A coordinate and its rate.
struct Swing {
  double q, v;
};

/// q'' + drag q' + omega2 q = 0 after `t` seconds; under-, critically and overdamped alike, and omega2 may be zero.
///
/// units   omega2 1/s^2, drag 1/s
Swing oscillate(double omega2, double drag, Swing start, double t);

/// Two masses on a line joined by a spring, both in a medium of that viscosity.
struct Dumbbell {
  double m1, m2;             // kg
  double stiffness;          // N/m
  double damping = 0.0;      // N s/m
  double rest_length = 0.0;  // m
  double viscosity = 0.0;    // 1/s
};

/// Positions and velocities of the two masses along the line; x1 < x2 as long as the formula holds.
struct DumbbellState {
  double x1, x2, v1, v2;
};

DumbbellState swing(const Dumbbell& body, const DumbbellState& start, double t);

/// Angular frequency [1/s] of mode j of a straight chain of n equal masses m on springs of stiffness k, along itself.
/// Fixed at both ends there are n + 1 springs and j = 1 .. n; with free ends n - 1 springs and j = 0 .. n - 1, where
/// j = 0 is the uniform motion. The highest j is omega_max.
double chain_omega_fixed(int n, double stiffness, double mass, int j);
double chain_omega_free(int n, double stiffness, double mass, int j);

/// What one step of classical Runge-Kutta multiplies exp(lambda t) by, z = h lambda: 1 + z + z^2/2 + z^3/6 + z^4/24.
std::complex<double> rk4_amplification(std::complex<double> z);

/// What n steps of classical Runge-Kutta make of q'' + drag q' + omega2 q = 0: its discretisation error is exact,
/// so a simulator is compared with it up to rounding.
Swing rk4_oscillate(double omega2, double drag, Swing start, double h, int n);

}  // namespace dartboard::reference
