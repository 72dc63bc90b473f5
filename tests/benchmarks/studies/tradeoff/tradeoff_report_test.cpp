// Cases in which `tradeoff` reports a fault.

#include "benchmarks/studies/tradeoff/tradeoff_report.h"

#include <gtest/gtest.h>

#include <limits>

namespace dartboard::tradeoff_report_test {
namespace {

WorkPoint point(Standing standing) {
  WorkPoint p;
  p.contender = "verlet";
  p.standing = standing;
  if (standing == Standing::failed) p.code = "UNSTABLE_DT";
  return p;
}

WorkPrecision study_of(std::vector<WorkPoint> points, double floor = 1e-12) {
  WorkPrecision study;
  study.scene = "chain";
  study.reference.floor = floor;
  study.reference.what = "two codes";
  study.points = std::move(points);
  return study;
}

TEST(TradeoffTrouble, IsNoneWhereSomeRunFollowsTheMotion) {
  EXPECT_EQ(trouble_of(study_of({point(Standing::useless), point(Standing::dominated), point(Standing::failed)})), "");
}

TEST(TradeoffTrouble, IsNoneWhereEveryRunEndedWithADiagnosis) {
  EXPECT_EQ(trouble_of(study_of({point(Standing::failed), point(Standing::failed)})), "");
}

TEST(TradeoffTrouble, IsThatNoRunThatEndedFollowsTheMotion) {
  EXPECT_EQ(trouble_of(study_of({point(Standing::useless), point(Standing::failed), point(Standing::useless)})),
            "chain: none of 2 runs follows the motion of the reference");
}

TEST(TradeoffTrouble, IsAReferenceThatCannotTellAHundredthOfAnEdge) {
  EXPECT_EQ(trouble_of(study_of({point(Standing::front)}, 1e-2)), "");
  EXPECT_EQ(trouble_of(study_of({point(Standing::front)}, 2e-2)),
            "chain: nothing can be concluded, the reference is uncertain by 2.0e-02 edges: two codes");
  EXPECT_NE(trouble_of(study_of({point(Standing::front)}, std::numeric_limits<double>::quiet_NaN())), "");
}

}  // namespace
}  // namespace dartboard::tradeoff_report_test
