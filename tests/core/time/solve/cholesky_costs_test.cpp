// Estimates and counts of the facade of Cholesky factors: costs, orderings, refinements, spare rows.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/time/solve/cholesky.h"
#include "core/time/solve/cholesky_implementation.h"
#include "tests/support/step_matrices_for_tests.h"

namespace dartboard::cholesky_costs_test {
namespace {

using Eigen::Vector3d;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

SpringArrays disturbed_grid() {
  SpringArrays body = spring_grid(3, 3, 3);
  body.fixed[0] = body.fixed[5] = 1;
  disturb(body, 0.01, 0);
  return body;
}

RankOneTerm at(std::uint32_t vertex, double weight) { return {vertex, NodePattern::none, {1, 0, 0}, weight}; }

TEST(CholeskyCosts, OfAnUpdateAreThoseOfItsTerms) {
  const BodyMatrix body(disturbed_grid());
  Cholesky cholesky({.kind = FactorKind::simplicial});
  ASSERT_EQ(cholesky.factorise(body.blocks), SolveStatus::ok);
  const double one = cholesky.update_cost(std::vector{at(9, 1.0)}),
               other = cholesky.update_cost(std::vector{at(40, 1.0)});
  EXPECT_GT(one, 0.0);
  EXPECT_GT(other, 0.0);
  EXPECT_DOUBLE_EQ(cholesky.update_cost(std::vector{at(9, 1.0), at(40, 1.0), at(9, 2.0)}), 2 * one + other);
}

// A supernodal factor has to be converted first, number by number.
TEST(CholeskyCosts, OfAnUpdateContainTheConversionOfASupernodalFactor) {
  const BodyMatrix body(disturbed_grid());
  CholeskyOptions options{.kind = FactorKind::supernodal};
  options.rates.conversion = 0.0;
  Cholesky without(options);
  options.rates.conversion = 1.0;
  Cholesky with(options);
  ASSERT_EQ(without.factorise(body.blocks), SolveStatus::ok);
  ASSERT_EQ(with.factorise(body.blocks), SolveStatus::ok);
  const std::vector<RankOneTerm> terms{at(9, 1.0)};
  EXPECT_NEAR(with.update_cost(terms) - without.update_cost(terms), with.factor_nonzeros(), 1e-3);
}

TEST(CholeskyCosts, AreNotToldOfAFactorThatThereIsNone) {
  EXPECT_EQ(Cholesky().update_cost(std::vector{at(0, 1.0)}), std::numeric_limits<double>::infinity());
}

TEST(Cholesky, IsReadyForUpdatesWhereThatIsAskedFor) {
  const BodyMatrix body(disturbed_grid());
  for (const bool ready : {false, true}) {
    Cholesky cholesky({.kind = FactorKind::supernodal, .ready_for_updates = ready});
    ASSERT_EQ(cholesky.factorise(body.blocks), SolveStatus::ok);
    EXPECT_EQ(cholesky.is_supernodal(), !ready);
    EXPECT_LT(solved_error(cholesky, body.blocks), 20 * epsilon);
  }
}

// Removed terms make the matrix indefinite unless the added ones are there already.
TEST(Cholesky, AddsBeforeItTakesAway) {
  BodyMatrix body(disturbed_grid());
  Cholesky cholesky({.kind = FactorKind::simplicial});
  ASSERT_EQ(cholesky.factorise(body.blocks), SolveStatus::ok);
  const double size = body.blocks.diagonal[9](0, 0);
  ASSERT_EQ(cholesky.update(std::vector{at(9, -2.0 * size), at(9, 3.0 * size)}), SolveStatus::ok);
  body.blocks.diagonal[9](0, 0) += size;
  EXPECT_LT(solved_error(cholesky, body.blocks), 50 * epsilon);
}

TEST(Cholesky, HasSpareRowsOfTheMeanSizeOfTheOthers) {
  const BodyMatrix body(disturbed_grid());
  Cholesky cholesky({.spare_nodes = 2});
  ASSERT_EQ(cholesky.factorise(body.blocks), SolveStatus::ok);
  double sum = 0.0;
  for (const Eigen::Matrix3d& block : body.blocks.diagonal) sum += block(0, 0);
  const auto n = static_cast<double>(body.blocks.node_count());
  EXPECT_NEAR(cholesky.spare_diagonal(), sum / n, 1e-12 * sum);
  EXPECT_EQ(cholesky.capacity(), body.blocks.node_count() + 2);
}

TEST(Cholesky, CountsRefinementsWithTheirSolutions) {
  const BodyMatrix body(disturbed_grid());
  Cholesky cholesky;
  ASSERT_EQ(cholesky.factorise(body.blocks), SolveStatus::ok);
  const auto b = random_vectors(body.blocks.node_count(), 2);
  auto x = b;
  ASSERT_EQ(cholesky.solve_refined(body.blocks, b, x), SolveStatus::ok);
  EXPECT_EQ(cholesky.counters().refinements, 1u);
  EXPECT_EQ(cholesky.counters().solves, 2u);
  EXPECT_EQ(cholesky.counters().factorisations, 1u);
}

// With one vertex more the factor has at least as many numbers.
TEST(Cholesky, IsOrderedAgainWhenItHasGrownByTheFactorAllowed) {
  for (const double allowed : {1.2, 0.9}) {
    BodyMatrix before(disturbed_grid());
    const BodyMatrix after(with_vertex_dissociated(before.arrays));
    Cholesky cholesky({.order_again = allowed});
    ASSERT_EQ(cholesky.factorise(before.blocks), SolveStatus::ok);
    ASSERT_EQ(cholesky.factorise(after.blocks), SolveStatus::ok);
    EXPECT_EQ(cholesky.counters().orderings, allowed > 1.0 ? 1u : 2u);
    EXPECT_LT(solved_error(cholesky, after.blocks), 20 * epsilon);
  }
}

// A chain 0 - 1 - 2 - 3 - 4, of which 2 has been dissociated: 5 has one of its neighbours, 3. Another new vertex, 6,
// has no neighbour. At the end of the order a vertex would be coupled through the whole body.
TEST(Cholesky, PutsNewVerticesBesideTheirTwins) {
  SpringArrays chain;
  for (int i = 0; i < 7; ++i) chain.add_vertex(1.0, {1.0 * i, 0, 0});
  for (const auto& [i, j] : {std::pair{0u, 1u}, {1u, 2u}, {3u, 4u}, {3u, 5u}, {2u, 3u}})
    chain.add_spring(i, j, 1.0, 1.0);
  const std::vector<int> before{3, 1, 0, 2, 4};
  // 5 shares its one neighbour with 2 and with 4: of these the lower
  EXPECT_EQ(extended_order(before, 5, node_pattern_of(chain.system()), 9),
            (std::vector<int>{3, 1, 0, 2, 5, 4, 6, 7, 8}));
}

// Nested dissection has less fill-in in three dimensions.
TEST(Cholesky, IsOrderedByMetisWhereThatIsAskedFor) {
  const NodePattern pattern = node_pattern_of(spring_grid(13, 13, 13).system());
  EXPECT_LT(Cholesky::forecast(pattern, 3, {.ordering = Ordering::metis}).numbers,
            0.9 * static_cast<double>(Cholesky::forecast(pattern, 3, {.ordering = Ordering::amd}).numbers));
}

// Two unknowns coupled by -1, both 1: |A| |x| + |b| is 3 + 1 1/8 at the first.
TEST(BackwardError, IsRelativeToEntriesOnBothSidesOfTheDiagonal) {
  BlockMatrix matrix;
  matrix.pattern.column_start = {0, 1, 1};
  matrix.pattern.row = {1};
  matrix.diagonal.assign(2, 2.0 * Eigen::Matrix3d::Identity());
  matrix.below.assign(1, -Eigen::Matrix3d::Identity());
  const std::vector<Vector3d> x(2, Vector3d(1, 0, 0));
  for (const std::size_t which : {0u, 1u}) {
    std::vector<Vector3d> b(2, Vector3d(1, 0, 0));
    b[which].x() += 0.125;
    EXPECT_DOUBLE_EQ(backward_error(matrix, b, x), 0.125 / (3.0 + 1.125)) << which;
  }
}

}  // namespace
}  // namespace dartboard::cholesky_costs_test
