#include "validation/stability/amplification_study.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "core/plain/error.h"
#include "reference/closed_form.h"

namespace dartboard {
namespace {

using Complex = std::complex<double>;

constexpr double omega = 2.0, length = 2.0;
constexpr double size = 0.125;  // of the start: far from where stages would turn the spring over
constexpr double ulp = 2 * std::numeric_limits<double>::epsilon();  // of positions between 2 and 4

// The eigenvalue above the real axis of a matrix of determinant d and trace t.
Complex upper_eigenvalue(long double trace, long double determinant) {
  const long double mean = trace / 2, below = determinant - mean * mean;
  return {static_cast<double>(mean), static_cast<double>(below > 0 ? std::sqrt(below) : 0)};
}

/// (omega q, v) after each of so many steps from (1, 0) or (0, 1) times `size`, as columns: the powers of the step's
/// matrix.
std::vector<Eigen::Matrix2d> powers(const IntegratorEntry& entry, double theta, int steps) {
  std::vector<Eigen::Matrix2d> result(static_cast<std::size_t>(steps));
  for (int column = 0; column < 2; ++column) {
    const auto integrator = entry.make();
    const std::array<SpringEnds, 1> ends{{{0, 1}}};
    const std::vector<Spring> springs{{length, omega * omega, 0.0}};
    const std::array<double, 2> mass{1.0, 1.0}, viscosity{0.0, 0.0};
    const std::array<std::uint8_t, 2> fixed{1, 0};
    const SpringSystem system{ends, springs, mass, mass, viscosity, fixed, {0, 0, 0}};
    std::array<Eigen::Vector3d, 2> x{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(length, 0, 0)};
    std::array<Eigen::Vector3d, 2> v{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0, 0, 0)};
    if (column == 0)
      x[1].x() += size / omega;
    else
      v[1].x() = size;
    for (Eigen::Matrix2d& power : result) {
      const StepResult step = integrator->step(system, {x, v}, theta / omega);
      if (!step.ok()) throw SolverError(fmt::format("{} at h omega = {:g}: {}", entry.name, theta, to_string(step)));
      power.col(column) << omega / size * (x[1].x() - length), v[1].x() / size;
    }
  }
  return result;
}

// For methods whose matrix is a function of the oscillator's [0 theta; -theta 0]: a + b J is the number a + b i.
Complex as_number(const Eigen::Matrix2d& m) { return {(m(0, 0) + m(1, 1)) / 2, (m(0, 1) - m(1, 0)) / 2}; }

// For z_n+1 = s z_n + p z_n-1, from z_0 = 1 and three steps: the root of r^2 = s r + p nearer to that of theory.
Complex root_of_recurrence(const std::vector<Eigen::Matrix2d>& z, Complex expected) {
  Eigen::Matrix2cd a;
  a << as_number(z[0]), 1.0, as_number(z[1]), as_number(z[0]);
  const Eigen::Vector2cd sp = a.inverse() * Eigen::Vector2cd(as_number(z[1]), as_number(z[2]));
  const Complex half = sp[0] / 2.0, root = std::sqrt(half * half + sp[1]);
  const Complex one = half + root, other = half - root;
  return std::abs(one - expected) < std::abs(other - expected) ? one : other;
}

double turn_of(Complex r) { return std::arg(r) < 0.0 ? std::arg(r) + 2 * std::numbers::pi : std::arg(r); }
double ratio_of(Complex r) { return -std::log(std::abs(r)) / turn_of(r); }

}  // namespace

double AmplificationPoint::phase() const { return turn_of(measured); }
double AmplificationPoint::theoretical_phase() const { return turn_of(theory); }
double AmplificationPoint::damping_ratio() const { return ratio_of(measured); }
double AmplificationPoint::theoretical_damping_ratio() const { return ratio_of(theory); }

Complex theoretical_amplification(const Scheme& scheme, double theta) {
  const Complex z(0.0, theta);
  const std::string_view name = scheme.name;
  if (name == "explicit-euler") return 1.0 + z;
  if (name == "symplectic-euler" || name.starts_with("verlet"))
    return std::polar(1.0, static_cast<double>(reference::splitting_phase(theta)));
  if (name.starts_with("blanes-moan-4")) {
    const auto step = reference::blanes_moan_step(theta, 0.0L);
    return upper_eigenvalue(step.trace(), step.determinant());
  }
  if (name == "rk4") return reference::rk4_amplification(z);
  if (name == "dormand-prince-54") return reference::dormand_prince_amplification(z);
  if (name == "backward-euler" || name == "baraff-witkin" || name == "local-global")
    return reference::backward_euler_amplification(z);
  if (name == "ros2" || name == "sdirk2") return reference::two_stage_amplification(z);
  if (name == "implicit-midpoint" || name == "energy-momentum") return reference::implicit_midpoint_amplification(z);
  if (name == "bdf2") return reference::bdf2_roots(z)[0];
  throw InputError(fmt::format("there is no closed form for {}", name));
}

std::vector<double> amplification_steps(int per_decade) {
  std::vector<double> thetas;
  for (int k = -2 * per_decade; k <= 3 * per_decade; ++k)
    thetas.push_back(std::pow(10.0, static_cast<double>(k) / per_decade));
  return thetas;
}

std::vector<AmplificationPoint> measure_amplification(std::span<const double> thetas,
                                                      std::span<const IntegratorEntry> entries) {
  std::vector<AmplificationPoint> points;
  for (const IntegratorEntry& entry : entries) {
    const auto integrator = entry.make();
    const Scheme& scheme = integrator->scheme();
    for (const double theta : thetas) {
      if (theta > 0.99 * scheme.imaginary_limit) continue;
      AmplificationPoint p{std::string(entry.name), scheme.implicit, theta, {}, {}, 0.0};
      p.theory = theoretical_amplification(scheme, theta);
      // an entry of the matrix is off by some tens of roundings of a position, in lengths, residuals and solutions, and
      // the eigenvalue by as much
      p.tolerance = 64 * omega * ulp / size / std::abs(p.theory);
      if (scheme.one_step) {
        const Eigen::Matrix2d step = powers(entry, theta, 1).front();
        // the matrices of splittings are no rotations: their eigenvectors are inclined, and rounding counts as much
        // more
        const bool inclined = scheme.symplectic && !scheme.implicit;
        p.measured = inclined ? upper_eigenvalue(step.trace(), step.determinant()) : as_number(step);
        if (inclined) p.tolerance *= 2.0 / std::abs(p.theory.imag());
      } else {
        p.measured = root_of_recurrence(powers(entry, theta, 3), p.theory);
        // the start is a step of backward Euler: its distance from the root separates the two roots of the recurrence
        const Complex z(0.0, theta), start = reference::backward_euler_amplification(z);
        p.tolerance /= std::abs(start - p.theory);
      }
      points.push_back(std::move(p));
    }
  }
  return points;
}

}  // namespace dartboard
