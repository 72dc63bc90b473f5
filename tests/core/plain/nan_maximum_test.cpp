#include "core/plain/nan_maximum.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace dartboard::nan_maximum_test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(NanMaximum, IsTheLargerOfTwo) {
  EXPECT_EQ(max_or_nan(1.0, 2.0), 2.0);
  EXPECT_EQ(max_or_nan(2.0, 1.0), 2.0);
  EXPECT_EQ(max_or_nan(1.0, infinity), infinity);
  EXPECT_EQ(max_or_nan(-1.0L, -2.0L), -1.0L);
}

TEST(NanMaximum, IsNoNumberWhereOneIsNone) {
  EXPECT_TRUE(std::isnan(max_or_nan(nan, 1.0)));
  EXPECT_TRUE(std::isnan(max_or_nan(1.0, nan)));
  EXPECT_TRUE(std::isnan(max_or_nan(infinity, nan)));
  EXPECT_TRUE(std::isnan(max_or_nan(1.0L, std::numeric_limits<long double>::quiet_NaN())));
}

TEST(NanMaximum, OfSeveralKeepsOneWhereverItStands) {
  EXPECT_EQ(max_or_nan(std::vector{1.0, 3.0, 2.0}), 3.0);
  EXPECT_EQ(max_or_nan(std::vector<double>{}), 0.0);
  for (std::size_t k = 0; k < 3; ++k) {
    std::vector values{1.0, 3.0, 2.0};
    values[k] = nan;
    EXPECT_TRUE(std::isnan(max_or_nan(values))) << k;
  }
}

}  // namespace
}  // namespace dartboard::nan_maximum_test
