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

}  // namespace
}  // namespace dartboard::one_minus_exp_test
