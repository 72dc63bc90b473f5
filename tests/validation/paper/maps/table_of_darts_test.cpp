#include "validation/paper/maps/table_of_darts.h"

#include <gtest/gtest.h>

#include "tests/validation/paper/paper_problem_for_tests.h"

namespace dartboard::table_of_darts_test {
namespace {

TEST(TableOfDarts, IsThatOfFig5) { expect_yes(is_fig_5(map_of_fig_5())); }

TEST(TableOfDarts, IsNotWhereALinkIsCut) {
  Map2 map = map_of_fig_5();
  map.unlink<2>(Dart{2});  // dart 3, and so 20; the condition of quasi-manifolds is broken
  expect_no(is_fig_5(map));
  map.unlink<2>(Dart{3});
  const ClaimAnswer answer = is_fig_5(map);  // a map again: of two parts
  expect_no(answer);
  EXPECT_TRUE(answer.measured.starts_with("28 of 30 links")) << answer.measured;
}

// A link that the table does not show: the face below it ends at the vertex of dart 2.
TEST(TableOfDarts, IsNotWhereACellIsAnother) {
  Map2 map = map_of_fig_5();
  map.unlink<1>(Dart{19});  // dart 20, and so 21
  const ClaimAnswer answer = is_fig_5(map);
  expect_no(answer);
  EXPECT_TRUE(answer.measured.starts_with("30 of 30 links")) << answer.measured;
}

}  // namespace
}  // namespace dartboard::table_of_darts_test
