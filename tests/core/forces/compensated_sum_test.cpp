#include "core/forces/compensated_sum.h"

#include <gtest/gtest.h>

#include <array>

namespace dartboard::compensated_sum_test {
namespace {

TEST(CompensatedSum, LosesNothingBesideALargeTermWhereverItStands) {
  for (const std::array<double, 3>& terms :
       {std::array{0x1p60, 1.0, -0x1p60}, {1.0, 0x1p60, -0x1p60}, {0x1p60, -0x1p60, 1.0}}) {
    CompensatedSum sum;
    for (const double term : terms) sum.add(term);
    EXPECT_EQ(sum.value(), 1.0) << terms[0];
  }
  EXPECT_EQ(CompensatedSum().value(), 0.0);
}

}  // namespace
}  // namespace dartboard::compensated_sum_test
