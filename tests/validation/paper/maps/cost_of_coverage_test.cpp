#include "validation/paper/maps/cost_of_coverage.h"

#include <gtest/gtest.h>

#include "tests/validation/paper/paper_problem_for_tests.h"

namespace dartboard::cost_of_coverage_test {
namespace {

std::vector<Mesh> bodies() { return {tetrahedron_ball(1, 1.0), tetrahedron_ball(2, 1.0), tetrahedron_ball(3, 1.0)}; }

TEST(CostOfCoverage, IsProportionalToTheDarts) { expect_yes(try_coverages(bodies())); }

TEST(CostOfCoverage, IsNotWhereSomeCellsCostLess) {
  expect_no(
      try_coverages(bodies(), [](const CountingMap& map, int i) { return i == 3 ? 0 : core_coverage()(map, i); }));
}

// All pairs of darts, as a coverage without marks would visit them.
TEST(CostOfCoverage, IsNotWhereItGrowsFasterThanTheDarts) {
  expect_no(try_coverages(bodies(), [](const CountingMap& map, int i) {
    for (std::size_t k = 0; k < map.dart_count() / 100; ++k) core_coverage()(map, i);
    return core_coverage()(map, i);
  }));
}

TEST(CostOfCoverage, IsNotAnsweredWhereDartsAreNotLookedAtOrBodiesAreAlike) {
  expect_no(try_coverages(bodies(), [](const CountingMap&, int) { return std::size_t{0}; }));
  expect_no(try_coverages(std::vector{tetrahedron_ball(1, 1.0), tetrahedron_ball(1, 2.0)}));
}

}  // namespace
}  // namespace dartboard::cost_of_coverage_test
