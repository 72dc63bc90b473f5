#include "benchmarks/harness/statistics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "core/plain/error.h"

namespace dartboard::statistics_test {
namespace {

/// 1, 2, ..., n: the k-th smallest value is k.
std::vector<double> ranks(int n) {
  std::vector<double> values;
  for (int k = n; k >= 1; --k) values.push_back(k);
  return values;
}

TEST(Median, OfAnEvenSampleIsHalfwayBetweenTheMiddleValues) {
  EXPECT_EQ(median(std::vector{4.0, 1.0, 2.0, 8.0}), 3.0);
  EXPECT_EQ(median(std::vector{4.0, 1.0, 2.0}), 2.0);
}

TEST(Quantile, InterpolatesBetweenOrderStatistics) {
  const std::vector<double> values{10.0, 20.0, 30.0, 40.0, 50.0};
  EXPECT_EQ(quantile(values, 0.0), 10.0);
  EXPECT_EQ(quantile(values, 0.375), 25.0);  // position 1.5; all numbers here are exact in binary
  EXPECT_EQ(quantile(values, 1.0), 50.0);
}

TEST(Quantile, AtAnOrderStatisticIgnoresAnInfiniteNeighbour) {
  EXPECT_EQ(quantile(std::vector{1.0, 2.0, std::numeric_limits<double>::infinity()}, 0.5), 2.0);
}

TEST(Statistics, RefuseAnEmptySampleAndNaN) {
  EXPECT_THROW(median({}), InputError);
  EXPECT_THROW(median(std::vector{1.0, std::nan("")}), InputError);
  EXPECT_THROW(quantile(std::vector{1.0}, 1.5), InputError);
  EXPECT_THROW(median_interval(std::vector{1.0}, 1.0), InputError);
}

// The coverages are 1 - 2 sum_{i<k} C(n,i) / 2^n, exact fractions; a cumulative probability that is right to an ulp is
// within the 4 ulp of EXPECT_DOUBLE_EQ after doubling it and subtracting it from one.
TEST(MedianInterval, TakesTheInnermostOrderStatisticsThatReachTheConfidence) {
  const Interval ten = median_interval(ranks(10));  // k = 3 would give 1 - 2 (1 + 10 + 45) / 1024 = 0.89
  EXPECT_EQ(ten.low, 2.0);
  EXPECT_EQ(ten.high, 9.0);
  EXPECT_DOUBLE_EQ(ten.coverage, 1.0 - 2.0 * (1 + 10) / 1024.0);
  EXPECT_TRUE(ten.reached);

  const Interval twenty = median_interval(ranks(20));
  EXPECT_EQ(twenty.low, 6.0);
  EXPECT_EQ(twenty.high, 15.0);
  EXPECT_DOUBLE_EQ(twenty.coverage, 1.0 - 2.0 * (1 + 20 + 190 + 1140 + 4845 + 15504) / 1048576.0);
  EXPECT_TRUE(twenty.reached);
}

TEST(MedianInterval, NeedsSixValuesForNinetyFivePercent) {
  const Interval five = median_interval(ranks(5));
  EXPECT_EQ(five.low, 1.0);
  EXPECT_EQ(five.high, 5.0);
  EXPECT_DOUBLE_EQ(five.coverage, 30.0 / 32.0);
  EXPECT_FALSE(five.reached);

  const Interval six = median_interval(ranks(6));
  EXPECT_EQ(six.low, 1.0);
  EXPECT_EQ(six.high, 6.0);
  EXPECT_DOUBLE_EQ(six.coverage, 62.0 / 64.0);
  EXPECT_TRUE(six.reached);
}

TEST(MedianInterval, OfOneValueCoversNothing) {
  const Interval one = median_interval(std::vector{7.0});
  EXPECT_EQ(one.low, 7.0);
  EXPECT_EQ(one.high, 7.0);
  EXPECT_EQ(one.coverage, 0.0);
  EXPECT_FALSE(one.reached);
}

TEST(MedianInterval, CoversTheMedianOfASkewedDistributionAsOftenAsItSays) {
  constexpr int samples = 4000, n = 11;
  std::mt19937_64 random(20101);
  int covered = 0;
  double coverage = 0.0;
  for (int s = 0; s < samples; ++s) {
    // exponential of mean 1, whose median is ln 2
    std::vector<double> values;
    for (int i = 0; i < n; ++i) values.push_back(-std::log1p(-std::ldexp(static_cast<double>(random() >> 11), -53)));
    const Interval interval = median_interval(values);
    coverage = interval.coverage;
    if (interval.low <= std::log(2.0) && std::log(2.0) <= interval.high) ++covered;
  }
  // four standard deviations of the observed frequency: one seed in 16000 would fail
  const double deviation = std::sqrt(coverage * (1.0 - coverage) / samples);
  EXPECT_NEAR(static_cast<double>(covered) / samples, coverage, 4.0 * deviation);
}

TEST(Interval, SaysWhenTheConfidenceWasNotReached) {
  EXPECT_EQ(to_string(median_interval(ranks(5))), "[1, 5] at only 93.8 %");
  EXPECT_EQ(to_string(median_interval(ranks(6))), "[1, 6] at 96.9 %");
}

TEST(Outliers, FlagOnlyWhatLiesFarFromTheRest) {
  // median 10, absolute deviations 2 1 0 1 2 90 0: their median is 1, so the fence is 3.5 * 1.4826 = 5.2
  const std::vector<double> values{8.0, 9.0, 10.0, 11.0, 12.0, 100.0, 10.0};
  EXPECT_EQ(outliers(values), (std::vector<bool>{false, false, false, false, false, true, false}));
}

TEST(Outliers, FlagNothingInAConstantSample) {
  EXPECT_EQ(outliers(std::vector{3.0, 3.0, 3.0}), (std::vector<bool>{false, false, false}));
}

// Clopper and Pearson: if all of n are good, the share at which that has a chance of 2.5 % is its n-th root; if k of n
// are, the chance of k or more is 2.5 % at the lower end, and of k or fewer at the upper one.
TEST(ShareInterval, EndsWhereWhatWasSeenIsJustThatUnlikely) {
  const auto chance_of_at_most = [](int k, int n, double share) {
    double sum = 0.0, term = std::pow(1.0 - share, n);
    for (int j = 0; j <= k; ++j) {
      sum += term;
      term *= (n - j) / (j + 1.0) * share / (1.0 - share);
    }
    return sum;
  };
  const Interval all = share_interval(44, 44);
  EXPECT_NEAR(all.low, std::pow(0.025, 1.0 / 44.0), 1e-12);
  EXPECT_EQ(all.high, 1.0);
  EXPECT_TRUE(all.reached);
  const Interval none = share_interval(0, 44);
  EXPECT_EQ(none.low, 0.0);
  EXPECT_NEAR(none.high, 1.0 - std::pow(0.025, 1.0 / 44.0), 1e-12);
  const Interval some = share_interval(17, 20, 0.9);
  EXPECT_NEAR(1.0 - chance_of_at_most(16, 20, some.low), 0.05, 1e-9);
  EXPECT_NEAR(chance_of_at_most(17, 20, some.high), 0.05, 1e-9);
  EXPECT_EQ(some.coverage, 0.9);
}

TEST(ShareInterval, IsRefusedOfNothing) {
  EXPECT_THROW(share_interval(0, 0), InputError);
  EXPECT_THROW(share_interval(3, 2), InputError);
  EXPECT_THROW(share_interval(1, 2, 1.0), InputError);
}

// Of the C(10, 5) orders of five values and five others, 1, 1 and 2 have 0, 1 and 2 pairs the wrong way round.
TEST(ShiftBetween, IsTheMedianOfAllDifferencesWithTheIntervalOfMannAndWhitney) {
  const std::vector<double> from{1.0, 2.0, 4.0, 8.0, 16.0}, to{101.0, 102.0, 104.0, 108.0, 116.0};
  const Shift shift = shift_between(from, to);
  EXPECT_EQ(shift.median, 100.0);
  // the differences are 85, 86, 88, 92 ... 108, 112, 114, 115
  EXPECT_EQ(shift.interval.low, 88.0);
  EXPECT_EQ(shift.interval.high, 112.0);
  EXPECT_DOUBLE_EQ(shift.interval.coverage, 1.0 - 2.0 * 4.0 / 252.0);
  EXPECT_TRUE(shift.interval.reached);
}

TEST(ShiftBetween, NeedsFourAndFourValuesForNinetyFivePercent) {
  const Shift four = shift_between(ranks(4), ranks(4));
  EXPECT_EQ(four.interval.low, -3.0);
  EXPECT_EQ(four.interval.high, 3.0);
  EXPECT_DOUBLE_EQ(four.interval.coverage, 1.0 - 2.0 / 70.0);
  EXPECT_TRUE(four.interval.reached);
  const Shift three = shift_between(ranks(3), ranks(3));
  EXPECT_DOUBLE_EQ(three.interval.coverage, 1.0 - 2.0 / 20.0);
  EXPECT_FALSE(three.interval.reached);
  EXPECT_THROW(shift_between({}, ranks(3)), InputError);
  EXPECT_THROW(shift_between(ranks(3), ranks(3), 1.0), InputError);
}

// Drawn from one skewed distribution, moved by 0.3.
TEST(ShiftBetween, CoversTheShiftAsOftenAsItSays) {
  std::mt19937 random(7);
  std::exponential_distribution<double> skewed(1.0);
  int covered = 0;
  double promised = 0.0;
  for (int trial = 0; trial < 2000; ++trial) {
    std::vector<double> from(7), to(9);
    for (double& x : from) x = skewed(random);
    for (double& x : to) x = skewed(random) + 0.3;
    const Interval interval = shift_between(from, to).interval;
    promised = interval.coverage;
    covered += interval.low <= 0.3 && 0.3 <= interval.high ? 1 : 0;
  }
  // four standard deviations of a share of 2000
  EXPECT_NEAR(covered / 2000.0, promised, 4.0 * std::sqrt(promised * (1.0 - promised) / 2000.0));
  EXPECT_GE(promised, 0.95);
}

}  // namespace
}  // namespace dartboard::statistics_test
