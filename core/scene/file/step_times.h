#pragma once
// Conversion of times to steps: the step boundary on which an event, a frame or the end falls.

#include <cmath>
#include <cstdint>
#include <optional>

namespace dartboard {

/// The n for which n * step is `time`, exactly or within 4 units of rounding.
///
/// Time and step are decimals rounded to doubles, each by a factor within 1 + 2^-53, and so is their quotient: after
/// three roundings a time of n steps in decimals is at most n (1 + 3 * 2^-53), within the 2^-51 allowed here.
/// pre  time >= 0, step > 0
inline std::optional<std::uint64_t> step_at(double time, double step) {
  const double quotient = time / step, nearest = std::round(quotient);
  if (std::abs(quotient - nearest) > 0x1p-51 * nearest) return {};
  return static_cast<std::uint64_t>(nearest);
}

/// The first step boundary not before `time`.
inline std::uint64_t step_of_time(double time, double step) {
  return step_at(time, step).value_or(static_cast<std::uint64_t>(std::ceil(time / step)));
}

/// The last step boundary not after `time`.
inline std::uint64_t step_until(double time, double step) {
  return step_at(time, step).value_or(static_cast<std::uint64_t>(std::floor(time / step)));
}

}  // namespace dartboard
