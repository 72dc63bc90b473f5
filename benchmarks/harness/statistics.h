#pragma once
// Statistics of the reports: order statistics only, since times are skewed and no distribution is known for them.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace dartboard {

/// throws  InputError for an empty sample or one that holds a NaN (all functions of this file)
double median(std::span<const double> sample);

/// The p-quantile, interpolated linearly between the order statistics around position p (n - 1).
///
/// throws  InputError unless 0 <= p <= 1
double quantile(std::span<const double> sample, double p);

/// An interval for a population median, and how often such an interval covers it.
struct Interval {
  double low = 0.0, high = 0.0;
  double coverage = 0.0;  // exact for a continuous distribution, a lower bound when values can tie
  bool reached = false;   // coverage >= the confidence asked for
};

/// The narrowest symmetric interval of order statistics that covers the median with the confidence asked for.
///
/// The number of values below the median is Binomial(n, 1/2) whatever the distribution, so the k-th smallest and the
/// k-th largest enclose it with probability 1 - 2 P(B < k). Too few values (fewer than 6 for 95 %) cannot reach the
/// confidence: the answer is then min..max with the coverage that it does have, and `reached` is false.
///
/// throws  InputError unless 0 < confidence < 1
Interval median_interval(std::span<const double> sample, double confidence = 0.95);

/// How much larger the values of one sample are than those of another: the median of all differences (Hodges and
/// Lehmann), and the interval of the differences that Mann and Whitney's test does not refuse.
///
/// It covers the shift of two distributions of one shape, whatever that shape is. Too few values cannot reach the
/// confidence (for 95 %, four and four can); the answer is then that of the extremes, and `reached` is false.
///
/// throws  InputError unless 0 < confidence < 1
/// cost    O(n m log(n m)) for samples of n and m, and O(n^2 m^2) for the coverage
struct Shift {
  double median = 0.0;
  Interval interval{};
};
Shift shift_between(std::span<const double> from, std::span<const double> to, double confidence = 0.95);

/// The interval of Clopper and Pearson for the share of good ones in a population, of which `all` were drawn and `good`
/// of these are good: it covers that share at least so often, whatever the share is.
///
/// throws  InputError unless good <= all, 0 < all and 0 < confidence < 1
Interval share_interval(std::size_t good, std::size_t all, double confidence = 0.95);

/// "[1.02, 1.07] at 96.9 %", with "only" before the percentage when the confidence was not reached.
std::string to_string(const Interval& interval);

/// Flags the values that lie further than `threshold` scaled median absolute deviations from the median.
///
/// Flags are for the reader: flagged values stay in all figures. The scale 1.4826 makes the deviation that of a
/// normal distribution. When more than half of the values are equal, the deviation is zero and every other value is
/// flagged.
std::vector<bool> outliers(std::span<const double> sample, double threshold = 3.5);

}  // namespace dartboard
