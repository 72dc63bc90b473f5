#include "core/base/time_table.h"

#include <gtest/gtest.h>

#include <Eigen/Core>

namespace dartboard::time_table_test {
namespace {

const TimeTable<double> ramp{{1, 2, 4}, {0, 8, 4}};

TEST(TimeTable, IsLinearInBetweenAndConstantBeforeAndAfter) {
  EXPECT_EQ(ramp(0), 0);
  EXPECT_EQ(ramp(1), 0);
  EXPECT_EQ(ramp(1.25), 2);
  EXPECT_EQ(ramp(2), 8);
  EXPECT_EQ(ramp(3), 6);
  EXPECT_EQ(ramp(4), 4);
  EXPECT_EQ(ramp(9), 4);
}

TEST(TimeTable, HasTheMeanOfWhatLiesInATime) {
  EXPECT_EQ(ramp.mean(1, 2), 4);
  EXPECT_EQ(ramp.mean(1.25, 1.75), 4);
  EXPECT_EQ(ramp.mean(0, 2), 2);           // half of it before the first time
  EXPECT_EQ(ramp.mean(1, 4), 16.0 / 3.0);  // 4 for a second and 6 for two
  EXPECT_EQ(ramp.mean(0, 6), 4);           // 0, 4, 12 and 8 over six seconds
  EXPECT_EQ(ramp.mean(4, 5), 4);
  EXPECT_EQ(ramp.mean(7, 8), 4);
  const TimeTable<double> constant{{0.5}, {0.1}};
  EXPECT_EQ(constant.mean(0, 0.3), 0.1);  // no rounding
  EXPECT_EQ(constant.mean(0.6, 0.9), 0.1);
}

TEST(TimeTable, HasTheSlopeAsItsRateWhereNoTimeIsWithin) {
  EXPECT_EQ(ramp.rate(1, 2), 8);
  EXPECT_EQ(ramp.rate(1.1, 1.7), 8);  // of the table, so that steps within have equal bits
  EXPECT_EQ(ramp.rate(2.3, 2.4), -2);
  EXPECT_EQ(ramp.rate(1.5, 2.5), 3);  // from 4 to 7
  EXPECT_EQ(ramp.rate(0, 0.5), 0);
  EXPECT_EQ(ramp.rate(5, 6), 0);
}

TEST(TimeTable, MayHaveVectors) {
  const TimeTable<Eigen::Vector3d> way{{0, 2}, {{0, 0, 0}, {4, 2, 0}}};
  EXPECT_EQ(way(1), Eigen::Vector3d(2, 1, 0));
  EXPECT_EQ(way.rate(0.5, 1), Eigen::Vector3d(2, 1, 0));
  EXPECT_EQ(way.rate(1, 3), Eigen::Vector3d(1, 0.5, 0));
}

}  // namespace
}  // namespace dartboard::time_table_test
