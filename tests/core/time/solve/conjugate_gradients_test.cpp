#include "core/time/solve/conjugate_gradients.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/spring_bodies_for_tests.h"

namespace dartboard::conjugate_gradients_test {
namespace {

using Eigen::Vector3d;

struct Body {
  SpringArrays arrays = spring_grid(3, 3, 3);
  StepMatrix matrix;
  BlockMatrix blocks;

  explicit Body(double shrink = 1.0, Compression compression = Compression::projected, double tau = 0.02) {
    arrays.fixed[2] = 1;
    disturb(arrays, 0.01, 0);
    for (Vector3d& p : arrays.x) p *= shrink;
    std::vector<SpringTangent> tangents;
    evaluate_tangents(arrays.system(), arrays.x, compression, tangents);
    matrix.evaluate(arrays.system(), tangents, tau);
    matrix.assemble(node_pattern_of(arrays.system()), blocks);
  }
  std::vector<Vector3d> right() const {
    auto b = random_vectors(arrays.x.size(), 4);
    b[2].setZero();
    return b;
  }
};

double relative_residual(const Body& body, std::span<const Vector3d> b, std::span<const Vector3d> x) {
  std::vector<Vector3d> y(b.size());
  body.blocks.multiply(x, y);
  double r = 0, s = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    r += (b[i] - y[i]).squaredNorm();
    s += b[i].squaredNorm();
  }
  return std::sqrt(r / s);
}

// The residual is computed by the same products up to rounding, which is far below the tightest tolerance.
TEST(ConjugateGradients, MeetsTheToleranceFromSpringsAndFromEntries) {
  const Body body;
  const auto b = body.right();
  for (const double tolerance : {1e-2, 1e-6, 1e-10}) {
    ConjugateGradients solver;
    std::vector<Vector3d> x(b.size(), Vector3d(0, 0, 0)), y = x;
    const auto by_springs = solver.solve(body.matrix, b, x, {.tolerance = tolerance});
    const auto by_entries = solver.solve(body.blocks, b, y, {.tolerance = tolerance});
    EXPECT_EQ(by_springs.status, SolveStatus::ok);
    EXPECT_EQ(by_entries.status, SolveStatus::ok);
    EXPECT_LT(relative_residual(body, b, x), 1.1 * tolerance);
    EXPECT_LT(relative_residual(body, b, y), 1.1 * tolerance);
  }
}

TEST(ConjugateGradients, TellsTheResidualOfItsSolution) {
  const Body body;
  const auto b = body.right();
  std::vector<Vector3d> x(b.size(), Vector3d(0, 0, 0));
  const auto result = ConjugateGradients().solve(body.matrix, b, x, {.tolerance = 1e-5});
  const double residual = relative_residual(body, b, x);
  EXPECT_NEAR(result.residual, residual, 1e-6 * residual);
  EXPECT_GT(result.iterations, 1);
}

TEST(ConjugateGradients, StartsFromWhatItIsGiven) {
  const Body body;
  const auto b = body.right();
  std::vector<Vector3d> x(b.size(), Vector3d(0, 0, 0));
  const auto first = ConjugateGradients().solve(body.matrix, b, x, {.tolerance = 1e-8});
  EXPECT_EQ(ConjugateGradients().solve(body.matrix, b, x, {.tolerance = 1e-7}).iterations, 0);
  x[0] *= 1 + 1e-6;
  const auto again = ConjugateGradients().solve(body.matrix, b, x, {.tolerance = 1e-8});
  EXPECT_EQ(again.status, SolveStatus::ok);
  EXPECT_LT(relative_residual(body, b, x), 1.1e-8);
  EXPECT_GT(again.iterations, 0);
  EXPECT_LT(again.iterations, first.iterations);
}

TEST(ConjugateGradients, IndefiniteMatrixIsReported) {
  const Body folded(0.3, Compression::exact, 1.0), crushed(0.05, Compression::exact, 1.0);
  for (const Body* body : {&folded, &crushed}) {
    const auto b = body->right();
    std::vector<Vector3d> x(b.size(), Vector3d(0, 0, 0));
    EXPECT_EQ(ConjugateGradients().solve(body->matrix, b, x, {.tolerance = 1e-10}).status,
              SolveStatus::not_positive_definite);
  }
}

// A saddle with sound diagonal blocks: only a direction of negative curvature gives it away.
TEST(ConjugateGradients, IndefiniteMatrixWithDefiniteDiagonalBlocksIsReported) {
  BlockMatrix saddle;
  saddle.pattern.column_start = {0, 1, 1};
  saddle.pattern.row = {1};
  saddle.diagonal.assign(2, Eigen::Matrix3d::Identity());
  saddle.below.assign(1, -2.0 * Eigen::Matrix3d::Identity());
  const std::vector<Vector3d> b(2, Vector3d(1, 1, 1));
  std::vector<Vector3d> x(2, Vector3d(0, 0, 0));
  EXPECT_EQ(ConjugateGradients().solve(saddle, b, x, {}).status, SolveStatus::not_positive_definite);
}

TEST(ConjugateGradients, ToleranceOutOfReachIsReported) {
  const Body body;
  const auto b = body.right();
  std::vector<Vector3d> x(b.size(), Vector3d(0, 0, 0));
  const auto few = ConjugateGradients().solve(body.matrix, b, x, {.tolerance = 1e-10, .max_iterations = 2});
  EXPECT_EQ(few.status, SolveStatus::not_converged);
  EXPECT_EQ(few.iterations, 2);
  const auto fine = ConjugateGradients().solve(body.matrix, b, x, {.tolerance = 1e-20, .max_iterations = 1000});
  EXPECT_EQ(fine.status, SolveStatus::not_converged);
}

TEST(ConjugateGradients, NotANumberIsReported) {
  Body body;
  auto b = body.right();
  std::vector<Vector3d> x(b.size(), Vector3d(0, 0, 0));
  b[1].z() = NAN;
  EXPECT_EQ(ConjugateGradients().solve(body.matrix, b, x, {}).status, SolveStatus::not_finite);
  body.blocks.below[0](0, 0) = NAN;
  EXPECT_EQ(ConjugateGradients().solve(body.blocks, body.right(), x, {}).status, SolveStatus::not_finite);
}

// A step along the solution of the wrong factor overflows, and the coordinates of zero become NaN.
TEST(ConjugateGradients, ResidualThatIsNoNumberIsNotConverged) {
  SpringArrays speck;
  speck.add_vertex(1e-309, {0, 0, 0});
  StepMatrix matrix;
  matrix.evaluate(speck.system(), {}, 0.1);
  BlockMatrix one;
  one.pattern = node_pattern_of(speck.system());
  one.diagonal.assign(1, Eigen::Matrix3d::Identity());
  Cholesky factor;
  ASSERT_EQ(factor.factorise(one), SolveStatus::ok);
  const std::vector<Vector3d> b(1, Vector3d(1, 0, 0));
  std::vector<Vector3d> x(1);
  EXPECT_EQ(ConjugateGradients().solve(matrix, factor, b, x, {}).status, SolveStatus::not_finite);
}

// Squares of right sides beyond 1e154 overflow, and below 1e-162 they vanish; times a power of two digits are the same.
TEST(ConjugateGradients, RightSidesOfAnySizeHaveTheSameDigits) {
  const Body near(1.05), body;
  const auto b = body.right();
  Cholesky factor;
  ASSERT_EQ(factor.factorise(near.blocks), SolveStatus::ok);
  std::vector<Vector3d> x(b.size(), Vector3d(0, 0, 0)), y = x;
  ASSERT_EQ(ConjugateGradients().solve(body.matrix, factor, b, x, {.tolerance = 1e-8}).status, SolveStatus::ok);
  ASSERT_EQ(ConjugateGradients().solve(body.matrix, b, y, {.tolerance = 1e-8}).status, SolveStatus::ok);
  for (const int exponent : {-800, -560, 560, 800}) {
    std::vector<Vector3d> right = b, u(b.size(), Vector3d(0, 0, 0)), v = u;
    for (Vector3d& p : right) p *= std::ldexp(1.0, exponent);
    EXPECT_EQ(ConjugateGradients().solve(body.matrix, factor, right, u, {.tolerance = 1e-8}).status, SolveStatus::ok);
    EXPECT_EQ(ConjugateGradients().solve(body.matrix, right, v, {.tolerance = 1e-8}).status, SolveStatus::ok);
    for (std::size_t i = 0; i < b.size(); ++i) {
      ASSERT_EQ(u[i], std::ldexp(1.0, exponent) * x[i]) << exponent;
      ASSERT_EQ(v[i], std::ldexp(1.0, exponent) * y[i]) << exponent;
    }
  }
}

TEST(ConjugateGradients, FactorOfTheMatrixItselfSolvesInOneIteration) {
  const Body body;
  const auto b = body.right();
  std::vector<Vector3d> x(b.size());
  Cholesky factor;
  ASSERT_EQ(factor.factorise(body.blocks), SolveStatus::ok);
  const auto result = ConjugateGradients().solve(body.matrix, factor, b, x, {.tolerance = 1e-12});
  EXPECT_EQ(result.status, SolveStatus::ok);
  EXPECT_EQ(result.iterations, 1);
  EXPECT_LT(relative_residual(body, b, x), 1e-12);
}

TEST(ConjugateGradients, FactorOfANearbyMatrixSolvesInFewerIterationsThanTheDiagonal) {
  const Body near(1.05), body(1.0, Compression::projected, 0.02);
  const auto b = body.right();
  std::vector<Vector3d> x(b.size(), Vector3d(0, 0, 0)), y = x;
  Cholesky factor;
  ASSERT_EQ(factor.factorise(near.blocks), SolveStatus::ok);
  const auto with_factor = ConjugateGradients().solve(body.matrix, factor, b, x, {.tolerance = 1e-8});
  const auto with_diagonal = ConjugateGradients().solve(body.matrix, b, y, {.tolerance = 1e-8});
  EXPECT_EQ(with_factor.status, SolveStatus::ok);
  EXPECT_LT(with_factor.iterations, with_diagonal.iterations);
  EXPECT_LT(relative_residual(body, b, x), 1.1e-8);
}

}  // namespace
}  // namespace dartboard::conjugate_gradients_test
