// The judges of rounding: exponents estimated from errors, steps that are lost, floors that are derived.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/time/integrators.h"
#include "validation/stability/energy_rounding.h"
#include "validation/tradeoff/rounding_floor.h"

namespace dartboard::rounding_judges_test {
namespace {

std::vector<RoundingGrowth::Point> powers(double exponent) {
  std::vector<RoundingGrowth::Point> points;
  for (std::uint64_t steps = 1000; steps <= 1000000; steps *= 10)
    points.push_back({steps, 1e-16 * std::pow(static_cast<double>(steps), exponent)});
  return points;
}

TEST(RoundingExponent, IsThatOfThePowerThatErrorsFollow) {
  for (const double exponent : {0.0, 0.5, 1.0, 2.0}) EXPECT_NEAR(exponent_of(powers(exponent)), exponent, 1e-12);
}

TEST(RoundingExponent, IsNotANumberWhereAnErrorIsNone) {
  auto points = powers(0.5);
  points[1].error = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(exponent_of(points)));
}

// Least squares by the deviations from the means, another formula than the one judged.
TEST(RoundingExponent, IsThatOfTheErrorsMeasured) {
  const RoundingGrowth growth = measure_rounding_growth("verlet", 10000, 4);
  ASSERT_GE(growth.points.size(), 3u);
  double mean_x = 0.0, mean_y = 0.0, xy = 0.0, xx = 0.0;
  const auto n = static_cast<double>(growth.points.size());
  for (const auto& p : growth.points) {
    mean_x += std::log2(static_cast<double>(p.steps)) / n;
    mean_y += std::log2(p.error) / n;
  }
  for (const auto& p : growth.points) {
    const double x = std::log2(static_cast<double>(p.steps)) - mean_x;
    xy += x * (std::log2(p.error) - mean_y);
    xx += x * x;
  }
  EXPECT_NEAR(growth.exponent, xy / xx, 1e-9);
}

// Of two starts whose squares grow tenfold and hundredfold in a decade, exponents 1/2 and 1: half their distance.
TEST(RoundingExponent, IsAsUncertainAsTheStartsDiffer) {
  const std::vector<RoundingGrowth::Point> decade{{10, 0.0}, {100, 0.0}};
  EXPECT_NEAR(exponent_error(decade, {{1e-30, 1e-29}, {1e-30, 1e-28}}), 0.25, 1e-12);
  EXPECT_NEAR(exponent_error(decade, {{1e-30, 1e-29}, {4e-30, 4e-29}, {9e-30, 9e-29}}), 0.0, 1e-12);
  EXPECT_TRUE(std::isnan(exponent_error(decade, {{1e-30, 1e-29}})));
}

// Exponents of sixteen starts differ by some of their own standard errors from that of sixteen others, not by tens.
TEST(RoundingExponent, OfMeasuredStartsHasAnErrorOfTheirOwn) {
  const RoundingGrowth growth = measure_rounding_growth("verlet", 10000, 16);
  EXPECT_GT(growth.standard_error, 0.01);
  EXPECT_LT(growth.standard_error, 0.5);
}

TEST(TinyStepsJudge, CallsKeptWhatOnlyLacksDigitsThatCannotBeRead) {
  TinySteps steps;
  steps.readable = 1e-3;
  steps.lost = 1.9e-3;
  EXPECT_TRUE(steps.keeps_all());
  steps.lost = 2.1e-3;
  EXPECT_FALSE(steps.keeps_all());
  steps.readable = 0.0;
  steps.lost = 0.5e-7;
  EXPECT_TRUE(steps.keeps_all());
  for (const double lost : {3e-7, 1.0, std::numeric_limits<double>::quiet_NaN()}) {
    steps.lost = lost;
    EXPECT_FALSE(steps.keeps_all()) << lost;
  }
}

// Steps of 1e-16 s move a point at 1/4 m/s by 2.5e-17 m, at 2 m where doubles are 4.4e-16 apart.
TEST(TinyStepsJudge, CallsLostWhatAPlainStateDoesNotTakeUp) {
  EXPECT_FALSE(measure_tiny_steps("verlet", 1e-16, 1000).keeps_all());
  EXPECT_TRUE(measure_tiny_steps("verlet-compensated", 1e-16, 1000).keeps_all());
}

/// Two points of 1 kg at 3 and 5 m, on a spring of 2 m.
TradeoffScene two_points() {
  TradeoffScene scene;
  scene.motion.network.mass = {1.0, 1.0};
  scene.motion.network.fixed = {0, 0};
  scene.motion.network.springs = {{0, 1, 1.0, 0.0, 2.0}};
  scene.motion.start = {{{3, 0, 0}, {5, 0, 0}}, {{0, 0, 0}, {0, 0, 0}}};
  scene.duration = 4.0;
  scene.edge = 2.0;
  return scene;
}

// 1.5 * 2^-53 X sqrt(u n) of n = 4 s / h steps, X the root mean square of 3 and 5.
TEST(RoundingFloorJudge, IsARandomWalkOfTheRoundingsOfPositions) {
  const double one = 0x1p-53 * std::sqrt(17.0) / 2.0;
  for (const auto& [name, roundings] : {std::pair("rk4", 1.0), {"backward-euler", 1.0}, {"verlet", 1.0}}) {
    const Scheme& scheme = scheme_of(name);
    const double a_step = scheme.symplectic && !scheme.implicit ? scheme.stages : roundings;
    EXPECT_NEAR(rounding_floor(two_points(), scheme).at(1e-4) / (1.5 * one * std::sqrt(a_step * 4e4)), 1.0, 1e-12)
        << name;
  }
  const Scheme& compensated = scheme_of("verlet-compensated");
  EXPECT_NEAR(rounding_floor(two_points(), compensated).at(1e-4) / (4 * one), 1.0, 1e-12);
}

// A free body that flies 4 s at 10 m/s is 40 m farther out; a fixed one is not.
TEST(RoundingFloorJudge, CountsTheWayOfTheCentreOfMass) {
  const Scheme& rk4 = scheme_of("rk4");
  TradeoffScene flying = two_points();
  for (auto& v : flying.motion.start.v) v = {0, 10, 0};
  const double still = rounding_floor(two_points(), rk4).factor;
  EXPECT_NEAR(rounding_floor(flying, rk4).factor / still, (std::sqrt(17.0) + 40.0) / std::sqrt(17.0), 1e-12);
  flying.motion.network.fixed[0] = 1;
  EXPECT_NEAR(rounding_floor(flying, rk4).factor / still, 1.0, 1e-12);
}

}  // namespace
}  // namespace dartboard::rounding_judges_test
