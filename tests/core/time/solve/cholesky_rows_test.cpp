// A factor that follows a change row by row, and the rule that chooses the way.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/time/solve/cholesky.h"
#include "tests/support/step_matrices_for_tests.h"

namespace dartboard::cholesky_rows_test {
namespace {

using Eigen::Vector3d;
constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double far_too_slow = 1e9;  // seconds a flop: never chosen

SpringArrays stretched_grid() {
  SpringArrays body = spring_grid(3, 3, 3);
  for (Vector3d& p : body.x) p *= 1.2;
  disturb(body, 0.01, 0);
  return body;
}

constexpr std::uint32_t place = 21;  // an interior vertex

CholeskyOptions never_again(FactorKind kind) {
  CholeskyOptions options{.kind = kind, .spare_nodes = 1};
  options.rates.supernodal_flop = options.rates.simplicial_flop = 1.0;
  return options;
}
CholeskyOptions by_rows(FactorKind kind = FactorKind::simplicial) {
  CholeskyOptions options = never_again(kind);
  options.rates.update_flop = far_too_slow;
  return options;
}

// 50 epsilon, as for updates in cholesky_test.cpp: it distinguishes this matrix from any other.
TEST(CholeskyRows, OfADissociatedVertexAndItsTwinAreAllThatChanges) {
  for (const FactorKind kind : {FactorKind::simplicial, FactorKind::supernodal}) {
    BodyMatrix before(stretched_grid());
    const BodyMatrix after(with_vertex_dissociated(before.arrays));
    Cholesky cholesky(by_rows(kind));
    ASSERT_EQ(cholesky.factorise(before.blocks), SolveStatus::ok);
    const auto terms = before.matrix.follow(after.arrays.system(), after.tangents, cholesky.spare_diagonal());
    EXPECT_GT(terms.size(), 6u);
    ASSERT_EQ(cholesky.follow(after.blocks, terms), SolveStatus::ok);
    EXPECT_EQ(cholesky.counters().rows_replaced, 6u);
    EXPECT_EQ(cholesky.counters().rank_one_updates, 0u);
    EXPECT_EQ(cholesky.counters().factorisations, 1u);
    EXPECT_LT(solved_error(cholesky, after.blocks), 50 * epsilon);
  }
}

/// A factor of `before` follows to `after` and back.
void lead_there_and_back(Cholesky& cholesky, StepMatrix& matrix, const BodyMatrix& before, const BodyMatrix& after) {
  for (const BodyMatrix* body : {&after, &before})
    ASSERT_EQ(
        cholesky.follow(body->blocks, matrix.follow(body->arrays.system(), body->tangents, cholesky.spare_diagonal())),
        SolveStatus::ok);
}

TEST(CholeskyRows, LeadBackWhenTheVertexIsJoinedAgain) {
  BodyMatrix before(stretched_grid());
  const BodyMatrix after(with_vertex_dissociated(before.arrays));
  Cholesky cholesky(by_rows());
  ASSERT_EQ(cholesky.factorise(before.blocks), SolveStatus::ok);
  StepMatrix matrix = before.matrix;
  for (int k = 0; k < 10; ++k) ASSERT_NO_FATAL_FAILURE(lead_there_and_back(cholesky, matrix, before, after));
  EXPECT_EQ(cholesky.counters().rows_replaced, 120u);
  EXPECT_LT(solved_error(cholesky, before.blocks), 50 * epsilon);
}

// Terms after rows: the columns from which rows were removed must still hold the paths that updates run along.
TEST(CholeskyRows, LeaveAFactorThatTermsCanUpdate) {
  BodyMatrix before(stretched_grid());
  const BodyMatrix after(with_vertex_dissociated(before.arrays));
  SpringArrays arrays = after.arrays;
  for (std::size_t e = 0; e < arrays.springs.size(); e += 5) arrays.springs[e].stiffness *= 3.0;
  const BodyMatrix harder(arrays);
  Cholesky cholesky(by_rows());
  ASSERT_EQ(cholesky.factorise(before.blocks), SolveStatus::ok);
  StepMatrix matrix = before.matrix;
  ASSERT_EQ(
      cholesky.follow(after.blocks, matrix.follow(after.arrays.system(), after.tangents, cholesky.spare_diagonal())),
      SolveStatus::ok);
  ASSERT_EQ(cholesky.update(matrix.follow(harder.arrays.system(), harder.tangents, cholesky.spare_diagonal())),
            SolveStatus::ok);
  EXPECT_GT(cholesky.counters().rank_one_updates, 0u);
  EXPECT_LT(solved_error(cholesky, harder.blocks), 50 * epsilon);
}

// Back to a spare row, which terms then start from as from one that was never used.
TEST(CholeskyRows, GiveBackARowThatTermsCanUse) {
  BodyMatrix before(stretched_grid());
  const BodyMatrix after(with_vertex_dissociated(before.arrays));
  Cholesky cholesky(by_rows());
  ASSERT_EQ(cholesky.factorise(before.blocks), SolveStatus::ok);
  const double spare = cholesky.spare_diagonal();
  StepMatrix matrix = before.matrix;
  ASSERT_NO_FATAL_FAILURE(lead_there_and_back(cholesky, matrix, before, after));
  ASSERT_EQ(cholesky.update(matrix.follow(after.arrays.system(), after.tangents, spare)), SolveStatus::ok);
  EXPECT_LT(solved_error(cholesky, after.blocks), 50 * epsilon);
}

// Adjacent rows that change: the second to be restored meets the first.
TEST(CholeskyRows, KeepWhatCouplesTwoOfThem) {
  BodyMatrix before(stretched_grid());
  SpringArrays arrays = before.arrays;
  const auto [a, b] = arrays.ends[40];
  arrays.mass[a] *= 1.5;
  arrays.mass[b] *= 1.5;
  const BodyMatrix after(arrays);
  Cholesky cholesky(by_rows());
  ASSERT_EQ(cholesky.factorise(before.blocks), SolveStatus::ok);
  ASSERT_EQ(cholesky.follow(after.blocks, before.matrix.follow(arrays.system(), after.tangents, 1.0)), SolveStatus::ok);
  EXPECT_EQ(cholesky.counters().rows_replaced, 6u);
  EXPECT_LT(solved_error(cholesky, after.blocks), 50 * epsilon);
}

// Stiffness goes round a cycle of four vertices, off two sides and onto the two others: no diagonal changes.
TEST(CholeskyRows, AreLeftToTermsWhereNoDiagonalChanges) {
  const BodyMatrix body(stretched_grid());
  const double weight = 0.1 * body.blocks.diagonal[0](0, 0);
  const Vector3d x(1, 0, 0);
  const std::vector<RankOneTerm> terms{{0, 1, x, weight}, {1, 2, x, -weight}, {2, 3, x, weight}, {3, 0, x, -weight}};
  SpringArrays square = body.arrays;
  for (std::uint32_t k = 0; k < 4; ++k) square.add_spring(k, (k + 1) % 4, 0.0, 1.0);  // a place for every entry
  BodyMatrix after(square);
  Cholesky cholesky(by_rows());
  ASSERT_EQ(cholesky.factorise(after.blocks), SolveStatus::ok);
  const std::size_t first = square.ends.size() - 4;
  const NodePattern pattern = node_pattern_of(square.system());
  for (std::size_t k = 0; k < 4; ++k) after.blocks.below[pattern.place[first + k]](0, 0) -= terms[k].weight;
  ASSERT_EQ(cholesky.follow(after.blocks, terms), SolveStatus::ok);
  EXPECT_LT(solved_error(cholesky, after.blocks), 50 * epsilon);
}

TEST(CholeskyRows, CountTowardsTheRenewalOfTheFactor) {
  BodyMatrix before(stretched_grid());
  const BodyMatrix after(with_vertex_dissociated(before.arrays));
  CholeskyOptions options = by_rows();
  options.renew_after = 30;  // two changes of six rows, each row counting as two
  Cholesky cholesky(options);
  ASSERT_EQ(cholesky.factorise(before.blocks), SolveStatus::ok);
  const double spare = cholesky.spare_diagonal();
  StepMatrix matrix = before.matrix;
  for (const BodyMatrix* to : {&after, static_cast<const BodyMatrix*>(&before), &after}) {
    ASSERT_EQ(cholesky.follow(to->blocks, matrix.follow(to->arrays.system(), to->tangents, spare)), SolveStatus::ok);
    EXPECT_LT(solved_error(cholesky, to->blocks), 50 * epsilon);
  }
  EXPECT_EQ(cholesky.counters().update_chosen, 2u);
  EXPECT_EQ(cholesky.counters().refactor_chosen, 1u);
}

// Rows and terms leave a factor of another form than the analysed one: the next factorisation starts from the analysis.
TEST(CholeskyRows, LeaveTheFormOfTheAnalysisToTheNextFactor) {
  for (const bool rows : {true, false}) {
    BodyMatrix before(stretched_grid());
    const BodyMatrix after(with_vertex_dissociated(before.arrays));
    Cholesky cholesky(by_rows(FactorKind::supernodal));
    ASSERT_EQ(cholesky.factorise(before.blocks), SolveStatus::ok);
    StepMatrix matrix = before.matrix;
    const auto terms = matrix.follow(after.arrays.system(), after.tangents, cholesky.spare_diagonal());
    ASSERT_EQ(rows ? cholesky.follow(after.blocks, terms) : cholesky.update(terms), SolveStatus::ok);
    EXPECT_FALSE(cholesky.is_supernodal());
    ASSERT_EQ(cholesky.factorise(before.blocks), SolveStatus::ok);
    EXPECT_TRUE(cholesky.is_supernodal());
    EXPECT_EQ(cholesky.counters().analyses, 1u);
    EXPECT_LT(solved_error(cholesky, before.blocks), 50 * epsilon);
  }
}

TEST(CholeskyRows, ThatMakeTheMatrixIndefiniteAreReported) {
  const BodyMatrix body(stretched_grid());
  Cholesky cholesky(by_rows());
  ASSERT_EQ(cholesky.factorise(body.blocks), SolveStatus::ok);
  // the diagonal stays positive: only elimination shows that this is no minimum
  BlockMatrix after = body.blocks;
  const double less = 0.9 * after.diagonal[place](0, 0);
  after.diagonal[place](0, 0) -= less;
  const std::vector<RankOneTerm> terms{{place, NodePattern::none, {1, 0, 0}, -less}};
  EXPECT_EQ(cholesky.follow(after, terms), SolveStatus::not_positive_definite);
  EXPECT_EQ(cholesky.counters().update_failed, 1u);
  EXPECT_FALSE(cholesky.has_factor());
}

TEST(CholeskyRows, AreLeftToTermsWhereOtherRowsChange) {
  BodyMatrix before(stretched_grid());
  SpringArrays arrays = before.arrays;
  arrays.springs[40].stiffness *= 2.0;  // both its ends change: twelve updates of rank one for rows, three for terms
  const BodyMatrix after(arrays);
  Cholesky cholesky(never_again(FactorKind::simplicial));
  ASSERT_EQ(cholesky.factorise(before.blocks), SolveStatus::ok);
  ASSERT_EQ(cholesky.follow(after.blocks, before.matrix.follow(arrays.system(), after.tangents, 1.0)), SolveStatus::ok);
  EXPECT_EQ(cholesky.counters().rows_replaced, 0u);
  EXPECT_EQ(cholesky.counters().rank_one_updates, 3u);
}

// A downdate that leaves a part of 1e-12 would leave an error of epsilon 1e12.
TEST(CholeskyRule, FactorsAgainWhereAnUpdateWouldCancelDigits) {
  SpringArrays arrays = stretched_grid();
  arrays.springs[40].stiffness *= 1e12;
  BodyMatrix before(arrays);
  arrays.springs[40].stiffness = 0.0;
  const BodyMatrix after(arrays);
  for (const double cancellation : {1e3, 1e300}) {
    CholeskyOptions options = never_again(FactorKind::simplicial);
    options.cancellation = cancellation;
    Cholesky cholesky(options);
    ASSERT_EQ(cholesky.factorise(before.blocks), SolveStatus::ok);
    StepMatrix matrix = before.matrix;
    const auto terms = matrix.follow(arrays.system(), after.tangents, 1.0);
    const SolveStatus status = cholesky.follow(after.blocks, terms);
    if (cancellation > 1e3) {
      EXPECT_EQ(cholesky.counters().update_chosen, 1u);
      continue;
    }
    ASSERT_EQ(status, SolveStatus::ok);
    EXPECT_EQ(cholesky.counters().refactor_chosen, 1u);
    EXPECT_LT(solved_error(cholesky, after.blocks), 20 * epsilon);
  }
}

// Two unknowns coupled by -1: |b - A x| = 1/8 at the first, |A| = 3, |x| = 1, |b| = 2.
TEST(BackwardError, IsTheResidualOverWhatItCouldBe) {
  BlockMatrix matrix;
  matrix.pattern.column_start = {0, 1, 1};
  matrix.pattern.row = {1};
  matrix.diagonal.assign(2, 2.0 * Eigen::Matrix3d::Identity());
  matrix.below.assign(1, -Eigen::Matrix3d::Identity());
  const std::vector<Vector3d> x{{1, 0, 0}, {0, 0, 0}};
  std::vector<Vector3d> b{{2, 0, 0}, {-1, 0, 0}};
  EXPECT_EQ(backward_error(matrix, b, x), 0.0);
  EXPECT_EQ(normwise_backward_error(matrix, b, x), 0.0);
  b[0].x() += 0.125;
  EXPECT_DOUBLE_EQ(normwise_backward_error(matrix, b, x), 0.125 / (3.0 * 1.0 + 2.125));
  EXPECT_DOUBLE_EQ(backward_error(matrix, b, x), 0.125 / (2.0 + 2.125));
  b[1].y() = NAN;
  EXPECT_TRUE(std::isnan(normwise_backward_error(matrix, b, x)));
  b[0].x() -= 0.125;  // no other residual
  EXPECT_TRUE(std::isnan(normwise_backward_error(matrix, b, x)));
}

}  // namespace
}  // namespace dartboard::cholesky_rows_test
