#include "core/time/cholesky.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/time/backward_error.h"
#include "core/time/nan_proof.h"
#include "tests/spring_bodies_for_tests.h"

namespace dartboard {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

struct Body {
  SpringArrays arrays;
  std::vector<SpringTangent> tangents;
  StepMatrix matrix;
  BlockMatrix blocks;

  explicit Body(SpringArrays body, Compression compression = Compression::projected, double tau = 0.02)
      : arrays(std::move(body)) {
    const SpringSystem system = arrays.system();
    evaluate_tangents(system, arrays.x, compression, tangents);
    matrix.evaluate(system, tangents, tau);
    matrix.assemble(node_pattern_of(system), blocks);
  }
};

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

double solved_error(Cholesky& cholesky, const BlockMatrix& blocks) {
  const auto b = random_vectors(blocks.node_count(), 11);
  auto x = b;
  EXPECT_EQ(cholesky.solve(b, x), SolveStatus::ok);
  return backward_error(blocks, b, x);
}

// A spring that leaves vertex 21 for a new vertex, with half of the mass.
SpringArrays dissociated(SpringArrays body) {
  const std::uint32_t old = 21, added = body.add_vertex(body.mass[old] / 2, body.x[old]);
  body.mass[old] /= 2;
  body.inverse_mass[old] *= 2;
  bool leaves = false;
  for (SpringEnds& ends : body.ends)
    for (std::uint32_t& end : ends)
      if (end == old && (leaves = !leaves)) end = added;
  return body;
}

// The backward error of a Cholesky solution in n unknowns is at most about 8 n epsilon componentwise in theory
// (Higham, theorem 10.3 and 10.4, for |R'||R| near |A|) and a few epsilon in practice; 20 epsilon tells a factor of
// this matrix from one of another.
TEST(Cholesky, SolvesByEveryKindOfFactorAndOrdering) {
  const Body body(disturbed_grid());
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
  const Body body(arrays);
  Cholesky cholesky;
  ASSERT_EQ(cholesky.factorise(body.blocks), SolveStatus::ok);
  const auto b = random_vectors(body.blocks.node_count(), 2);
  auto x = b;
  ASSERT_EQ(cholesky.solve_refined(body.blocks, b, x), SolveStatus::ok);
  EXPECT_LT(backward_error(body.blocks, b, x), epsilon);
}

TEST(Cholesky, IndefiniteMatrixIsReportedByEveryKindOfFactor) {
  const Body body(crushed_grid(), Compression::exact, 1.0);
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

TEST(Cholesky, FactorsAgainAfterAnIndefiniteMatrix) {
  const Body bad(crushed_grid(), Compression::exact, 1.0), good(crushed_grid(), Compression::projected, 1.0);
  Cholesky cholesky;
  ASSERT_EQ(cholesky.factorise(bad.blocks), SolveStatus::not_positive_definite);
  ASSERT_EQ(cholesky.factorise(good.blocks), SolveStatus::ok);
  EXPECT_LT(solved_error(cholesky, good.blocks), 20 * epsilon);
  EXPECT_EQ(cholesky.counters().analyses, 1u);
}

TEST(Cholesky, NotANumberIsReportedInMatrixAndRightSide) {
  Body body(disturbed_grid());
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
  const Body body(disturbed_grid());
  Cholesky cholesky;
  ASSERT_EQ(cholesky.factorise(body.blocks), SolveStatus::ok);
  const std::vector<RankOneTerm> terms{{9, NodePattern::none, {1, 0, 0}, -2.0 * body.blocks.diagonal[9](0, 0)}};
  EXPECT_EQ(cholesky.update(terms), SolveStatus::not_positive_definite);
  EXPECT_FALSE(cholesky.has_factor());
}

TEST(Cholesky, UpdateFollowsADissociatedVertexIntoASpareRow) {
  for (const FactorKind kind : {FactorKind::simplicial, FactorKind::supernodal}) {
    Body before(disturbed_grid());
    const Body after(dissociated(before.arrays));
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
  Body body(disturbed_grid());
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
  Body before(spring_grid(6, 6, 6));
  Cholesky cholesky({.kind = FactorKind::supernodal, .spare_nodes = 4, .ready_for_updates = true});
  ASSERT_EQ(cholesky.factorise(before.blocks), SolveStatus::ok);
  const Body after(dissociated(before.arrays));
  auto terms = before.matrix.follow(after.arrays.system(), after.tangents, cholesky.spare_diagonal());
  EXPECT_LT(cholesky.update_cost(terms), cholesky.factorisation_cost());
  ASSERT_EQ(cholesky.follow(after.blocks, terms), SolveStatus::ok);
  EXPECT_EQ(cholesky.counters().update_chosen, 1u);
  EXPECT_LT(solved_error(cholesky, after.blocks), 50 * epsilon);

  SpringArrays harder = after.arrays;
  for (Spring& spring : harder.springs) spring.damping += 1.0;
  const Body all(harder);
  terms = before.matrix.follow(harder.system(), all.tangents, cholesky.spare_diagonal());
  EXPECT_GT(cholesky.update_cost(terms), cholesky.factorisation_cost());
  ASSERT_EQ(cholesky.follow(all.blocks, terms), SolveStatus::ok);
  EXPECT_EQ(cholesky.counters().refactor_chosen, 1u);
  EXPECT_LT(solved_error(cholesky, all.blocks), 20 * epsilon);
}

TEST(Cholesky, FactorIsRenewedAfterManyUpdates) {
  Body body(disturbed_grid());
  Cholesky cholesky({.kind = FactorKind::simplicial, .renew_after = 20});
  ASSERT_EQ(cholesky.factorise(body.blocks), SolveStatus::ok);
  for (const double stiffness : {1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0, 8.0, 9.0, 10.0}) {
    SpringArrays changed = body.arrays;
    changed.springs[40].stiffness = stiffness;
    const Body after(changed);
    const auto terms = body.matrix.follow(changed.system(), after.tangents, 1.0);
    ASSERT_FALSE(terms.empty());
    ASSERT_EQ(cholesky.follow(after.blocks, terms), SolveStatus::ok);
    EXPECT_LT(solved_error(cholesky, after.blocks), 20 * epsilon);
  }
  EXPECT_GT(cholesky.counters().update_chosen, 5u);
  EXPECT_GE(cholesky.counters().refactor_chosen, 1u);
}

TEST(Cholesky, NewVertexWithoutSpareRowIsAnalysedWithTheOldOrderingExtended) {
  Body before(disturbed_grid());
  const Body after(dissociated(before.arrays));
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
  const Isotropic both(Body(disturbed_grid()).blocks);
  Cholesky cholesky;
  ASSERT_EQ(cholesky.factorise(both.scalars), SolveStatus::ok);
  EXPECT_LT(solved_error(cholesky, both.blocks), 20 * epsilon);
}

// The pattern is the same, the number of unknowns is not.
TEST(Cholesky, FactorsBlocksAfterScalarsOfTheSamePatternAndTheReverse) {
  const Isotropic both(Body(disturbed_grid()).blocks);
  Cholesky cholesky;
  for (int turn = 0; turn < 2; ++turn) {
    ASSERT_EQ(cholesky.factorise(both.scalars), SolveStatus::ok);
    EXPECT_LT(solved_error(cholesky, both.blocks), 20 * epsilon);
    ASSERT_EQ(cholesky.factorise(both.blocks), SolveStatus::ok);
    EXPECT_LT(solved_error(cholesky, both.blocks), 20 * epsilon);
  }
  EXPECT_EQ(cholesky.counters().analyses, 4u);
}

TEST(BackwardError, SeesWhatIsNotANumber) {
  const Body body(disturbed_grid());
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

}  // namespace
}  // namespace dartboard
