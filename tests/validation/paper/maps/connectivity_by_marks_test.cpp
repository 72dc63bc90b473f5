#include "validation/paper/maps/connectivity_by_marks.h"

#include <gtest/gtest.h>

#include "core/topology/build.h"
#include "tests/validation/paper/paper_problem_for_tests.h"

namespace dartboard::connectivity_by_marks_test {
namespace {

TEST(ConnectivityByMarks, IsLostWhereTheCellsDoNotHangTogether) {
  expect_yes(try_marking(kuhn_box(2, 2, 2, 1.0), 3, 1));
}

TEST(ConnectivityByMarks, IsNotFoundByWhoAlwaysSaysTheSame) {
  for (const bool answer : {true, false})
    expect_no(try_marking(kuhn_box(2, 2, 2, 1.0), 3, 1, [&](const Map3&) { return answer; }));
}

TEST(ConnectivityByMarks, IsThereInOneBodyAndNotInTwo) {
  EXPECT_TRUE(all_darts_are_marked(build_map<Map3>(two_tetrahedra()).map));
  EXPECT_FALSE(all_darts_are_marked(build_map<Map3>(touching_at_edge()).map));
  EXPECT_TRUE(all_darts_are_marked(Map3()));
}

}  // namespace
}  // namespace dartboard::connectivity_by_marks_test
