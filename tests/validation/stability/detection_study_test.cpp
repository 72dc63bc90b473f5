// Runs with steps beyond the limit: predicted, and found soon after their energy passes the bound.

#include "validation/stability/detection_study.h"

#include <gtest/gtest.h>

namespace dartboard::detection_study_test {
namespace {

TEST(Detection, FollowsWithin64StepsWhereverTheEnergyPassesTheBound) {
  const std::vector<Detection> all = measure_detection(true);
  std::size_t passed = 0;
  for (const Detection& d : all) {
    EXPECT_TRUE(d.predicted) << d.body << " " << d.integrator << " " << d.factor;
    EXPECT_TRUE(d.holds()) << d.body << " " << d.integrator << " " << d.factor << ": passed " << d.passed.value_or(0)
                           << ", detected " << d.detected.value_or(0) << ", above for " << d.above;
    passed += d.passed.has_value();
  }
  EXPECT_GE(passed, all.size() / 2);
}

TEST(DetectionFactors, AscendFromJustAboveTheLimitToFarBeyond) {
  for (const bool quick : {false, true}) {
    const std::vector<double> factors = detection_factors(quick);
    EXPECT_GT(factors.front(), 1.0);
    for (std::size_t k = 1; k < factors.size(); ++k) EXPECT_GT(factors[k], factors[k - 1]);
  }
  EXPECT_EQ(detection_factors(false).front(), 1.0001);
  EXPECT_EQ(detection_factors(false).back(), 1e8);
}

TEST(Detection, HoldsWhereARunIsPredictedAndNotLongAboveTheBound) {
  Detection d{.body = "", .integrator = ""};
  d.steps = 10;
  EXPECT_FALSE(d.holds());
  d.predicted = true;
  EXPECT_TRUE(d.holds());
  d.above = 64;
  EXPECT_TRUE(d.holds());
  d.above = 65;
  EXPECT_FALSE(d.holds());
}

}  // namespace
}  // namespace dartboard::detection_study_test
