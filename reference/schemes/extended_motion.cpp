#include "reference/schemes/extended_motion.h"

#include <cmath>
#include <limits>

#include "core/plain/nan_maximum.h"
#include "core/plain/random.h"
#include "reference/schemes/explicit_schemes.h"

namespace dartboard::reference {
namespace {

using Numbers = std::vector<long double>;

// x of all points, v of all points; the velocity of fixed points is zero
Numbers numbers_of(const SpringNetwork& network, const ExtendedState& s) {
  Numbers y = s.x;
  y.insert(y.end(), s.v.begin(), s.v.end());
  for (std::size_t i = 0; i < network.point_count(); ++i)
    if (network.fixed[i])
      for (std::size_t k = 0; k < 3; ++k) y[s.x.size() + 3 * i + k] = 0.0L;
  return y;
}

double largest_difference(const Numbers& a, const Numbers& b) {
  if (a.size() != b.size()) return std::numeric_limits<double>::quiet_NaN();
  double largest = 0.0;
  for (std::size_t k = 0; k < a.size(); ++k) largest = max_or_nan(largest, static_cast<double>(std::abs(a[k] - b[k])));
  return largest;
}

}  // namespace

ExtendedState extended(const PointState& state) {
  ExtendedState s;
  for (const auto& x : state.x) s.x.insert(s.x.end(), {x[0], x[1], x[2]});
  for (const auto& v : state.v) s.v.insert(s.v.end(), {v[0], v[1], v[2]});
  return s;
}

StateBound distance(const ExtendedState& a, const ExtendedState& b) {
  return {largest_difference(a.x, b.x), largest_difference(a.v, b.v)};
}

ExtendedState extended_run(const SpringNetwork& network, const PointState& start, double h, int steps,
                           std::uint64_t rounding_seed) {
  const ExplicitScheme<long double> scheme("rk4", network);
  Numbers y = numbers_of(network, extended(start));
  SplitMix64 random(rounding_seed);
  for (int n = 0; n < steps; ++n) {
    scheme.step(y, h);
    if (rounding_seed == 0) continue;
    for (std::size_t i = 0; i < y.size(); ++i)
      if (!network.fixed[i / 3 % network.point_count()]) y[i] *= 1.0L + 0x1p-53L * random.next_signed();
  }
  const auto half = y.begin() + static_cast<std::ptrdiff_t>(y.size() / 2);
  return {{y.begin(), half}, {half, y.end()}};
}

WitnessedMotion witnessed_motion(const SpringNetwork& network, const PointState& start, double h, int steps,
                                 int rounded_runs) {
  WitnessedMotion motion{extended_run(network, start, h, steps), {0.0, 0.0}};
  for (int k = 1; k <= rounded_runs; ++k) {
    const StateBound off = distance(extended_run(network, start, h, steps, static_cast<std::uint64_t>(k)), motion.end);
    motion.spread = {max_or_nan(motion.spread.position, off.position),
                     max_or_nan(motion.spread.velocity, off.velocity)};
  }
  return motion;
}

}  // namespace dartboard::reference
