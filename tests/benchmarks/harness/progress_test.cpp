// The estimate of the remaining time, from the time that the finished part took.

#include "benchmarks/harness/progress.h"

#include <gtest/gtest.h>

namespace dartboard::progress_test {
namespace {

TEST(TimeLeft, IsThatOfTheStepsLeftAtThePaceOfThoseDone) {
  EXPECT_EQ(time_left(2, 10, 10.0), ", about 40 s left");
  EXPECT_EQ(time_left(1, 121, 5.0), ", about 10 min left");
}

TEST(TimeLeft, IsNotToldBeforeThereIsSomethingToGoBy) {
  EXPECT_EQ(time_left(0, 10, 100.0), "");
  EXPECT_EQ(time_left(1, 10, 0.1), "");
}

TEST(TimeLeft, IsNotToldAtTheEnd) { EXPECT_EQ(time_left(10, 10, 100.0), ""); }

}  // namespace
}  // namespace dartboard::progress_test
