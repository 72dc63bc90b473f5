// Rounding over many steps, and steps that are lost in it.

#include "validation/extremes/energy_rounding.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/plain/error.h"

namespace dartboard {
namespace {

// Five points over two decades, each the root of a mean over 64 starts, 9 % of scatter: the slope scatters by 0.05, and
// more where the points of one start depend on each other.
TEST(EnergyRounding, GrowsAsTheSquareRootOfTheSteps) {
  for (const char* name : {"verlet", "verlet-compensated"}) {
    const RoundingGrowth growth = measure_rounding_growth(name, 100000, 64);
    ASSERT_EQ(growth.points.size(), 5u);
    EXPECT_NEAR(growth.exponent, 0.5, 0.15) << name;
  }
}

// Plainly each step rounds x, near 2, to 2.2e-16; compensated it rounds increments, h omega = 0.05 as large.
TEST(EnergyRounding, IsSmallerWhereTheStateIsCompensated) {
  const auto last = [](const char* name) { return measure_rounding_growth(name, 10000, 16).points.back().error; };
  EXPECT_LT(last("verlet-compensated"), last("verlet") / 10);
  EXPECT_LT(last("blanes-moan-4-compensated"), last("blanes-moan-4") / 10);
}

TEST(EnergyRounding, IsNotKnownOfMethodsThatConserveNoForm) {
  EXPECT_THROW(measure_rounding_growth("rk4", 1000, 1), InputError);
}

TEST(TinySteps, AreLostPlainlyAndKeptByACompensatedState) {
  for (const double h : {1e-18, 1e-16}) {
    EXPECT_EQ(measure_tiny_steps("verlet", h, 100000).lost, 1.0) << h;
    const TinySteps kept = measure_tiny_steps("verlet-compensated", h, 100000);
    EXPECT_TRUE(kept.keeps_all()) << h << ": " << kept.lost << " of " << kept.readable;
    EXPECT_LT(kept.lost_with_digits, 1e-9) << h;
  }
  // 2.5e-14 m a step are 56 units in the last place: some percent are lost by rounding
  const TinySteps half = measure_tiny_steps("verlet", 1e-13, 100000);
  EXPECT_GT(half.lost, 1e-5);
  EXPECT_LT(half.lost, 1e-1);
}

}  // namespace
}  // namespace dartboard
