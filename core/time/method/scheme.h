#pragma once
// The properties of an integrator: its order, its stability function, what it evaluates and solves.

#include <Eigen/Core>
#include <limits>
#include <string_view>

namespace dartboard {

/// The properties of a time integration method, as theory states them.
///
/// `amplification(theta, zeta)` is the matrix of one step on the test oscillator q'' + 2 zeta omega q' + omega^2 q = 0
/// with theta = h omega, acting on (omega q, v); methods of k steps have 2k rows, the latest state first. For zeta = 0
/// its eigenvalues are R(i theta) and R(-i theta) of a one-step method.
struct Scheme {
  static constexpr double unlimited = std::numeric_limits<double>::infinity();

  std::string_view name;  // as a user types it
  std::string_view what;  // one line
  int order = 1;
  int stages = 1;              // force evaluations per step; of an implicit method: systems of equations per step
  bool implicit = false;       // solves linear systems
  bool linearized = false;     // implicit, and does not iterate until its equations hold: the tangent counts
  bool symplectic = false;     // where nothing dissipates
  bool symmetric = false;      // a step of -h undoes a step of h, where nothing dissipates
  bool keeps_angular = false;  // angular momentum is exact; linear momentum is, for all
  bool compensated = false;    // carries on with the digits that rounding takes from the state
  bool sweeps = false;         // damps spring by spring: in a network `amplification` does not hold for zeta > 0
  bool one_step = true;        // false: keeps states of earlier steps, and starts again after a restart
  double imaginary_limit = 0;  // stable for zeta = 0 and 0 < theta <= this; `unlimited` when for all
  Eigen::MatrixXd (*amplification)(double theta, double zeta) = nullptr;
  std::string_view source;
};

/// h times the matrix of the test oscillator in the coordinates (omega q, v): the argument z of a method's R(z).
Eigen::Matrix2d test_oscillator(double theta, double zeta);

/// Largest modulus of an eigenvalue of the amplification.
double spectral_radius(const Scheme& scheme, double theta, double zeta);

/// The first theta at which the method amplifies the test oscillator by `gain` or more within `steps` steps.
///
/// There spectral_radius^steps = gain, which a run of that length can measure: for methods with weak growth it is far
/// above the limit for infinitely many steps. Found by scanning in steps of 1e-3 and bisection.
/// throws  InputError unless gain > 1 and steps > 0
/// returns `unlimited` when there is no such theta below `ceiling`
double stable_limit(const Scheme& scheme, double zeta, double steps, double gain, double ceiling = 20.0);

/// The limit for a run of a given duration instead of a number of steps: `phase` is the duration times omega, which is
/// phase / theta steps, and one at least. The shorter the steps, the less each of them may amplify.
double stable_limit_within(const Scheme& scheme, double zeta, double phase, double gain, double ceiling = 20.0);

/// Both on the negative real axis: the first h times rate at which the method amplifies v' = - rate v, a motion that
/// nothing but damping acts on. There the phase is the duration times the rate.
double damping_limit(const Scheme& scheme, double steps, double gain, double ceiling = 20.0);
double damping_limit_within(const Scheme& scheme, double phase, double gain, double ceiling = 20.0);

}  // namespace dartboard
