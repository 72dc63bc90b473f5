#include "core/time/method/scheme.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "core/plain/error.h"

namespace dartboard {

Eigen::Matrix2d test_oscillator(double theta, double zeta) {
  Eigen::Matrix2d z;
  z << 0.0, theta, -theta, -2.0 * zeta * theta;
  return z;
}

double spectral_radius(const Scheme& scheme, double theta, double zeta) {
  const Eigen::MatrixXd a = scheme.amplification(theta, zeta);
  if (a.rows() != 2) return a.eigenvalues().cwiseAbs().maxCoeff();
  const double mean = (a(0, 0) + a(1, 1)) / 2, half = (a(0, 0) - a(1, 1)) / 2;
  const double discriminant = half * half + a(0, 1) * a(1, 0);
  return discriminant < 0 ? std::hypot(mean, std::sqrt(-discriminant)) : std::abs(mean) + std::sqrt(discriminant);
}

namespace {

// The first argument above 0 at which the radius grows too fast for a run of so many steps; a radius that is not a
// number counts as growth.
template <class Radius, class Steps>
double first_growth(const Radius& radius, const Steps& steps, double gain, double ceiling) {
  if (!(gain > 1.0) || !(steps(1.0) > 0.0)) throw InputError("a stability limit needs a gain above 1 and some steps");
  const auto stable = [&, logarithm = std::log(gain)](double at) {
    return std::log(radius(at)) < logarithm / steps(at);
  };
  constexpr double scan = 1e-3;
  for (int i = 1; i * scan <= ceiling; ++i) {
    if (stable(i * scan)) continue;
    double low = (i - 1) * scan, high = i * scan;
    // a limit below the first step of the scan is searched by powers of 1024: bisection stays near the large numbers
    for (int k = 0; low == 0.0 && k < 100; ++k) (stable(high / 1024) ? low : high) = high / 1024;
    for (int k = 0; k < 40; ++k) {
      const double middle = (low + high) / 2;
      (stable(middle) ? low : high) = middle;
    }
    return low;
  }
  return Scheme::unlimited;
}

auto always(double steps) {
  return [steps](double) { return steps; };
}
auto within(double phase) {
  return [phase](double theta) { return std::max(1.0, phase / theta); };
}

auto oscillation(const Scheme& scheme, double zeta) {
  return [&scheme, zeta](double theta) { return spectral_radius(scheme, theta, zeta); };
}
// An oscillation so slow that it does nothing in a step, damped at the given rate: 2 zeta theta is h times the rate.
auto decay(const Scheme& scheme) {
  constexpr double slow = 1e-9;
  return [&scheme](double z) { return spectral_radius(scheme, slow, z / (2 * slow)); };
}

}  // namespace

double stable_limit(const Scheme& scheme, double zeta, double steps, double gain, double ceiling) {
  return first_growth(oscillation(scheme, zeta), always(steps), gain, ceiling);
}

double stable_limit_within(const Scheme& scheme, double zeta, double phase, double gain, double ceiling) {
  return first_growth(oscillation(scheme, zeta), within(phase), gain, ceiling);
}

double damping_limit(const Scheme& scheme, double steps, double gain, double ceiling) {
  return first_growth(decay(scheme), always(steps), gain, ceiling);
}

double damping_limit_within(const Scheme& scheme, double phase, double gain, double ceiling) {
  return first_growth(decay(scheme), within(phase), gain, ceiling);
}

}  // namespace dartboard
