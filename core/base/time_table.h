#pragma once
// A quantity that a scene gives at some times: linear in between, constant before and after.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace dartboard {

/// T is double or a vector. Empty: there is no such table.
template <class T>
struct TimeTable {
  std::vector<double> at;  // [s] ascending
  std::vector<T> value;

  bool empty() const { return at.empty(); }
  /// pre  it is not empty; t >= 0
  T operator()(double t) const {
    const std::size_t k = segment_of(t);
    if (k == 0) return value.front();
    if (k == at.size()) return value.back();
    return value[k - 1] + (t - at[k - 1]) / (at[k] - at[k - 1]) * (value[k] - value[k - 1]);
  }
  /// The mean over a time: the value half way if no time of the table is within it.
  /// pre  from < to
  T mean(double from, double to) const {
    const std::size_t first = segment_of(from), last = segment_before(to);
    if (first == last) return (*this)(from + (to - from) / 2);
    T sum = (at[first] - from) * (*this)(from + (at[first] - from) / 2);
    for (std::size_t k = first + 1; k <= last; ++k) {
      const double end = k == last ? to : at[k];
      sum += (end - at[k - 1]) * (*this)(at[k - 1] + (end - at[k - 1]) / 2);
    }
    return (1.0 / (to - from)) * sum;
  }
  /// Change over a time, per second: the slope of the table if no time of it is within.
  /// pre  from < to
  T rate(double from, double to) const {
    const std::size_t k = segment_of(from);
    if (k == segment_before(to) && k > 0 && k < at.size())
      return (1.0 / (at[k] - at[k - 1])) * (value[k] - value[k - 1]);
    return (1.0 / (to - from)) * ((*this)(to) - (*this)(from));
  }

 private:
  /// The number of times not after t: 0 before the first.
  std::size_t segment_of(double t) const {
    return static_cast<std::size_t>(std::ranges::upper_bound(at, t) - at.begin());
  }
  /// The number of times before t.
  std::size_t segment_before(double t) const {
    return static_cast<std::size_t>(std::ranges::lower_bound(at, t) - at.begin());
  }
};

}  // namespace dartboard
