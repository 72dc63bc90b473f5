#include "core/forces/one_minus_exp.h"

#include <cmath>

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

}  // namespace dartboard
