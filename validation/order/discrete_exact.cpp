#include "validation/order/discrete_exact.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "core/plain/error.h"
#include "core/plain/nan_maximum.h"
#include "reference/closed_form.h"

namespace dartboard {
namespace {

using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using Vector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

constexpr double omega = 2.0, length = 2.0;

Vector apply_power(Matrix square, std::uint64_t n, Vector state) {
  for (; n > 0; n /= 2) {
    if (n % 2 == 1) state = square * state;
    square = (square * square).eval();
  }
  return state;
}

double step_of(const Scheme& scheme, double zeta, std::uint64_t steps) {
  double theta = 0.25;
  const auto change = [&] {
    return std::abs(std::log(spectral_radius(scheme, theta, zeta))) * static_cast<double>(steps);
  };
  while (!(change() <= 1.0) && theta > 0x1p-20) theta /= 2;
  return theta;
}

}  // namespace

DiscreteExact compare_with_discrete_map(const IntegratorEntry& entry, double zeta, std::uint64_t steps) {
  const auto integrator = entry.make();
  const Scheme& scheme = integrator->scheme();
  if (scheme.amplification == nullptr) throw InputError(fmt::format("{} does not state its amplification", entry.name));
  DiscreteExact result{std::string(entry.name), zeta, step_of(scheme, zeta, steps), steps, 0.0, ""};
  // not the integrator's own coefficients, with which a wrong one would agree
  Matrix amplification = scheme.amplification(result.h_omega, zeta).cast<long double>();
  if (entry.name.starts_with("blanes-moan-4")) amplification = reference::blanes_moan_step(result.h_omega, zeta);
  const auto rows = static_cast<std::uint64_t>(amplification.rows());

  // the wall, and a mass of 1 at q = 1/8 with velocity 1/4
  const std::array<SpringEnds, 1> ends{{{0, 1}}};
  const std::vector<Spring> springs{{length, omega * omega, 2.0 * zeta * omega}};
  const std::array<double, 2> mass{1.0, 1.0}, viscosity{0.0, 0.0};
  const std::array<std::uint8_t, 2> fixed{1, 0};
  const SpringSystem system{ends, springs, mass, mass, viscosity, fixed, {0, 0, 0}};
  std::array<Eigen::Vector3d, 2> x{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(length + 0.125, 0, 0)};
  std::array<Eigen::Vector3d, 2> v{Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(0.25, 0, 0)};

  const auto state = [&] { return std::array<long double, 2>{omega * (x[1].x() - length), v[1].x()}; };
  Vector exact(static_cast<Eigen::Index>(rows));  // the latest state first
  const auto remember = [&] {
    for (Eigen::Index k = exact.size() - 1; k >= 2; --k) exact[k] = exact[k - 2];
    exact[0] = state()[0];
    exact[1] = state()[1];
  };
  exact.setZero();
  remember();
  std::uint64_t known = 1;  // states
  for (std::uint64_t k = 0; k < steps; ++k) {
    const StepResult step = integrator->step(system, {x, v}, result.h_omega / omega);
    if (!step.ok()) {
      result.diagnosis = to_string(step);
      result.deviation = std::numeric_limits<double>::infinity();
      return result;
    }
    if (2 * known < rows) {
      remember();
      ++known;
    }
  }
  exact = apply_power(amplification, steps + 1 - known, exact);
  result.deviation = static_cast<double>(max_or_nan(std::abs(state()[0] - exact[0]), std::abs(state()[1] - exact[1])));
  return result;
}

}  // namespace dartboard
