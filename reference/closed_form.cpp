#include "reference/closed_form.h"

#include <cmath>
#include <numbers>

namespace dartboard::reference {
namespace {

// (1 - exp(-z)) / z, and (z - 1 + exp(-z)) / z^2: the weights of velocity and gravity in a fall with drag.
double first_weight(double z) { return z == 0.0 ? 1.0 : -std::expm1(-z) / z; }

double second_weight(double z) {
  if (std::abs(z) > 0.5) return (z + std::expm1(-z)) / (z * z);
  // the difference cancels; its series is 1/2 - z/6 + z^2/24 - ..., and 0.5^15 / 17! is far below rounding
  double sum = 0.0, term = 0.5;
  for (int k = 3; k < 18; ++k) {
    sum += term;
    term *= -z / k;
  }
  return sum;
}

// The n-th step of a map of determinant 1 and trace 2 cos(phi), which turns along an ellipse: its n-th power has the
// diagonal cos(n phi) +- skew sin(n phi) / sin(phi), skew being half the difference of the diagonal, and the
// off-diagonals times sin(n phi) / sin(phi). Extended precision, since n phi is large.
Swing turn(long double phi, long double skew, long double q_from_v, long double v_from_q, Swing start, int n) {
  const long double even = std::cos(n * phi), odd = std::sin(n * phi) / std::sin(phi);
  const long double q = start.q, v = start.v;
  return {static_cast<double>((even + skew * odd) * q + q_from_v * odd * v),
          static_cast<double>(v_from_q * odd * q + (even - skew * odd) * v)};
}

}  // namespace

Flight free_fall(const Flight& start, const Eigen::Vector3d& gravity, double viscosity, double t) {
  const double z = viscosity * t;
  const double w1 = first_weight(z);
  return {start.x + t * w1 * start.v + t * t * second_weight(z) * gravity, std::exp(-z) * start.v + t * w1 * gravity};
}

Swing oscillate(double omega2, double drag, Swing start, double t) {
  const double beta = drag / 2.0;
  const double below = omega2 - beta * beta;
  // q = even(t) q0 + odd(t) (v0 + beta q0), where even and odd are exp(-beta t) times cos and sin/omega, 1 and t, or
  // cosh and sinh/omega. The last are written with the two real roots, so that no large exponentials meet.
  double even, odd, rate;  // rate: the derivative of odd, plus beta odd
  if (below > 0.0) {
    const double w = std::sqrt(below), decay = std::exp(-beta * t);
    even = rate = decay * std::cos(w * t);
    odd = decay * std::sin(w * t) / w;
  } else if (below == 0.0) {
    even = rate = std::exp(-beta * t);
    odd = even * t;
  } else {
    const double w = std::sqrt(-below);
    const double slow = -omega2 / (beta + w), fast = -(beta + w);
    even = rate = (std::exp(slow * t) + std::exp(fast * t)) / 2.0;
    odd = std::exp(slow * t) * -std::expm1(-2.0 * w * t) / (2.0 * w);
  }
  const double q = even * start.q + odd * (start.v + beta * start.q);
  // from q'' + 2 beta q' + omega2 q = 0: q' = rate v0 - odd (beta v0 + omega2 q0)
  const double v = rate * start.v - odd * (beta * start.v + omega2 * start.q);
  return {q, v};
}

DumbbellState swing(const Dumbbell& body, const DumbbellState& start, double t) {
  const double m = body.m1 + body.m2;
  const double reduced = body.m1 * body.m2 / m;

  // the centre of mass flies on, the distance oscillates about the rest length
  const double x = (body.m1 * start.x1 + body.m2 * start.x2) / m;
  const double v = (body.m1 * start.v1 + body.m2 * start.v2) / m;
  const double z = body.viscosity * t;
  const double centre = x + t * first_weight(z) * v;
  const double drift = std::exp(-z) * v;
  const Swing gap = oscillate(body.stiffness / reduced, body.damping / reduced + body.viscosity,
                              {start.x2 - start.x1 - body.rest_length, start.v2 - start.v1}, t);

  const double distance = body.rest_length + gap.q;
  return {centre - body.m2 / m * distance, centre + body.m1 / m * distance, drift - body.m2 / m * gap.v,
          drift + body.m1 / m * gap.v};
}

double chain_omega_fixed(int n, double stiffness, double mass, int j) {
  return 2.0 * std::sqrt(stiffness / mass) * std::sin(j * std::numbers::pi / (2.0 * (n + 1)));
}

double chain_omega_free(int n, double stiffness, double mass, int j) {
  return 2.0 * std::sqrt(stiffness / mass) * std::sin(j * std::numbers::pi / (2.0 * n));
}

double chain_omega_fixed_free(int n, double stiffness, double mass, int j) {
  return 2.0 * std::sqrt(stiffness / mass) * std::sin((2 * j - 1) * std::numbers::pi / (2.0 * (2 * n + 1)));
}

double chain_shape_fixed(int n, int j, int i) { return std::sin(i * j * std::numbers::pi / (n + 1)); }

double chain_shape_free(int n, int j, int i) { return std::cos((2 * i - 1) * j * std::numbers::pi / (2 * n)); }

double chain_shape_fixed_free(int n, int j, int i) {
  return std::sin(i * (2 * j - 1) * std::numbers::pi / (2 * n + 1));
}

double chain_dispersion(double stiffness, double mass, double spacing, double q) {
  return 2.0 * std::sqrt(stiffness / mass) * std::abs(std::sin(q * spacing / 2.0));
}

double chain_group_velocity(double stiffness, double mass, double spacing, double q) {
  const double sign = std::sin(q * spacing / 2.0) < 0.0 ? -1.0 : 1.0;
  return sign * spacing * std::sqrt(stiffness / mass) * std::cos(q * spacing / 2.0);
}

double rotating_length(double stiffness, double rest_length, double reduced_mass, double rate) {
  return rest_length / (1.0 - reduced_mass * rate * rate / stiffness);
}

std::vector<double> hanging_lengths(std::span<const double> masses, double stiffness, double rest_length,
                                    double gravity) {
  std::vector<double> lengths(masses.size());
  double below = 0.0;
  for (std::size_t i = masses.size(); i-- > 0;) {
    below += masses[i];
    lengths[i] = rest_length + gravity * below / stiffness;
  }
  return lengths;
}

std::complex<double> rk4_amplification(std::complex<double> z) {
  return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0)));
}

Swing rk4_oscillate(double omega2, double drag, Swing start, double h, int n) {
  Eigen::Matrix2d z;
  z << 0.0, h, -h * omega2, -h * drag;
  const Eigen::Matrix2d one = Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d step = one + z * (one + z / 2.0 * (one + z / 3.0 * (one + z / 4.0)));
  Eigen::Vector2d y(start.q, start.v);
  for (; n > 0; --n) y = step * y;
  return {y[0], y[1]};
}

std::complex<double> backward_euler_amplification(std::complex<double> z) { return 1.0 / (1.0 - z); }

std::complex<double> implicit_midpoint_amplification(std::complex<double> z) {
  return (1.0 + z / 2.0) / (1.0 - z / 2.0);
}

std::complex<double> dormand_prince_amplification(std::complex<double> z) {
  return 1.0 + z * (1.0 + z / 2.0 * (1.0 + z / 3.0 * (1.0 + z / 4.0 * (1.0 + z / 5.0 * (1.0 + z / 5.0)))));
}

std::complex<double> two_stage_amplification(std::complex<double> z) {
  const double gamma = 1.0 - 1.0 / std::numbers::sqrt2;
  const std::complex<double> below = 1.0 - gamma * z;
  return (1.0 + (1.0 - 2.0 * gamma) * z) / (below * below);
}

std::array<std::complex<double>, 2> bdf2_roots(std::complex<double> z) {
  const std::complex<double> root = std::sqrt(1.0 + 2.0 * z), below = 3.0 - 2.0 * z;
  return {(2.0 + root) / below, (2.0 - root) / below};
}

long double splitting_phase(long double theta) { return 2.0L * std::asin(theta / 2.0L); }

Swing verlet_oscillate(VerletForm form, double omega2, Swing start, double h, int n) {
  const long double step = h, square = step * step * omega2, less = 1.0L - square / 4.0L;
  const bool drift_first = form == VerletForm::drift_kick_drift;
  return turn(splitting_phase(std::sqrt(square)), 0.0L, drift_first ? step * less : step,
              -step * omega2 * (drift_first ? 1.0L : less), start, n);
}

Swing symplectic_euler_oscillate(double omega2, Swing start, double h, int n) {
  const long double step = h, square = step * step * omega2;
  return turn(splitting_phase(std::sqrt(square)), -square / 2.0L, step, -step * omega2, start, n);
}

BlanesMoanNumbers blanes_moan_numbers() {
  const long double a1 = 0.0792036964311957L, a2 = 0.353172906049774L, a3 = -0.0420650803577195L;
  const long double b1 = 0.209515106613362L, b2 = -0.143851773179818L;
  return {{a1, a2, a3, 1.0L - 2.0L * (a1 + a2 + a3)}, {b1, b2, 0.5L - (b1 + b2)}};
}

Eigen::Matrix<long double, 2, 2> blanes_moan_step(long double theta, long double zeta) {
  const auto [a, b] = blanes_moan_numbers();
  const long double drifts[]{a[0], a[1], a[2], a[3], a[2], a[1], a[0]}, kicks[]{b[0], b[1], b[2], b[2], b[1], b[0]};
  Eigen::Matrix<long double, 2, 2> step, drift, kick;
  step << 1.0L, drifts[0] * theta, 0.0L, 1.0L;
  for (int k = 0; k < 6; ++k) {
    const long double t = kicks[k] * theta, z = 2.0L * zeta * t;
    const long double reach = t * (1.0L - z / 2.0L + z * z / 6.0L - z * z * z / 24.0L);
    kick << 1.0L, 0.0L, -reach, 1.0L - 2.0L * zeta * reach;
    drift << 1.0L, drifts[k + 1] * theta, 0.0L, 1.0L;
    step = (drift * kick * step).eval();
  }
  return step;
}

double verlet_invariant(VerletForm form, double omega2, double h, Swing at) {
  const double less = 1.0 - h * h * omega2 / 4.0;
  return form == VerletForm::drift_kick_drift ? (less * at.v * at.v + omega2 * at.q * at.q) / 2.0
                                              : (at.v * at.v + less * omega2 * at.q * at.q) / 2.0;
}

double symplectic_euler_invariant(double omega2, double h, Swing at) {
  return (at.v * at.v + omega2 * at.q * at.q - h * omega2 * at.q * at.v) / 2.0;
}

Flight euler_fall(EulerForm form, const Flight& start, const Eigen::Vector3d& gravity, double h, int n) {
  const double count = n, pairs = count * (form == EulerForm::end_velocity ? count + 1.0 : count - 1.0) / 2.0;
  return {start.x + count * h * start.v + h * h * pairs * gravity, start.v + count * h * gravity};
}

}  // namespace dartboard::reference
