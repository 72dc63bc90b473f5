// The further growth of errors, estimated from known errors.

#include "validation/recommend/error_growth.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace dartboard::error_growth_test {
namespace {

/// Of t from 1/n to 1.
std::vector<double> errors(const std::function<double(double)>& at, int n = 16) {
  std::vector<double> all;
  for (int k = 1; k <= n; ++k) all.push_back(at(static_cast<double>(k) / n));
  return all;
}
std::vector<double> power(double p) {
  return errors([p](double t) { return 1e-6 * std::pow(t, p); });
}

TEST(ErrorGrowth, GoesOnWithThePowerThatWasSeen) {
  for (const double p : {1.0, 1.25, 1.5, 2.0}) {
    EXPECT_NEAR(beyond(power(p), 100.0, true), std::pow(100.0, p), 1e-9 * std::pow(100.0, p)) << p;
    EXPECT_NEAR(beyond(power(p), 100.0, false), std::pow(100.0, p), 1e-9 * std::pow(100.0, p)) << p;
  }
}

// Phases of different rates add up and come apart again.
TEST(ErrorGrowth, IsThatOfTheLargestErrorsOfAnOctave) {
  const auto beats = errors([](double t) { return 1e-6 * t * std::abs(std::cos(100.0 * t)); }, 64);
  EXPECT_GT(beyond(beats, 10.0, true), 9.99);
  EXPECT_LT(beyond(beats, 10.0, true), 12.0);
}

TEST(ErrorGrowth, IsLinearAtLeastWhereTheMotionLasts) {
  EXPECT_DOUBLE_EQ(beyond(power(0.0), 50.0, true), 50.0);
  EXPECT_DOUBLE_EQ(beyond(power(0.5), 50.0, true), 50.0);
}

TEST(ErrorGrowth, IsNoneWhereTheMotionDies) {
  EXPECT_DOUBLE_EQ(beyond(power(0.0), 50.0, false), 1.0);
  EXPECT_DOUBLE_EQ(beyond(power(-1.0), 50.0, false), 1.0);
}

// The transient is a hundred times the part that goes on growing: 1e-6 at the end, 5e-5 after fifty times as long.
TEST(ErrorGrowth, StartsFromTheErrorsOfTheLastOctave) {
  const auto transient = errors([](double t) { return t < 0.1 ? 1e-4 : 1e-6 * t; });
  EXPECT_DOUBLE_EQ(beyond(transient, 50.0, true), 1.0);
  EXPECT_NEAR(beyond(transient, 500.0, true), 5.0, 1e-9);
}

TEST(ErrorGrowth, IsQuadraticAtMost) { EXPECT_DOUBLE_EQ(beyond(power(2.7), 10.0, true), 100.0); }

TEST(ErrorGrowth, OfAFewErrorsIsTheLeast) {
  const std::vector<double> few{1e-6, 4e-6, 9e-6, 16e-6};
  EXPECT_DOUBLE_EQ(beyond(few, 10.0, true), 10.0);
  EXPECT_DOUBLE_EQ(beyond(few, 10.0, false), 1.0);
  EXPECT_EQ(exponential_growth(few), 0.0);
}

TEST(ErrorGrowth, IsExponentialWhereItBeatsEveryPower) {
  for (const double rate : {12.0, 30.0})
    EXPECT_NEAR(exponential_growth(errors([rate](double t) { return 1e-12 * std::exp(rate * t); })), rate, 1e-9);
  for (const double p : {0.0, 1.0, 2.0, 2.9}) EXPECT_EQ(exponential_growth(power(p)), 0.0) << p;
}

// One jump is an event, or an error that happened to vanish: not a rate.
TEST(ErrorGrowth, IsNotExponentialForOneJump) {
  EXPECT_EQ(exponential_growth(errors([](double t) { return t > 0.5 ? 1e-3 : 1e-9 * t; })), 0.0);
  EXPECT_EQ(exponential_growth(errors([](double t) { return t > 0.25 ? 1e-3 * t : 1e-9 * t; })), 0.0);
}

}  // namespace
}  // namespace dartboard::error_growth_test
