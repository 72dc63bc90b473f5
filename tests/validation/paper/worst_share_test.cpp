#include "validation/paper/worst_share.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace dartboard::worst_share_test {
namespace {

double share_of(double is, double should_be, double bound) {
  WorstShare share;
  share.compare(1.0, 2.0, 4.0);
  share.compare(is, should_be, bound);
  return share.share();
}

TEST(WorstShare, IsTheLargestDeviationOverItsBound) {
  EXPECT_EQ(share_of(5.0, 5.0, 0.0), 0.25);
  EXPECT_EQ(share_of(5.0, 6.0, 2.0), 0.5);
  EXPECT_EQ(share_of(8.0, 6.0, 1.0), 2.0);
}

TEST(WorstShare, OfWhatHasNoBoundOrIsNoNumberIsNotWithin) {
  EXPECT_EQ(share_of(5.0, 6.0, 0.0), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(std::isnan(share_of(std::nan(""), 6.0, 1.0)));
  EXPECT_TRUE(std::isnan(share_of(std::nan(""), 6.0, 0.0)));
  WorstShare none;
  EXPECT_TRUE(none.within());
  none.compare(std::nan(""), 1.0, 1.0);
  EXPECT_FALSE(none.within());
}

}  // namespace
}  // namespace dartboard::worst_share_test
