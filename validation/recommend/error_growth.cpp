#include "validation/recommend/error_growth.h"

#include <algorithm>
#include <cmath>

#include "core/plain/nan_maximum.h"

namespace dartboard {
namespace {

constexpr double most_power = 2.0, chaotic_power = 3.0;

/// The largest errors of the last three octaves of time.
struct Octaves {
  double first = 0.0, middle = 0.0, last = 0.0;

  explicit Octaves(std::span<const double> errors) {
    const std::size_t n = errors.size();
    first = largest(errors.subspan(n / 8, n / 4 - n / 8));
    middle = largest(errors.subspan(n / 4, n / 2 - n / 4));
    last = largest(errors.subspan(n / 2));
  }
  static double largest(std::span<const double> errors) {
    double most = 0.0;
    for (const double e : errors) most = max_or_nan(most, e);
    return most;
  }
};

}  // namespace

double beyond(std::span<const double> errors, double times_longer, bool lasts) {
  double power = lasts ? 1.0 : 0.0;
  const double all = Octaves::largest(errors);
  double last = all;
  if (errors.size() >= 8) {
    const Octaves octaves(errors);
    last = octaves.last;
    const double seen = 0.5 * std::log2(octaves.last / octaves.first);
    if (std::isfinite(seen)) power = std::clamp(seen, power, most_power);
  }
  // an early error may still be the largest
  return std::max(1.0, last / all * std::pow(times_longer, power));
}

double exponential_growth(std::span<const double> errors) {
  if (errors.size() < 8) return 0.0;
  const Octaves octaves(errors);
  const double early = std::log2(octaves.middle / octaves.first), late = std::log2(octaves.last / octaves.middle);
  return early > chaotic_power && late > chaotic_power ? std::log(octaves.last / octaves.middle) / 0.5 : 0.0;
}

}  // namespace dartboard
