#include "core/time/solve/step_solver.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/spring_bodies_for_tests.h"

namespace dartboard::step_solver_test {
namespace {

using Eigen::Vector3d;

TangentsAt tangents_at(const SpringArrays& body) {
  return {[&body](Compression compression, std::vector<SpringTangent>& result) {
    evaluate_tangents(body.system(), body.x, compression, result);
  }};
}

SpringArrays damped_grid() {
  SpringArrays body = spring_grid(2, 2, 2, 50.0, 0.2);
  body.fixed[4] = 1;
  for (std::size_t i = 0; i < body.x.size(); ++i) body.viscosity[i] = 0.5 * body.mass[i];
  disturb(body, 0.005, 0.0);
  return body;
}

/// |b - A x| / |b|.
double relative_residual(const StepMatrix& matrix, std::span<const Vector3d> b, std::span<const Vector3d> x) {
  std::vector<Vector3d> y(b.size());
  matrix.multiply(x, y);
  double r = 0.0, s = 0.0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    r += (b[i] - y[i]).squaredNorm();
    s += b[i].squaredNorm();
  }
  return std::sqrt(r / s);
}

// For a factor of the first body the second is another body: conjugate gradients do not reach the rounding with it in
// the four iterations that a patience of one allows.
TEST(StepSolver, FactorsOnceWhenAKeptFactorIsWornOut) {
  SpringArrays first = spring_grid(2, 2, 2), second = first;
  for (Vector3d& p : second.x) p = Vector3d(p.y(), 2.0 * p.z(), 3.0 * p.x());
  StepSolver solver({.patience = 1});
  WorkCounters work;
  const auto b = random_vectors(first.x.size(), 4);
  std::vector<Vector3d> x(b.size());
  const auto prepare = [&](const SpringArrays& body) {
    return solver.prepare(body.system(), tangents_at(body), 0.02, work);
  };
  ASSERT_EQ(prepare(first), SolveStatus::ok);
  ASSERT_EQ(prepare(second), SolveStatus::ok);
  EXPECT_EQ(work.factorisations, 1u);
  ASSERT_EQ(solver.solve(b, x, Accuracy::full, work), SolveStatus::ok);
  EXPECT_EQ(work.factorisations, 2u);
  ASSERT_EQ(prepare(second), SolveStatus::ok);
  EXPECT_EQ(work.factorisations, 2u);
  ASSERT_EQ(solver.solve(b, x, Accuracy::full, work), SolveStatus::ok);
  EXPECT_EQ(work.factorisations, 2u);
}

// ---- counts

TEST(StepSolver, CountsAssembliesFactorsAndSolutionsAndAnalysesOnce) {
  const SpringArrays body = damped_grid();
  const ImplicitOptions options{.solver = LinearSolver::fresh_factor};
  StepSolver solver(options);
  WorkCounters work;
  const auto b = random_vectors(body.x.size(), 4);
  std::vector<Vector3d> x(b.size());
  for (const double tau : {0.01, 0.02, 0.04}) {
    ASSERT_EQ(solver.prepare(body.system(), tangents_at(body), tau, work), SolveStatus::ok);
    ASSERT_EQ(solver.solve(b, x, Accuracy::full, work), SolveStatus::ok);
  }
  EXPECT_EQ(work.assemblies, 3u);
  EXPECT_EQ(work.factorisations, 3u);
  EXPECT_EQ(work.solves, 3u);
  EXPECT_EQ(work.analyses, 1u);
  EXPECT_EQ(work.linear_iterations, 0u);
  const auto foreseen = forecast_factor(body.system(), options);
  EXPECT_EQ(work.factor_nonzeros, foreseen->numbers);
  EXPECT_EQ(foreseen->unknowns, 3 * body.x.size());
  EXPECT_EQ(foreseen->seconds, solver.cholesky().factorisation_cost());
}

TEST(StepSolver, CountsTheIterationsOfConjugateGradients) {
  const SpringArrays body = damped_grid();
  const ImplicitOptions options{.solver = LinearSolver::conjugate_gradients};
  StepSolver solver(options);
  WorkCounters work;
  const auto b = random_vectors(body.x.size(), 4);
  std::vector<Vector3d> x(b.size(), Vector3d(1, 1, 1)), y(b.size(), Vector3d(0, 0, 0));
  ASSERT_EQ(solver.prepare(body.system(), tangents_at(body), 0.05, work), SolveStatus::ok);
  ASSERT_EQ(solver.solve(b, x, Accuracy::full, work), SolveStatus::ok);
  const auto alone = ConjugateGradients().solve(solver.matrix(), b, y, options.conjugate_gradients);
  EXPECT_GT(alone.iterations, 2);
  EXPECT_EQ(work.linear_iterations, static_cast<std::uint64_t>(alone.iterations));
  EXPECT_EQ(work.factorisations, 0u);
  EXPECT_EQ(work.solves, 1u);
}

// Each iteration with a factor solves with it once.
TEST(StepSolver, CountsTheSolutionsWithAKeptFactor) {
  const SpringArrays first = damped_grid();
  SpringArrays second = first;
  disturb(second, 0.01, 0.0, 3);
  StepSolver solver({.tangent = TangentPolicy::projected});
  solver.begin_step();
  WorkCounters work;
  const auto b = random_vectors(first.x.size(), 4);
  std::vector<Vector3d> x(b.size());
  ASSERT_EQ(solver.prepare(first.system(), tangents_at(first), 0.05, work), SolveStatus::ok);
  ASSERT_EQ(solver.prepare(second.system(), tangents_at(second), 0.05, work), SolveStatus::ok);
  ASSERT_EQ(solver.solve(b, x, Accuracy::full, work), SolveStatus::ok);
  EXPECT_EQ(work.factorisations, 1u);
  EXPECT_GT(work.linear_iterations, 2u);
  EXPECT_EQ(work.solves, work.linear_iterations);
}

// ---- the residual reached

TEST(StepSolver, GoesAllTheWayWhenAskedAndAsFarAsAnIterationNeedsOtherwise) {
  const SpringArrays first = damped_grid();
  SpringArrays second = first;
  disturb(second, 0.01, 0.0, 3);
  const ImplicitOptions options{.tangent = TangentPolicy::projected};
  StepSolver solver(options);
  solver.begin_step();
  WorkCounters work;
  auto b = random_vectors(first.x.size(), 4);
  b[4].setZero();  // held
  std::vector<Vector3d> x(b.size());
  ASSERT_EQ(solver.prepare(first.system(), tangents_at(first), 0.05, work), SolveStatus::ok);
  ASSERT_EQ(solver.prepare(second.system(), tangents_at(second), 0.05, work), SolveStatus::ok);
  ASSERT_EQ(solver.solve(b, x, Accuracy::iteration, work), SolveStatus::ok);
  EXPECT_LT(relative_residual(solver.matrix(), b, x), options.kept_tolerance);
  ASSERT_EQ(solver.solve(b, x, Accuracy::full, work), SolveStatus::ok);
  EXPECT_LT(relative_residual(solver.matrix(), b, x), 1e-11);
}

// ---- the constant matrix

// m + tau c + tau^2 k of each spring, whatever its direction; some 15 springs to a row, a factor of this matrix to
// 1e-12.
TEST(StepSolver, SolvesWithTheConstantMatrixOfTheGraph) {
  const SpringArrays body = damped_grid();
  StepSolver solver({.solver = LinearSolver::laplacian});
  WorkCounters work;
  const double tau = 0.03;
  auto b = random_vectors(body.x.size(), 4);
  std::vector<Vector3d> x(b.size()), y(b.size());
  ASSERT_EQ(solver.prepare(body.system(), tangents_at(body), tau, work), SolveStatus::ok);
  ASSERT_EQ(solver.solve(b, x, Accuracy::full, work), SolveStatus::ok);
  for (std::size_t i = 0; i < y.size(); ++i)
    y[i] = body.fixed[i] ? x[i] : Vector3d((body.mass[i] + tau * body.viscosity[i]) * x[i]);
  for (std::size_t s = 0; s < body.springs.size(); ++s) {
    const auto [i, j] = body.ends[s];
    const double weight = tau * body.springs[s].damping + tau * tau * body.springs[s].stiffness;
    const Vector3d of_i = body.fixed[i] ? Vector3d(0, 0, 0) : x[i], of_j = body.fixed[j] ? Vector3d(0, 0, 0) : x[j];
    if (!body.fixed[i]) y[i] += weight * (of_i - of_j);
    if (!body.fixed[j]) y[j] += weight * (of_j - of_i);
  }
  for (std::size_t i = 0; i < y.size(); ++i) EXPECT_LT((y[i] - b[i]).norm(), 1e-12) << i;
}

TEST(StepSolver, KeepsTheConstantFactorForStepsThatDifferByRoundingOnly) {
  const SpringArrays body = damped_grid();
  StepSolver solver({.solver = LinearSolver::laplacian});
  WorkCounters work;
  for (const auto& [tau, factors] : {std::pair{0.02, 1u}, {0.02 * (1 + 1e-15), 1u}, {0.022, 2u}, {0.02, 3u}}) {
    ASSERT_EQ(solver.prepare(body.system(), tangents_at(body), tau, work), SolveStatus::ok);
    EXPECT_EQ(work.factorisations, factors) << tau;
  }
}

// ---- projections

TEST(StepSolver, ProjectsTwiceAsLongAfterEachFailureUpToSixteenTimes) {
  const SpringArrays body = damped_grid();
  StepSolver solver({.solver = LinearSolver::conjugate_gradients});
  solver.begin_step();
  WorkCounters work;
  for (const int expected : {1, 2, 4, 8, 16, 16}) {
    solver.project(work);
    int lasts = 0;
    for (; lasts < 100; ++lasts) {
      ASSERT_EQ(solver.prepare(body.system(), tangents_at(body), 0.02, work), SolveStatus::ok);
      if (!solver.is_projecting()) break;
    }
    EXPECT_EQ(lasts, expected);
  }
  EXPECT_EQ(work.projections, 6u);
  solver.project(work);
  solver.begin_step();
  EXPECT_FALSE(solver.is_projecting());
}

// ---- diagnoses

TEST(StepSolver, SaysWhySolutionsFail) {
  const StepSolver unused({});
  EXPECT_TRUE(diagnosis_of(SolveStatus::ok, unused).ok());
  EXPECT_EQ(to_string(diagnosis_of(SolveStatus::not_positive_definite, unused)), "NOT_POSDEF: curvature = 0");
  EXPECT_EQ(diagnosis_of(SolveStatus::not_converged, unused).code, StepCode::newton_stalled);
  EXPECT_EQ(diagnosis_of(SolveStatus::not_converged, unused).quantity, "linear residual");
  EXPECT_EQ(diagnosis_of(SolveStatus::not_finite, unused).code, StepCode::nonfinite);
  EXPECT_EQ(to_string(diagnosis_of(SolveStatus::out_of_memory, unused)), "BUDGET: memory = 0");
  EXPECT_EQ(diagnosis_of(SolveStatus::not_factored, unused).code, StepCode::budget);
}

TEST(StepSolver, NamesTheVertexWithoutAPivotAndTheOneThatIsNotFinite) {
  SpringArrays body = damped_grid();
  body.mass[9] = -1e3;
  StepSolver solver({.solver = LinearSolver::fresh_factor});
  solver.begin_step();
  WorkCounters work;
  SolveStatus status = solver.prepare(body.system(), tangents_at(body), 0.01, work);
  ASSERT_EQ(status, SolveStatus::not_positive_definite);
  EXPECT_EQ(to_string(diagnosis_of(status, solver)), "NOT_POSDEF at vertex 9: pivot = 0");
  body.mass[9] = NAN;
  status = solver.prepare(body.system(), tangents_at(body), 0.01, work);
  ASSERT_EQ(status, SolveStatus::not_finite);
  const StepResult result = diagnosis_of(status, solver);
  EXPECT_EQ(result.code, StepCode::nonfinite);
  EXPECT_EQ(result.number, 9u);
  EXPECT_EQ(result.quantity, "matrix");
}

}  // namespace
}  // namespace dartboard::step_solver_test
