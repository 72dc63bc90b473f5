#include "core/time/solve/cholesky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/time/system/nan_proof.h"
#include "tests/support/step_matrices_for_tests.h"

namespace dartboard::cholesky_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

SpringArrays disturbed_grid() {
  SpringArrays body = spring_grid(3, 3, 3);
  body.fixed[0] = body.fixed[5] = 1;
  disturb(body, 0.01, 0);
  return body;
}

SpringArrays crushed_grid() {
  SpringArrays body = spring_grid(3, 3, 3);
  for (Vector3d& p : body.x) p *= 0.3;
  return body;
}

// The backward error of a Cholesky solution in n unknowns is at most about 8 n epsilon componentwise in theory (Higham,
// theorem 10.3 and 10.4, for |R'||R| near |A|) and a few epsilon in practice; 20 epsilon separates a factor of this
// matrix from one of another.
TEST(Cholesky, SolvesByEveryKindOfFactorAndOrdering) {
  const BodyMatrix body(disturbed_grid());
  for (const FactorKind kind : {FactorKind::automatic, FactorKind::simplicial, FactorKind::supernodal})
    for (const Ordering ordering : {Ordering::amd, Ordering::metis})
      for (const AnalysisGraph graph : {AnalysisGraph::nodes, AnalysisGraph::unknowns}) {
        Cholesky cholesky({.ordering = ordering, .kind = kind, .graph = graph});
        ASSERT_EQ(cholesky.factorise(body.blocks), SolveStatus::ok);
        if (kind != FactorKind::automatic) {
          EXPECT_EQ(cholesky.is_supernodal(), kind == FactorKind::supernodal);
        }
        EXPECT_LT(solved_error(cholesky, body.blocks), 20 * epsilon);
      }
}

// One refinement with an extended residual leaves the rounding of x itself: at most epsilon/2 of each term.
TEST(Cholesky, RefinementReachesTheRoundingOfTheSolutionWhateverTheScales) {
  SpringArrays arrays = disturbed_grid();
  for (std::size_t i = 0; i < arrays.mass.size(); ++i)
    arrays.mass[i] *= std::pow(10.0, static_cast<double>(i % 13) - 6);
  for (std::size_t e = 0; e < arrays.springs.size(); ++e)
    arrays.springs[e].stiffness = std::pow(10.0, static_cast<double>(e % 15));
  const BodyMatrix body(arrays);
  Cholesky cholesky;
  ASSERT_EQ(cholesky.factorise(body.blocks), SolveStatus::ok);
  const auto b = random_vectors(body.blocks.node_count(), 2);
  auto x = b;
  ASSERT_EQ(cholesky.solve_refined(body.blocks, b, x), SolveStatus::ok);
  EXPECT_LT(backward_error(body.blocks, b, x), epsilon);
  auto in_place = b;
  ASSERT_EQ(cholesky.solve_refined(body.blocks, in_place, in_place), SolveStatus::ok);
  EXPECT_EQ(in_place, x);
}

TEST(Cholesky, IndefiniteMatrixIsReportedByEveryKindOfFactor) {
  const BodyMatrix body(crushed_grid(), Compression::exact, 1.0);
  for (const FactorKind kind : {FactorKind::automatic, FactorKind::simplicial, FactorKind::supernodal}) {
    Cholesky cholesky({.kind = kind});
    EXPECT_EQ(cholesky.factorise(body.blocks), SolveStatus::not_positive_definite);
    EXPECT_LT(cholesky.failed_node(), body.blocks.node_count());
    EXPECT_FALSE(cholesky.has_factor());
    const auto b = random_vectors(body.blocks.node_count(), 1);
    auto x = b;
    EXPECT_EQ(cholesky.solve(b, x), SolveStatus::not_factored);
  }
}

TEST(Cholesky, NamesTheVertexWithoutAPivot) {
  for (const FactorKind kind : {FactorKind::simplicial, FactorKind::supernodal})
    for (const std::uint32_t vertex : {2u, 9u, 21u}) {
      BodyMatrix body(disturbed_grid());
      body.blocks.diagonal[vertex](2, 2) = -1.0;  // negative before anything is eliminated
      Cholesky cholesky({.kind = kind});
      EXPECT_EQ(cholesky.factorise(body.blocks), SolveStatus::not_positive_definite);
      EXPECT_EQ(cholesky.failed_node(), vertex);
    }
}

TEST(Cholesky, FactorsAgainAfterAnIndefiniteMatrix) {
  const BodyMatrix bad(crushed_grid(), Compression::exact, 1.0), good(crushed_grid(), Compression::projected, 1.0);
  Cholesky cholesky;
  ASSERT_EQ(cholesky.factorise(bad.blocks), SolveStatus::not_positive_definite);
  ASSERT_EQ(cholesky.factorise(good.blocks), SolveStatus::ok);
  EXPECT_LT(solved_error(cholesky, good.blocks), 20 * epsilon);
  EXPECT_EQ(cholesky.counters().analyses, 1u);
}

TEST(Cholesky, FollowsByAFactorAnewWhereThereIsNoneToUpdate) {
  BodyMatrix good(disturbed_grid());
  Cholesky cholesky;
  ASSERT_EQ(cholesky.factorise(good.blocks), SolveStatus::ok);
  BodyMatrix indefinite = good;
  indefinite.blocks.diagonal[4](0, 0) = -1.0;
  ASSERT_EQ(cholesky.factorise(indefinite.blocks), SolveStatus::not_positive_definite);
  ASSERT_EQ(cholesky.follow(good.blocks, std::vector{RankOneTerm{4, NodePattern::none, {1, 0, 0}, 1.0}}),
            SolveStatus::ok);
  EXPECT_EQ(cholesky.counters().refactor_chosen, 1u);
  EXPECT_EQ(cholesky.counters().update_chosen, 0u);
  EXPECT_LT(solved_error(cholesky, good.blocks), 20 * epsilon);
}

TEST(Cholesky, NotANumberIsReportedInMatrixAndRightSide) {
  BodyMatrix body(disturbed_grid());
  Cholesky cholesky;
  ASSERT_EQ(cholesky.factorise(body.blocks), SolveStatus::ok);
  auto b = random_vectors(body.blocks.node_count(), 1), x = b;
  b[4].y() = NAN;
  EXPECT_EQ(cholesky.solve(b, x), SolveStatus::not_finite);
  body.blocks.diagonal[3](1, 1) = NAN;
  EXPECT_EQ(cholesky.factorise(body.blocks), SolveStatus::not_finite);
  EXPECT_FALSE(cholesky.has_factor());
}

TEST(Cholesky, DowndateThatLosesDefinitenessIsReported) {
  const BodyMatrix body(disturbed_grid());
  Cholesky cholesky;
  ASSERT_EQ(cholesky.factorise(body.blocks), SolveStatus::ok);
  const std::vector<RankOneTerm> terms{{9, NodePattern::none, {1, 0, 0}, -2.0 * body.blocks.diagonal[9](0, 0)}};
  EXPECT_EQ(cholesky.update(terms), SolveStatus::not_positive_definite);
  EXPECT_FALSE(cholesky.has_factor());
}

TEST(Cholesky, UpdateThatOverflowsIsReported) {
  const BodyMatrix body(disturbed_grid());
  Cholesky cholesky;
  ASSERT_EQ(cholesky.factorise(body.blocks), SolveStatus::ok);
  const RankOneTerm huge{9, NodePattern::none, {1, 0, 0}, 1.5e308};
  EXPECT_EQ(cholesky.update(std::vector{huge, huge}), SolveStatus::not_finite);
  EXPECT_FALSE(cholesky.has_factor());
}

TEST(Cholesky, UpdateFollowsADissociatedVertexIntoASpareRow) {
  for (const FactorKind kind : {FactorKind::simplicial, FactorKind::supernodal}) {
    BodyMatrix before(disturbed_grid());
    const BodyMatrix after(with_vertex_dissociated(before.arrays));
    Cholesky cholesky({.kind = kind, .spare_nodes = 1});
    ASSERT_EQ(cholesky.factorise(before.blocks), SolveStatus::ok);
    const auto terms = before.matrix.follow(after.arrays.system(), after.tangents, cholesky.spare_diagonal());
    ASSERT_EQ(cholesky.update(terms), SolveStatus::ok);
    EXPECT_LT(solved_error(cholesky, after.blocks), 50 * epsilon);
    EXPECT_EQ(cholesky.counters().factorisations, 1u);
    EXPECT_EQ(cholesky.counters().rank_one_updates, terms.size());
  }
}

TEST(Cholesky, UpdateAndDowndateLeadBack) {
  BodyMatrix body(disturbed_grid());
  Cholesky cholesky({.kind = FactorKind::simplicial});
  ASSERT_EQ(cholesky.factorise(body.blocks), SolveStatus::ok);
  for (int edit = 0; edit < 100; ++edit) {
    SpringArrays less = body.arrays;
    less.springs[static_cast<std::size_t>(edit) * 7 % less.springs.size()].stiffness = 0.0;
    StepMatrix matrix = body.matrix;
    std::vector<SpringTangent> tangents;
    evaluate_tangents(less.system(), less.x, Compression::projected, tangents);
    ASSERT_EQ(cholesky.update(matrix.follow(less.system(), tangents, 1.0)), SolveStatus::ok);
    ASSERT_EQ(cholesky.update(matrix.follow(body.arrays.system(), body.tangents, 1.0)), SolveStatus::ok);
  }
  EXPECT_LT(solved_error(cholesky, body.blocks), 20 * epsilon);
}

TEST(Cholesky, RuleUpdatesForFewTermsAndFactorsForMany) {
  BodyMatrix before(spring_grid(6, 6, 6));
  Cholesky cholesky({.kind = FactorKind::supernodal, .spare_nodes = 4, .ready_for_updates = true});
  ASSERT_EQ(cholesky.factorise(before.blocks), SolveStatus::ok);
  const BodyMatrix after(with_vertex_dissociated(before.arrays));
  auto terms = before.matrix.follow(after.arrays.system(), after.tangents, cholesky.spare_diagonal());
  EXPECT_LT(cholesky.update_cost(terms), cholesky.factorisation_cost());
  ASSERT_EQ(cholesky.follow(after.blocks, terms), SolveStatus::ok);
  EXPECT_EQ(cholesky.counters().update_chosen, 1u);
  EXPECT_LT(solved_error(cholesky, after.blocks), 50 * epsilon);

  SpringArrays harder = after.arrays;
  for (Spring& spring : harder.springs) spring.damping += 1.0;
  const BodyMatrix all(harder);
  terms = before.matrix.follow(harder.system(), all.tangents, cholesky.spare_diagonal());
  EXPECT_GT(cholesky.update_cost(terms), cholesky.factorisation_cost());
  ASSERT_EQ(cholesky.follow(all.blocks, terms), SolveStatus::ok);
  EXPECT_EQ(cholesky.counters().refactor_chosen, 1u);
  EXPECT_LT(solved_error(cholesky, all.blocks), 20 * epsilon);
}

TEST(Cholesky, FactorIsRenewedAfterManyUpdates) {
  BodyMatrix body(disturbed_grid());
  Cholesky cholesky({.kind = FactorKind::simplicial, .renew_after = 20});
  ASSERT_EQ(cholesky.factorise(body.blocks), SolveStatus::ok);
  for (const double stiffness : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0}) {
    SpringArrays changed = body.arrays;
    changed.springs[40].stiffness = stiffness;
    const BodyMatrix after(changed);
    const auto terms = body.matrix.follow(changed.system(), after.tangents, 1.0);
    ASSERT_FALSE(terms.empty());
    ASSERT_EQ(cholesky.follow(after.blocks, terms), SolveStatus::ok);
    EXPECT_LT(solved_error(cholesky, after.blocks), 20 * epsilon);
  }
  EXPECT_EQ(cholesky.counters().update_chosen, 9u);  // of three terms each: six, a fresh factor, and three
  EXPECT_EQ(cholesky.counters().refactor_chosen, 1u);
}

TEST(Cholesky, NewVertexWithoutSpareRowIsAnalysedWithTheOldOrderingExtended) {
  BodyMatrix before(disturbed_grid());
  const BodyMatrix after(with_vertex_dissociated(before.arrays));
  Cholesky cholesky;
  ASSERT_EQ(cholesky.factorise(before.blocks), SolveStatus::ok);
  const auto terms = before.matrix.follow(after.arrays.system(), after.tangents, cholesky.spare_diagonal());
  EXPECT_EQ(cholesky.update(terms), SolveStatus::not_factored);
  ASSERT_EQ(cholesky.follow(after.blocks, terms), SolveStatus::ok);
  EXPECT_EQ(cholesky.counters().refactor_chosen, 1u);
  EXPECT_EQ(cholesky.counters().orderings, 1u);
  EXPECT_EQ(cholesky.counters().analyses, 2u);
  EXPECT_LT(solved_error(cholesky, after.blocks), 20 * epsilon);
}

TEST(Cholesky, AnalysedForANewVertexHasSpareRowsAgain) {
  const BodyMatrix before(disturbed_grid()), after(with_vertex_dissociated(before.arrays));
  Cholesky cholesky({.spare_nodes = 3});
  ASSERT_EQ(cholesky.factorise(before.blocks), SolveStatus::ok);
  const std::size_t at_first = before.arrays.x.size() + 3;
  ASSERT_EQ(cholesky.capacity(), at_first);
  // one vertex more than there is room for
  SpringArrays larger = after.arrays;
  while (larger.x.size() <= at_first) larger.add_vertex(1.0, {0, 0, 1.0 * static_cast<double>(larger.x.size())});
  const BodyMatrix beyond(larger);
  ASSERT_EQ(cholesky.factorise(beyond.blocks), SolveStatus::ok);
  EXPECT_EQ(cholesky.capacity(), larger.x.size() + 3);
  EXPECT_EQ(cholesky.counters().orderings, 1u);
  EXPECT_LT(solved_error(cholesky, beyond.blocks), 20 * epsilon);
}

/// A matrix that is the same for each of the three coordinates, in both forms.
struct Isotropic {
  ScalarMatrix scalars;
  BlockMatrix blocks;

  explicit Isotropic(const BlockMatrix& like) : scalars{like.pattern, {}, {}}, blocks(like) {
    for (Matrix3d& block : blocks.diagonal) {
      scalars.diagonal.push_back(block.trace());
      block = scalars.diagonal.back() * Matrix3d::Identity();
    }
    for (Matrix3d& block : blocks.below) {
      scalars.below.push_back(block.trace() / 3);
      block = scalars.below.back() * Matrix3d::Identity();
    }
  }
};

TEST(Cholesky, ScalarMatrixServesThreeCoordinates) {
  const Isotropic both(BodyMatrix(disturbed_grid()).blocks);
  Cholesky cholesky;
  ASSERT_EQ(cholesky.factorise(both.scalars), SolveStatus::ok);
  EXPECT_LT(solved_error(cholesky, both.blocks), 20 * epsilon);
}

// The pattern is the same, the number of unknowns is not.
TEST(Cholesky, FactorsBlocksAfterScalarsOfTheSamePatternAndTheReverse) {
  const Isotropic both(BodyMatrix(disturbed_grid()).blocks);
  Cholesky cholesky;
  for (int turn = 0; turn < 2; ++turn) {
    ASSERT_EQ(cholesky.factorise(both.scalars), SolveStatus::ok);
    EXPECT_LT(solved_error(cholesky, both.blocks), 20 * epsilon);
    ASSERT_EQ(cholesky.factorise(both.blocks), SolveStatus::ok);
    EXPECT_LT(solved_error(cholesky, both.blocks), 20 * epsilon);
  }
  EXPECT_EQ(cholesky.counters().analyses, 4u);
}

TEST(BackwardError, SumsItsResidualInExtendedPrecision) {
  // (1 + 2^-31)^2 = 1 + 2^-30 + 2^-62, which takes 63 bits
  BlockMatrix matrix;
  matrix.pattern.column_start = {0, 0};
  matrix.diagonal.assign(1, (1.0 + 0x1p-31) * Matrix3d::Identity());
  const std::vector<Vector3d> x(1, Vector3d::Constant(1.0 + 0x1p-31)), b(1, Vector3d::Constant(1.0 + 0x1p-30));
  const long double expected = 1.0L + 0x1p-30L - (1.0L + 0x1p-31L) * (1.0L + 0x1p-31L);
  EXPECT_EQ(extended_residual(matrix, b, x)[0].x(), expected);
}

TEST(BackwardError, SeesWhatIsNotANumber) {
  const BodyMatrix body(disturbed_grid());
  auto b = random_vectors(body.blocks.node_count(), 1), x = b;
  x[0].x() = NAN;
  EXPECT_TRUE(std::isnan(backward_error(body.blocks, b, x)));
}

TEST(MaxOrNan, KeepsWhatTheStandardMaximumLoses) {
  EXPECT_EQ(std::max(1.0, std::nan("")), 1.0);
  EXPECT_TRUE(std::isnan(max_or_nan(1.0, std::nan(""))));
  EXPECT_TRUE(std::isnan(max_or_nan(std::nan(""), 1.0)));
  EXPECT_EQ(max_or_nan(1.0, 2.0), 2.0);
}

TEST(MaxOrNan, OfCoordinatesIsNotANumberWhereverOneIsNone) {
  const std::vector<Vector3d> good{{0, -3, 1}, {2, 0, 0}};
  EXPECT_EQ(max_abs_or_nan(good), 3.0);
  for (std::size_t i = 0; i < 6; ++i) {
    auto bad = good;
    bad[i / 3][static_cast<int>(i % 3)] = NAN;
    EXPECT_TRUE(std::isnan(max_abs_or_nan(bad))) << i;
  }
}

// Refusals come before any change.
TEST(Cholesky, KeepsItsFactorWhenATermIsNotANumber) {
  const BodyMatrix body(disturbed_grid());
  for (const bool in_weight : {true, false}) {
    Cholesky cholesky;
    ASSERT_EQ(cholesky.factorise(body.blocks), SolveStatus::ok);
    RankOneTerm bad{9, NodePattern::none, {1, 0, 0}, 1.0};
    (in_weight ? bad.weight : bad.direction.y()) = NAN;
    const RankOneTerm good{4, NodePattern::none, {0, 1, 0}, 1.0};
    EXPECT_EQ(cholesky.update(std::vector{good, bad}), SolveStatus::not_finite);
    ASSERT_TRUE(cholesky.has_factor());
    EXPECT_EQ(cholesky.counters().rank_one_updates, 0u);
    EXPECT_LT(solved_error(cholesky, body.blocks), 20 * epsilon);
  }
}

}  // namespace
}  // namespace dartboard::cholesky_test
