#pragma once

#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

namespace dartboard {

/// The middle of the sorted values, the mean of the two middle ones for an even count; NaN for an empty list.
inline double median_of(std::vector<double> values) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  const std::size_t n = values.size();
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(n / 2);
  std::ranges::nth_element(values, middle);
  return n % 2 == 1 ? *middle : 0.5 * (*std::max_element(values.begin(), middle) + *middle);
}

}  // namespace dartboard
