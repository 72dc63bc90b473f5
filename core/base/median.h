#pragma once

#include <algorithm>
#include <limits>
#include <vector>

namespace dartboard {

/// The middle of the sorted values, the mean of the two middle ones for an even count; NaN for an empty list.
inline double median_of(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::ranges::sort(values);
  const std::size_t n = values.size();
  return n % 2 == 1 ? values[n / 2] : 0.5 * (values[n / 2 - 1] + values[n / 2]);
}

}  // namespace dartboard
