#include "benchmarks/harness/statistics.h"

#include <fmt/format.h>

#include <algorithm>
#include <boost/math/distributions/binomial.hpp>
#include <cmath>
#include <numeric>
#include <utility>

#include "core/base/median.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

std::vector<double> sorted(std::span<const double> sample) {
  if (sample.empty()) throw InputError("statistics of an empty sample");
  std::vector<double> values(sample.begin(), sample.end());
  if (std::any_of(values.begin(), values.end(), [](double x) { return std::isnan(x); }))
    throw InputError(fmt::format("statistics of a sample of {} values, of which one is NaN", values.size()));
  std::sort(values.begin(), values.end());
  return values;
}

double quantile_of_sorted(std::span<const double> values, double p) {
  const double position = p * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(position);
  const double part = position - static_cast<double>(below);
  // no interpolation at an order statistic: infinity times zero would be NaN
  return part == 0.0 ? values[below] : std::lerp(values[below], values[below + 1], part);
}

/// The chance that at most `good` of `all` that are drawn are good, if this share of the population is.
double chance_of_at_most(std::size_t good, std::size_t all, double share) {
  const auto n = static_cast<double>(all);
  double sum = 0.0;
  for (std::size_t j = 0; j <= good; ++j) {
    const auto k = static_cast<double>(j);
    sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(k + 1.0) - std::lgamma(n - k + 1.0) + k * std::log(share) +
                    (n - k) * std::log1p(-share));
  }
  return sum;
}

/// The share with that chance, by halving: it falls from 1 to 0 as the share grows.
double share_with_chance(std::size_t good, std::size_t all, double chance) {
  double low = 0.0, high = 1.0;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (chance_of_at_most(good, all, middle) > chance ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// The number of ways to order n values and m others in which the others precede them u times, for all u <= n m.
std::vector<double> counts_of_mann_whitney(std::size_t n, std::size_t m) {
  std::vector<std::vector<double>> row(m + 1, std::vector<double>{1.0});  // of no value
  for (std::size_t i = 1; i <= n; ++i)
    for (std::size_t j = 1; j <= m; ++j) {
      // the last of all is one of the values, which all j others precede, or one of the others
      std::vector<double> counts(i * j + 1, 0.0);
      for (std::size_t u = 0; u < row[j].size(); ++u) counts[u + j] += row[j][u];
      for (std::size_t u = 0; u < row[j - 1].size(); ++u) counts[u] += row[j - 1][u];
      row[j] = std::move(counts);
    }
  return row[m];
}

void require_confidence(double confidence) {
  if (!(confidence > 0.0 && confidence < 1.0))
    throw InputError(fmt::format("confidence {} is not in ]0, 1[", confidence));
}

}  // namespace

double median(std::span<const double> sample) { return median_of(sorted(sample)); }

double quantile(std::span<const double> sample, double p) {
  if (!(p >= 0.0 && p <= 1.0)) throw InputError(fmt::format("quantile {} is not in 0..1", p));
  return quantile_of_sorted(sorted(sample), p);
}

Interval median_interval(std::span<const double> sample, double confidence) {
  require_confidence(confidence);
  const auto values = sorted(sample);
  const std::size_t n = values.size();
  const boost::math::binomial below_median(static_cast<double>(n), 0.5);
  const auto coverage_of = [&](std::size_t k) {
    return 1.0 - 2.0 * boost::math::cdf(below_median, static_cast<double>(k - 1));
  };
  // move both ends inwards while the coverage allows it
  std::size_t k = 1;
  while (2 * (k + 1) <= n && coverage_of(k + 1) >= confidence) ++k;
  return {values[k - 1], values[n - k], coverage_of(k), coverage_of(k) >= confidence};
}

Shift shift_between(std::span<const double> from, std::span<const double> to, double confidence) {
  require_confidence(confidence);
  std::vector<double> differences;
  for (const double a : from)
    for (const double b : to) differences.push_back(b - a);
  differences = sorted(differences);
  const std::vector<double> counts = counts_of_mann_whitney(from.size(), to.size());
  const double all = std::accumulate(counts.begin(), counts.end(), 0.0);
  // the k-th smallest and the k-th largest difference enclose the shift unless fewer than k precede, or follow
  Shift shift{.median = quantile_of_sorted(differences, 0.5)};
  double below = 0.0;
  for (std::size_t k = 0; 2 * k + 1 < differences.size() || k == 0; ++k) {
    below += counts[k] / all;
    const double coverage = 1.0 - 2.0 * below;
    if (k > 0 && coverage < confidence) break;
    shift.interval = {differences[k], differences[differences.size() - 1 - k], std::max(0.0, coverage),
                      coverage >= confidence};
    if (coverage < confidence) break;
  }
  return shift;
}

Interval share_interval(std::size_t good, std::size_t all, double confidence) {
  require_confidence(confidence);
  if (all == 0 || good > all) throw InputError(fmt::format("there is no share of {} in {}", good, all));
  // each end is allowed half of the error: the share at which so many, or more (or fewer), are just that unlikely
  const double beyond = (1.0 - confidence) / 2.0;
  // bad ones counted from one side are good ones from the other
  const double low = good == 0 ? 0.0 : 1.0 - share_with_chance(all - good, all, beyond);
  const double high = good == all ? 1.0 : share_with_chance(good, all, beyond);
  return {low, high, confidence, true};
}

std::string to_string(const Interval& interval) {
  return fmt::format("[{:.3g}, {:.3g}] at {}{:.1f} %", interval.low, interval.high, interval.reached ? "" : "only ",
                     100.0 * interval.coverage);
}

std::vector<bool> outliers(std::span<const double> sample, double threshold) {
  const double middle = median(sample);
  std::vector<double> deviation;
  for (double x : sample) deviation.push_back(std::abs(x - middle));
  const double scale = 1.4826 * median(deviation);
  std::vector<bool> flags;
  for (double d : deviation) flags.push_back(d > threshold * scale);
  return flags;
}

}  // namespace dartboard
