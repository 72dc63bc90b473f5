#include "core/time/implicit/implicit_stage.h"

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

#include "core/time/system/accelerations.h"
#include "core/time/system/energy.h"
#include "tests/support/spring_bodies_for_tests.h"

namespace dartboard::implicit_stage_test {
namespace {

using Eigen::Vector3d;
constexpr LinearSolver solvers[] = {LinearSolver::fresh_factor, LinearSolver::kept_factor,
                                    LinearSolver::conjugate_gradients, LinearSolver::laplacian};

SpringArrays moving_grid(double damping = 0.05) {
  SpringArrays body = spring_grid(2, 2, 2, 50.0, damping);
  body.gravity = {0, 0, -9.81};
  body.fixed[0] = body.fixed[1] = 1;
  for (std::size_t i = 0; i < body.x.size(); ++i) body.viscosity[i] = 0.5 * body.mass[i];
  disturb(body, 0.005, 0.2);
  return body;
}

struct Solved {
  StepResult result;
  WorkCounters work;
  std::vector<Vector3d> w;
};

Solved solve(const SpringArrays& body, const ImplicitOptions& options, double tau) {
  Solved solved;
  ImplicitStage stage(options);
  stage.begin_step();
  solved.w = body.v;
  solved.result = stage.solve(body.system(), body.x, body.v, tau, StageForce::at_end, solved.w, solved.work);
  return solved;
}

// max |w - vh - tau a(xh + tau w, w)| over the free vertices, from the forces of the explicit methods.
double defect(const SpringArrays& body, std::span<const Vector3d> w, double tau) {
  std::vector<Vector3d> x(body.x), a(body.x.size());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += tau * w[i];
  accelerations(body.system(), terms_of(body.system()), x, w, a);
  double largest = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) largest = std::max(largest, (w[i] - body.v[i] - tau * a[i]).norm());
  return largest;
}

// The motion in a step of this body is below 10 m/s; the tolerance is relative to it.
TEST(ImplicitStage, SolvesItsEquationsWithEverySolver) {
  const SpringArrays body = moving_grid();
  for (const LinearSolver solver : solvers) {
    ImplicitOptions options;
    options.solver = solver;
    options.tolerance = 1e-11;
    options.max_iterations = 3000;
    const Solved solved = solve(body, options, 0.01);
    EXPECT_TRUE(solved.result.ok()) << to_string(solved.result);
    EXPECT_LT(defect(body, solved.w, 0.01), 1e-9);
    EXPECT_GT(defect(body, body.v, 0.01), 1e-2);
  }
}

TEST(ImplicitStage, BodyAtRestStaysAtRestToTheBit) {
  SpringArrays body = spring_grid(2, 2, 2);
  const Solved solved = solve(body, {}, 0.01);
  EXPECT_TRUE(solved.result.ok());
  for (const Vector3d& w : solved.w) EXPECT_EQ(w, Vector3d(0, 0, 0));
  EXPECT_EQ(solved.work.factorisations, 0u);
}

TEST(ImplicitStage, FixedVertexKeepsItsVelocityAndDrivesTheOthers) {
  SpringArrays body = moving_grid();
  body.v[0] = {1, 2, 3};
  const Solved solved = solve(body, {}, 0.01);
  EXPECT_TRUE(solved.result.ok());
  EXPECT_EQ(solved.w[0], Vector3d(1, 2, 3));
  EXPECT_EQ(solved.w[1], Vector3d(0, 0, 0));
}

TEST(ImplicitStage, FixedVertexKeepsItsVelocityWhateverTheFirstGuess) {
  const SpringArrays body = moving_grid();
  ImplicitStage stage(ImplicitOptions{});
  stage.begin_step();
  std::vector<Vector3d> w(body.v.size(), Vector3d(1, 2, 3));
  WorkCounters work;
  EXPECT_TRUE(stage.solve(body.system(), body.x, body.v, 0.01, StageForce::at_end, w, work).ok());
  EXPECT_EQ(w[0], Vector3d(0, 0, 0));
}

// Both with the same line search; projecting where it is not needed slows Newton's method down to linear
// convergence.
TEST(ImplicitStage, ProjectionOnDemandTakesFewerIterationsThanAlways) {
  for (const double size : {0.9, 0.5}) {
    const SpringArrays body = crushed_grid(size);
    ImplicitOptions options;
    options.solver = LinearSolver::fresh_factor;
    const Solved on_demand = solve(body, options, 0.02);
    options.tangent = TangentPolicy::projected;
    const Solved always = solve(body, options, 0.02);
    EXPECT_TRUE(on_demand.result.ok());
    EXPECT_TRUE(always.result.ok());
    EXPECT_LT(on_demand.work.newton_iterations, always.work.newton_iterations);
    EXPECT_EQ(always.work.projections, 0u);
  }
}

TEST(ImplicitStage, IndefiniteTangentIsProjectedByEverySolverAndCounted) {
  const SpringArrays body = crushed_grid(0.3);
  for (const LinearSolver solver :
       {LinearSolver::fresh_factor, LinearSolver::kept_factor, LinearSolver::conjugate_gradients}) {
    ImplicitOptions options;
    options.solver = solver;
    const Solved solved = solve(body, options, 0.1);
    EXPECT_TRUE(solved.result.ok()) << to_string(solved.result);
    EXPECT_GT(solved.work.projections, 0u);
    EXPECT_LT(defect(body, solved.w, 0.1), 1e-6);
  }
}

// Without dissipation in the merit the search halves its steps hundreds of times on such a body.
TEST(ImplicitStage, LineSearchKnowsOfTheDissipation) {
  for (const auto& [damping, viscosity] : {std::pair{100.0, 10.0}, {100.0, 0.0}, {0.0, 10.0}}) {
    SpringArrays body = crushed_grid(0.8);
    for (Spring& spring : body.springs) spring.damping = damping;
    for (std::size_t i = 0; i < body.x.size(); ++i) body.viscosity[i] = viscosity;
    const Solved solved = solve(body, {}, 0.1);
    EXPECT_TRUE(solved.result.ok()) << to_string(solved.result);
    EXPECT_LE(solved.work.line_search_trials, solved.work.newton_iterations) << damping << ", " << viscosity;
  }
}

// In steps this long the spring turns by more than a right angle. With directions of dampers held, iterations lower one
// potential after the other and go in a circle.
TEST(ImplicitStage, FindsWhereDampersTurnInALongStep) {
  for (const auto& [damping, stiffness, step, velocity] : {std::tuple{2.0, 1.4, 1.5, Vector3d(0, 2.6, 0)},
                                                           {70.0, 10.0, 1.0, Vector3d(2.1, 2.6, 0)},
                                                           {1.2, 1.1, 1.3, Vector3d(-1.5, 2.3, 0)}}) {
    SpringArrays body = two_masses(1.0, 1.0, stiffness, -1.0, damping);
    body.springs[0].rest_length = 1.0;
    body.fixed[0] = 1;
    body.v[1] = velocity;
    const Solved solved = solve(body, {}, step);
    EXPECT_TRUE(solved.result.ok()) << to_string(solved.result);
    EXPECT_LT(defect(body, solved.w, step), 1e-8);
    EXPECT_LT(solved.work.newton_iterations, 60u);
  }
}

TEST(ImplicitStage, StallIsReportedWithTheResidual) {
  ImplicitOptions options;
  options.max_iterations = 1;
  const Solved solved = solve(crushed_grid(0.5), options, 0.1);
  EXPECT_EQ(solved.result.code, StepCode::newton_stalled);
  EXPECT_EQ(solved.result.quantity, "residual");
  EXPECT_GT(solved.result.value, 1e-6);
}

TEST(ImplicitStage, NotANumberIsReportedByEverySolver) {
  SpringArrays body = moving_grid();
  body.v[5].y() = NAN;
  for (const LinearSolver solver : solvers) {
    ImplicitOptions options;
    options.solver = solver;
    const StepResult result = solve(body, options, 0.01).result;
    EXPECT_EQ(result.code, StepCode::nonfinite);
    EXPECT_EQ(result.witness, Witness::vertex);
    // the lowest of the vertex and its neighbours, whose residual is NaN, too
    EXPECT_LE(result.number, 5u);
  }
}

TEST(ImplicitStage, ToleranceBelowRoundingEndsAtRounding) {
  const SpringArrays body = moving_grid(0.0);
  ImplicitOptions options;
  options.tolerance = 0.0;
  const Solved solved = solve(body, options, 0.01);
  EXPECT_TRUE(solved.result.ok()) << to_string(solved.result);
  EXPECT_LT(solved.work.newton_iterations, 30u);
  // 20 springs of k = 300 N/m at coordinates of 0.2 m, rounded, on 0.02 kg: 1e-14 m/s in a step
  EXPECT_LT(defect(body, solved.w, 0.01), 2e-13);
}

TEST(ImplicitStage, ZeroLengthSpringIsPulledApartWhereItsEndsAreMoved) {
  SpringArrays body;
  body.add_vertex(1.0, {0, 0, 0});
  body.add_vertex(1.0, {0, 0, 0});
  body.add_spring(0, 1, 10.0, 1.0);
  body.v[1] = {1, 0, 0};
  const Solved solved = solve(body, {}, 0.1);
  EXPECT_TRUE(solved.result.ok()) << to_string(solved.result);
  EXPECT_LT(defect(body, solved.w, 0.1), 1e-8);
}

}  // namespace
}  // namespace dartboard::implicit_stage_test
