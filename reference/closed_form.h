#pragma once
// Motions in closed form, which any simulator of the same mechanics has to reproduce.

#include <Eigen/Core>
#include <array>
#include <complex>
#include <span>
#include <vector>

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

/// q'' + drag q' + omega2 q = 0 after `t` seconds; under-, critically or overdamped, and omega2 may be zero.
///
/// pre     drag >= 0
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

/// Of a chain with one end fixed and the other free: n springs, j = 1 .. n.
double chain_omega_fixed_free(int n, double stiffness, double mass, int j);

/// Displacement of mass i = 1 .. n of the chain in its mode j, up to a factor; the fixed end comes first.
double chain_shape_fixed(int n, int j, int i);
double chain_shape_free(int n, int j, int i);
double chain_shape_fixed_free(int n, int j, int i);

/// Angular frequency [1/s] of a wave of wave number q [1/m] along an endless chain of that spacing [m], and the
/// velocity [m/s] at which packets of such waves travel.
double chain_dispersion(double stiffness, double mass, double spacing, double q);
double chain_group_velocity(double stiffness, double mass, double spacing, double q);

/// Length [m] of a spring whose two masses circle at `rate` [1/s] about their centre; a relative equilibrium, possible
/// while reduced_mass rate^2 < stiffness.
double rotating_length(double stiffness, double rest_length, double reduced_mass, double rate);

/// Lengths [m], from the top, of the equal springs of a chain that hangs at rest from a fixed point, masses [kg] from
/// the top.
std::vector<double> hanging_lengths(std::span<const double> masses, double stiffness, double rest_length,
                                    double gravity);

// ---- The exact results of methods for such motions: a simulator is compared with these up to rounding

/// The factor of exp(lambda t) in one step of classical Runge-Kutta, z = h lambda: 1 + z + z^2/2 + z^3/6 + z^4/24.
std::complex<double> rk4_amplification(std::complex<double> z);

/// The result of n steps of classical Runge-Kutta for q'' + drag q' + omega2 q = 0: its discretisation error is exact,
/// so a simulator is compared with it up to rounding.
Swing rk4_oscillate(double omega2, double drag, Swing start, double h, int n);

/// The factors of exp(lambda t) in one step of backward Euler and of the implicit midpoint rule, z = h lambda:
/// 1/(1 - z) and (1 + z/2)/(1 - z/2).
std::complex<double> backward_euler_amplification(std::complex<double> z);
std::complex<double> implicit_midpoint_amplification(std::complex<double> z);

/// The factor of Dormand and Prince's method: the exponential series to z^5, and z^6/600.
std::complex<double> dormand_prince_amplification(std::complex<double> z);
/// The factor of the L-stable methods of two stages, gamma = 1 - 1/sqrt(2): (1 + (1 - 2 gamma) z) / (1 - gamma z)^2.
std::complex<double> two_stage_amplification(std::complex<double> z);
/// The two roots of (3 - 2 z) r^2 - 4 r + 1 = 0, the factors of the two solutions of BDF2; the first tends to 1 as
/// z -> 0, the other, which the start excites, to 1/3.
std::array<std::complex<double>, 2> bdf2_roots(std::complex<double> z);

/// The angle by which symplectic Euler and Verlet turn an oscillation in one step, theta = h omega < 2: 2
/// asin(theta/2).
long double splitting_phase(long double theta);

/// Drifts a and kicks b of the splitting S6 of order 4, in units of the step: a1 b1 a2 b2 a3 b3 a4 b3 a3 b2 a2 b1 a1.
struct BlanesMoanNumbers {
  std::array<long double, 4> a;
  std::array<long double, 3> b;
};
/// As published: a1, a2, a3, b1, b2 to 15 digits, a4 and b3 from the sums that they complete.
/// source  Blanes, Moan: Practical symplectic partitioned Runge-Kutta and Runge-Kutta-Nystrom methods, Journal of
///         Computational and Applied Mathematics 142 (2002), 313-330, S6 of order 4
BlanesMoanNumbers blanes_moan_numbers();
/// The matrix of one step of it on (omega q, v), theta = h omega: unit triangular factors. With a damping ratio each
/// kick for t is v + t (1 - z/2 + z^2/6 - z^3/24) (a - B v) with B = 2 zeta omega, z = t B.
Eigen::Matrix<long double, 2, 2> blanes_moan_step(long double theta, long double zeta);

/// The two orders in which half and whole steps alternate.
enum class VerletForm { drift_kick_drift, kick_drift_kick };

/// The result of n steps of Verlet for q'' + omega2 q = 0; h^2 omega2 < 4.
Swing verlet_oscillate(VerletForm form, double omega2, Swing start, double h, int n);
/// The result of n steps of symplectic Euler (kick, then drift) for the same.
Swing symplectic_euler_oscillate(double omega2, Swing start, double h, int n);

/// The quadratic form near the energy that the method conserves exactly: v^2/2 + omega2 (1 - h^2 omega2/4) q^2/2 for
/// kick, drift, kick; (1 - h^2 omega2/4) v^2/2 + omega2 q^2/2 for drift, kick, drift.
double verlet_invariant(VerletForm form, double omega2, double h, Swing at);
/// v^2/2 + omega2 q^2/2 - h omega2 q v/2 for kick, then drift.
double symplectic_euler_invariant(double omega2, double h, Swing at);

/// A fall in n steps whose positions follow the velocity of the start (explicit Euler) or of the end (symplectic and
/// backward Euler) of each step: off the parabola by -+ gravity h t / 2.
enum class EulerForm { start_velocity, end_velocity };
Flight euler_fall(EulerForm form, const Flight& start, const Eigen::Vector3d& gravity, double h, int n);

}  // namespace dartboard::reference
