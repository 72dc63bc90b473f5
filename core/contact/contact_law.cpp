#include "core/contact/contact_law.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/plain/error.h"

namespace dartboard {
namespace {

double power(double u, int exponent) {
  double product = 1.0;
  for (int k = 0; k < exponent; ++k) product *= u;
  return product;
}

/// - ln u for u > 0: for the mantissa m by 2 atanh((1 - m) / (1 + m)), whose argument is at most 1/3, so that the rest
/// after 18 terms is below 3^-36.
double minus_log(double u) {
  int exponent = 0;
  const double mantissa = std::frexp(u, &exponent);
  const double z = (1.0 - mantissa) / (1.0 + mantissa), square = z * z;
  double sum = 0.0;
  for (int k = 18; k >= 0; --k) sum = sum * square + 1.0 / (2 * k + 1);
  return 2.0 * z * sum - exponent * std::numbers::ln2;
}

/// (s + s e + ln(1 - s e) - ln(1 + s)) / s^2, which falls from (1 - e^2) / 2 at s = 0 to minus infinity at 1 / e. Small
/// s have the series: the sum of (-s)^k (1 - (-e)^(k+2)) / (k + 2), whose terms of s <= 1/2 are below 2^-60 from 60 on.
double excess(double s, double e) {
  if (s > 0.5) return s * e < 1.0 ? (s * (1.0 + e) + minus_log(1.0 + s) - minus_log(1.0 - s * e)) / (s * s) : -1.0;
  double sum = 0.0, power_of_e = e * e, power_of_s = 1.0;
  sum += power_of_s * (1.0 - e) * (1.0 + e) / 2.0;
  for (int k = 1; k < 60; ++k) {
    power_of_e *= -e;
    power_of_s *= -s;
    sum += power_of_s * (1.0 - power_of_e) / (k + 2);
  }
  return sum;
}

}  // namespace

void ContactLaw::require_valid() const {
  const auto require = [](bool right, const char* name, double value, const char* expected) {
    if (!right) throw InputError(fmt::format("{} of a contact is {}, expected {}", name, value, expected));
  };
  require(pressure > 0.0 && std::isfinite(pressure), "pressure", pressure, "more than 0");
  require(depth > 0.0 && std::isfinite(depth), "depth", depth, "more than 0");
  require(exponent >= 2 && exponent <= 4, "exponent", exponent, "2, 3 or 4");
  require(restitution > 0.0 && restitution <= 1.0, "restitution", restitution, "more than 0 and at most 1");
  require(friction >= 0.0 && std::isfinite(friction), "friction", friction, "at least 0");
}

double ContactLaw::energy(double area, double d) const {
  return d > 0.0 ? area * pressure * depth / exponent * power(d / depth, exponent) : 0.0;
}

double ContactLaw::force(double area, double d) const {
  return d > 0.0 ? area * pressure * power(d / depth, exponent - 1) : 0.0;
}

double ContactLaw::stiffness(double area, double d) const {
  return d > 0.0 ? (exponent - 1) * area * pressure / depth * power(d / depth, exponent - 2) : 0.0;
}

double ContactLaw::mean_force(double area, double d0, double d1) const {
  if (!(d0 > 0.0 || d1 > 0.0)) return 0.0;
  const double u0 = d0 / depth, u1 = d1 / depth;
  double quotient = 0.0;  // of the differences of u^p, which is 0 below 0, and of u
  if (u0 > 0.0 && u1 > 0.0)
    for (int k = 0; k < exponent; ++k) quotient = quotient * u0 + power(u1, k);
  else
    quotient = power(u0 > 0.0 ? u0 : u1, exponent) / std::abs(u1 - u0);
  return area * pressure / exponent * quotient;
}

double ContactLaw::depth_at_rest(double load) const {
  const double share = load / pressure;
  if (exponent == 2) return depth * share;
  return depth * (exponent == 3 ? std::sqrt(share) : std::cbrt(share));
}

double ContactLaw::depth_at_impact(double energy_per_area) const {
  const double share = exponent * energy_per_area / (pressure * depth);
  if (exponent == 3) return depth * std::cbrt(share);
  return depth * (exponent == 2 ? std::sqrt(share) : std::sqrt(std::sqrt(share)));
}

double ContactLaw::loss() const {
  double low = 0.0, high = 1.0 / restitution;
  if (restitution == 1.0) return 0.0;
  for (;;) {
    const double middle = 0.5 * (low + high);
    if (!(low < middle && middle < high)) return low;
    (excess(middle, restitution) > 0.0 ? low : high) = middle;
  }
}

}  // namespace dartboard
