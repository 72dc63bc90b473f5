#include "core/forces/one_minus_exp.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dartboard::one_minus_exp_test {
namespace {

TEST(OneMinusExp, IsThatOfLibm) {
  constexpr double u = std::numeric_limits<double>::epsilon() / 2;  // unit roundoff
  // 15 terms of the series and up to 7 doublings, each a few roundings that the doublings do not amplify
  for (const double z : {0.0, 1e-300, 1e-12, 0.25, 0.5, 0.75, 3.0, 63.0, 65.0, 1e9, -0.25, -3.0})
    EXPECT_NEAR(one_minus_exp_of_minus(z), -std::expm1(-z), 40 * u * std::abs(std::expm1(-z))) << z;
}

TEST(OneMinusExp, WhatRemainsKeepsItsDigitsHoweverLittleItIs) {
  constexpr double u = std::numeric_limits<double>::epsilon() / 2;
  // half a rounding of z - n log 2, which is at most 0.35, and those of the series
  for (const double z : {0.0, 1e-12, 0.25, 0.5, 0.75, 3.0, 27.5, 63.0, 250.0, 700.0, -0.25, -3.0, -700.0})
    EXPECT_NEAR(exp_of_minus(z), std::exp(-z), 8 * u * std::exp(-z)) << z;
  EXPECT_EQ(exp_of_minus(1e9), 0.0);
  EXPECT_EQ(exp_of_minus(std::numeric_limits<double>::infinity()), 0.0);
  EXPECT_EQ(exp_of_minus(-1e9), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(exp_of_minus(std::numeric_limits<double>::quiet_NaN())));
}

TEST(OneMinusExp, WhatRemainsOfALittleDecayIsOneLessWhatItRemoves) {
  for (const double z : {1e-9, 0.1, 0.3, 0.5, -0.2}) EXPECT_EQ(exp_of_minus(z), 1.0 - one_minus_exp_of_minus(z)) << z;
}

}  // namespace
}  // namespace dartboard::one_minus_exp_test
