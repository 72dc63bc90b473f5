#include "core/time/system/tangent.h"

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "core/time/solve/step_matrix.h"
#include "core/walks/spring_forces.h"
#include "tests/support/spring_bodies_for_tests.h"

namespace dartboard::tangent_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
constexpr double epsilon = std::numeric_limits<double>::epsilon();
const Spring spring{1.0, 7.0, 0.3};

// Central differences with step s: the truncation is s^2/6 times the third derivative, at most 6 k / l^2 in size, and
// the rounding is a few epsilon k l / s. At s = 1e-5 and lengths of about 1 both are below 1e-9.
TEST(Tangent, StiffnessIsTheDerivativeOfTheForce) {
  for (const Vector3d& dx : {Vector3d(1.2, 0.3, -0.4), Vector3d(0.4, -0.3, 0.2), Vector3d(0, 0, 1)}) {
    const Matrix3d K = tangent_of(spring, dx, Compression::exact).stiffness();
    const double s = 1e-5;
    for (int c = 0; c < 3; ++c) {
      const Vector3d e = s * Vector3d::Unit(c), still(0, 0, 0);
      const Vector3d difference = (spring_force(spring, dx + e, still) - spring_force(spring, dx - e, still)) / (2 * s);
      EXPECT_LT((K.col(c) - difference).norm(), 1e-8);
    }
  }
}

// The force is linear in the velocity, so one difference is exact but for a few roundings.
TEST(Tangent, DampingIsTheDerivativeOfTheForceByVelocity) {
  const Vector3d dx(1.2, 0.3, -0.4), dv(0.1, 2.0, -1.0);
  const Matrix3d C = tangent_of(spring, dx, Compression::exact).damping_block();
  for (int c = 0; c < 3; ++c) {
    const Vector3d difference = spring_force(spring, dx, dv + Vector3d::Unit(c)) - spring_force(spring, dx, dv);
    EXPECT_LT((C.col(c) - difference).norm(), 20 * epsilon);
  }
}

TEST(Tangent, ProjectionTakesAwayTheNegativeEigenvaluesAndNothingElse) {
  const Vector3d shortened(0.4, -0.3, 0.2), stretched(1.2, 0.3, -0.4);
  const Matrix3d exact = tangent_of(spring, shortened, Compression::exact).stiffness();
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(exact);
  ASSERT_LT(solver.eigenvalues()[0], 0.0);
  const Matrix3d nearest =
      solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).asDiagonal() * solver.eigenvectors().transpose();
  const Matrix3d projected = tangent_of(spring, shortened, Compression::projected).stiffness();
  EXPECT_LT((projected - nearest).norm(), 50 * epsilon * exact.norm());
  EXPECT_EQ(tangent_of(spring, stretched, Compression::projected).stiffness(),
            tangent_of(spring, stretched, Compression::exact).stiffness());
}

TEST(Tangent, SpringWithoutLengthResistsInEveryDirectionAndDampsInNone) {
  const SpringTangent t = tangent_of(spring, {0, 0, 0}, Compression::exact);
  EXPECT_EQ(t.stiffness(), spring.stiffness * Matrix3d::Identity());
  EXPECT_EQ(t.damping_block(), Matrix3d::Zero());
}

struct Assembled {
  SpringArrays body = spring_grid(2, 1, 1, 50.0, 0.2);
  std::vector<SpringTangent> tangents;
  StepMatrix matrix;
  BlockMatrix blocks;

  Assembled() {
    body.fixed[3] = body.fixed[7] = 1;
    for (std::size_t i = 0; i < body.x.size(); ++i) body.viscosity[i] = 0.5 * body.mass[i];
    disturb(body, 0.02, 1.0);
    const SpringSystem system = body.system();
    evaluate_tangents(system, body.x, Compression::exact, tangents);
    matrix.evaluate(system, tangents, 0.01);
    matrix.assemble(node_pattern_of(system), blocks);
  }
};

// Two orders of the same sums: terms of a row are at most 2 * 15 springs of three products each.
TEST(StepMatrix, ProductsFromSpringsAndFromEntriesAgree) {
  const Assembled a;
  const auto x = random_vectors(a.body.x.size(), 3);
  auto zeroed = x;
  zeroed[3] = zeroed[7] = Vector3d(0, 0, 0);
  auto y = x, z = x;
  a.matrix.multiply(zeroed, y);
  a.blocks.multiply(zeroed, z);
  double size = 0.0;
  for (const Matrix3d& block : a.blocks.diagonal) size = std::max(size, block.norm());
  for (std::size_t i = 0; i < x.size(); ++i) EXPECT_LT((y[i] - z[i]).norm(), 200 * epsilon * size);
}

TEST(StepMatrix, FixedVerticesAreIdentityRows) {
  const Assembled a;
  std::vector<Vector3d> unit(a.body.x.size(), Vector3d(0, 0, 0)), y = unit;
  unit[3] = {1, 2, 3};
  a.blocks.multiply(unit, y);
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_EQ(y[i], unit[i]);
  for (std::size_t j = 0; j < a.body.x.size(); ++j)
    for (std::uint32_t k = a.blocks.pattern.column_start[j]; k < a.blocks.pattern.column_start[j + 1]; ++k)
      EXPECT_FALSE(a.body.fixed[j] || a.body.fixed[a.blocks.pattern.row[k]]);
}

TEST(StepMatrix, SpringsBetweenFixedVerticesCoupleNothing) {
  Assembled a;
  const auto [p, q] = a.body.ends[0];
  a.body.fixed[p] = a.body.fixed[q] = 1;
  a.matrix.evaluate(a.body.system(), a.tangents, 0.01);
  const auto x = random_vectors(a.body.x.size(), 3);
  auto y = x;
  a.matrix.multiply(x, y);
  EXPECT_EQ(y[p], x[p]);
  EXPECT_EQ(y[q], x[q]);
}

// A w = M w + tau C w + tau^2 K w, summed from the blocks of tangent.h.
TEST(StepMatrix, IsTheSumOfItsParts) {
  const Assembled a;
  auto w = random_vectors(a.body.x.size(), 5);
  w[3] = w[7] = Vector3d(0, 0, 0);
  std::vector<Vector3d> expected(w.size()), stiffness(w.size()), y(w.size());
  multiply_stiffness(a.body.system(), a.tangents, w, stiffness);
  const double tau = 0.01;
  for (std::size_t i = 0; i < w.size(); ++i)
    expected[i] = (a.body.mass[i] + tau * a.body.viscosity[i]) * w[i] + tau * tau * stiffness[i];
  for (std::size_t e = 0; e < a.tangents.size(); ++e) {
    const auto [p, q] = a.body.ends[e];
    const Vector3d f = tau * a.tangents[e].damping_block() * (w[q] - w[p]);
    expected[p] -= f;
    expected[q] += f;
  }
  a.matrix.multiply(w, y);
  for (std::size_t i = 0; i < w.size(); ++i)
    if (!a.body.fixed[i]) {
      EXPECT_LT((y[i] - expected[i]).norm(), 1e3 * epsilon * a.blocks.diagonal[i].norm());
    }
}

// All of a matrix, spare rows included.
Eigen::MatrixXd dense(const BlockMatrix& blocks, std::size_t capacity, double spare) {
  Eigen::MatrixXd result = spare * Eigen::MatrixXd::Identity(static_cast<Eigen::Index>(3 * capacity),
                                                             static_cast<Eigen::Index>(3 * capacity));
  for (std::size_t j = 0; j < blocks.node_count(); ++j) {
    const auto at = static_cast<Eigen::Index>(3 * j);
    result.block<3, 3>(at, at) = blocks.diagonal[j];
    for (std::uint32_t k = blocks.pattern.column_start[j]; k < blocks.pattern.column_start[j + 1]; ++k) {
      const Eigen::Index row = 3 * static_cast<Eigen::Index>(blocks.pattern.row[k]);
      result.block<3, 3>(row, at) = result.block<3, 3>(at, row) = blocks.below[k];
    }
  }
  return result;
}

// A vertex that is split, a removed spring, others that change, vertices that are held and released, and back again.
// Both sides are sums of at most 50 terms of the size of the largest entry.
TEST(StepMatrix, TermsOfAChangeLeadFromTheOldMatrixToTheNew) {
  const Assembled before;
  SpringArrays changed = before.body;
  const std::uint32_t added = changed.add_vertex(0.01, changed.x[5]);
  changed.mass[5] = 0.01;
  for (std::size_t e = 0; e < changed.ends.size(); e += 2)
    for (std::uint32_t& end : changed.ends[e])
      if (end == 5) end = added;
  changed.springs[3].stiffness *= 0.5;
  changed.springs[3].damping *= 0.5;
  changed.springs[4].damping = 3.0;
  changed.fixed[3] = 0;
  changed.fixed[2] = 1;
  changed.ends.pop_back();
  changed.springs.pop_back();

  StepMatrix followed = before.matrix;
  const double spare = 0.02;
  const std::size_t capacity = changed.x.size();
  Eigen::MatrixXd old_matrix = dense(before.blocks, capacity, spare);
  for (const SpringArrays* target : {static_cast<const SpringArrays*>(&changed), &before.body}) {
    std::vector<SpringTangent> tangents;
    evaluate_tangents(target->system(), target->x, Compression::exact, tangents);
    const auto terms = followed.follow(target->system(), tangents, spare);
    StepMatrix fresh;
    fresh.evaluate(target->system(), tangents, 0.01);
    BlockMatrix by_following, by_evaluating;
    followed.assemble(node_pattern_of(target->system()), by_following);
    fresh.assemble(node_pattern_of(target->system()), by_evaluating);
    const Eigen::MatrixXd expected = dense(by_evaluating, capacity, spare);
    for (const RankOneTerm& term : terms) {
      Eigen::VectorXd w = Eigen::VectorXd::Zero(old_matrix.rows());
      w.segment<3>(3 * static_cast<Eigen::Index>(term.first)) = term.direction;
      if (term.second != NodePattern::none) w.segment<3>(3 * static_cast<Eigen::Index>(term.second)) = -term.direction;
      old_matrix += term.weight * w * w.transpose();
    }
    const double bound = 50 * epsilon * expected.cwiseAbs().maxCoeff();
    EXPECT_LT((dense(by_following, capacity, spare) - expected).cwiseAbs().maxCoeff(), bound);
    EXPECT_LT((old_matrix - expected).cwiseAbs().maxCoeff(), bound);
  }
}

TEST(NodePattern, ParallelSpringsShareAnEntryAndRowsAscend) {
  SpringArrays body;
  for (int i = 0; i < 4; ++i) body.add_vertex(1.0, {1.0 * i, 0, 0});
  body.add_spring(0, 3, 1, 1);
  body.add_spring(2, 0, 1, 1);
  body.add_spring(3, 0, 1, 1);
  body.add_spring(1, 2, 1, 1);
  body.fixed[1] = 1;
  const NodePattern pattern = node_pattern_of(body.system());
  EXPECT_EQ(pattern.column_start, (std::vector<std::uint32_t>{0, 2, 2, 2, 2}));
  EXPECT_EQ(pattern.row, (std::vector<std::uint32_t>{2, 3}));
  EXPECT_EQ(pattern.place, (std::vector<std::uint32_t>{1, 0, 1, NodePattern::none}));
}

}  // namespace
}  // namespace dartboard::tangent_test
