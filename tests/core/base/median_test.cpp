#include "core/base/median.h"

#include <gtest/gtest.h>

#include <cmath>

namespace dartboard::median_test {
namespace {

TEST(Median, IsTheMiddleOfAnOddCountInAnyOrder) {
  EXPECT_EQ(median_of({3.0}), 3.0);
  EXPECT_EQ(median_of({9.0, 1.0, 4.0}), 4.0);
  EXPECT_EQ(median_of({4.0, 9.0, 1.0, 7.0, 100.0}), 7.0);
}

TEST(Median, IsTheMeanOfTheTwoInTheMiddleOfAnEvenCount) {
  EXPECT_EQ(median_of({8.0, 2.0}), 5.0);
  EXPECT_EQ(median_of({100.0, 1.0, 8.0, 2.0}), 5.0);
  EXPECT_EQ(median_of({-4.0, 16.0, 0.0, 1.0, 3.0, 64.0}), 2.0);
}

TEST(Median, OfNothingIsNoNumber) { EXPECT_TRUE(std::isnan(median_of({}))); }

}  // namespace
}  // namespace dartboard::median_test
