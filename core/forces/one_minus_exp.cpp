#include "core/forces/one_minus_exp.h"

#include <cmath>
#include <limits>

namespace dartboard {

double one_minus_exp_of_minus(double z) {
  if (z > 64.0) return 1.0;
  if (std::isinf(z)) return z;  // halving minus infinity would not end
  int halvings = 0;
  for (; std::abs(z) > 0.5; ++halvings) z /= 2;
  // z - z^2/2 + z^3/6 - ..., whose next term is below 0.5^14 / 15!
  double sum = 0.0, term = z;
  for (int k = 2; k < 16; ++k) {
    sum += term;
    term *= -z / k;
  }
  for (; halvings > 0; --halvings) sum *= 2.0 - sum;  // 1 - e^2 = (1 - e) (1 + e)
  return sum;
}

double exp_of_minus(double z) {
  if (!(std::abs(z) > 0.5)) return 1.0 - one_minus_exp_of_minus(z);
  if (z > 746.0) return 0.0;
  if (z < -710.0) return std::numeric_limits<double>::infinity();
  // z = n log 2 + r; n times the first part of log 2 is exact
  constexpr double log2_first = 0x1.62e42feep-1, log2_rest = 0x1.a39ef35793c76p-33;
  const double n = std::nearbyint(z / (log2_first + log2_rest));
  const double r = (z - n * log2_first) - n * log2_rest;
  return std::ldexp(1.0 - one_minus_exp_of_minus(r), -static_cast<int>(n));
}

}  // namespace dartboard
