#include "validation/paper/worst_share.h"

#include <cmath>
#include <limits>

#include "core/plain/nan_maximum.h"

namespace dartboard {

void WorstShare::compare(double is, double should_be, double bound) {
  if (is == should_be) return;
  const double off = std::abs(is - should_be);
  share_ = max_or_nan(share_, bound > 0.0 ? off / bound : off + std::numeric_limits<double>::infinity());
}

}  // namespace dartboard
