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

/// - ln e for 0 < e < 1: for the mantissa m by 2 atanh((1 - m) / (1 + m)), whose argument is at most 1/3, so that the
/// rest after 18 terms is below 3^-36.
double minus_log(double e) {
  int exponent = 0;
  const double mantissa = std::frexp(e, &exponent);
  const double z = (1.0 - mantissa) / (1.0 + mantissa), square = z * z;
  double sum = 0.0;
  for (int k = 18; k >= 0; --k) sum = sum * square + 1.0 / (2 * k + 1);
  return 2.0 * z * sum - exponent * std::numbers::ln2;
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
  require(mass_behind >= 0.0 && std::isfinite(mass_behind), "mass behind", mass_behind, "at least 0");
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

double ContactLaw::damping_ratio() const {
  if (restitution == 1.0) return 0.0;
  const double log = minus_log(restitution);
  return log / std::sqrt(std::numbers::pi * std::numbers::pi + log * log);
}

double ContactLaw::damping(double ratio, double area, double mass, double d) const {
  if (!(d > 0.0)) return 0.0;
  // kappa d^(p-2) is the force over the depth: the same product for every p
  return ratio * std::sqrt(2.0 * exponent * mass * force(area, d) / d);
}

}  // namespace dartboard
