// The end of Newton's iteration of an implicit stage, its counts, and its report when it stops.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/time/implicit/baraff_witkin.h"
#include "core/time/implicit/bdf2.h"
#include "core/time/implicit/one_stage.h"
#include "core/time/implicit/ros2.h"
#include "core/time/implicit/sdirk2.h"
#include "core/time/system/accelerations.h"
#include "core/time/system/energy.h"
#include "tests/support/spring_bodies_for_tests.h"

namespace dartboard::newton_test {
namespace {

using Eigen::Vector3d;
constexpr double epsilon = std::numeric_limits<double>::epsilon();

// Stiff, damped, held in one vertex.
SpringArrays stiff_grid() {
  SpringArrays body = spring_grid(2, 2, 2, 2000.0, 0.05);
  body.gravity = {0, 0, -9.81};
  body.fixed[0] = 1;
  for (std::size_t i = 0; i < body.x.size(); ++i) body.viscosity[i] = 0.5 * body.mass[i];
  disturb(body, 0.005, 0.5);
  return body;
}

struct Solved {
  StepResult result;
  WorkCounters work;
  std::vector<Vector3d> w;
};

Solved solve(const SpringArrays& body, const ImplicitOptions& options, double tau,
             StageForce force = StageForce::at_end) {
  Solved solved;
  ImplicitStage stage(options);
  stage.begin_step();
  solved.w = body.v;
  solved.result = stage.solve(body.system(), body.x, body.v, tau, force, solved.w, solved.work);
  return solved;
}

// w - vh - tau a(xh + tau w, w) at every vertex, from the forces of the explicit methods.
std::vector<Vector3d> defects(const SpringArrays& body, std::span<const Vector3d> w, double tau) {
  std::vector<Vector3d> x(body.x), a(body.x.size());
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += tau * w[i];
  accelerations(body.system(), terms_of(body.system()), x, w, a);
  for (std::size_t i = 0; i < x.size(); ++i) a[i] = w[i] - body.v[i] - tau * a[i];
  return a;
}

// The constant matrix of the graph converges linearly, some 10 % at a time in a step this long, so that the first
// residual that is small enough is not much smaller.
ImplicitOptions creeping(double tolerance) {
  ImplicitOptions options;
  options.solver = LinearSolver::laplacian;
  options.tolerance = tolerance;
  options.max_iterations = 100000;
  return options;
}

// The scale of the tolerance is taken where the iteration starts: at the old velocities or at rest, the larger of both.
TEST(Newton, GoesOnToItsToleranceOfWhatActs) {
  const SpringArrays body = stiff_grid();
  const double tau = 0.05;
  double acts = 0.0;
  for (const auto& start : {body.v, std::vector<Vector3d>(body.v.size(), Vector3d(0, 0, 0))}) {
    const auto defect = defects(body, start, tau);
    for (std::size_t i = 0; i < defect.size(); ++i) {
      if (body.fixed[i]) continue;
      const Vector3d kick = start[i] - body.v[i] - defect[i];
      acts = std::max({acts, kick.cwiseAbs().maxCoeff(), body.v[i].cwiseAbs().maxCoeff()});
    }
  }
  for (const double tolerance : {1e-3, 1e-5, 1e-7}) {
    const Solved solved = solve(body, creeping(tolerance), tau);
    ASSERT_TRUE(solved.result.ok()) << to_string(solved.result);
    double left = 0.0;
    for (const Vector3d& d : defects(body, solved.w, tau)) left = std::max(left, d.cwiseAbs().maxCoeff());
    EXPECT_LE(left, tolerance * acts);
    EXPECT_GT(left, 0.1 * tolerance * acts);  // it creeps: the tolerance is used up
  }
}

// A tolerance below rounding: the residual ends within 8 units of the last place of its terms, masses times
// speeds and forces, in which stiffness multiplies lengths, rest lengths and the contribution of tau w. Its
// evaluation here rounds differently, by 8 of them again: each force by 4, and the sums of up to 15 springs by
// about as much.
TEST(Newton, GoesOnToTheRoundingOfItsResidual) {
  const SpringArrays body = stiff_grid();
  const double tau = 0.05;
  const Solved solved = solve(body, creeping(1e-300), tau);
  ASSERT_TRUE(solved.result.ok()) << to_string(solved.result);
  double speed = 0.0;
  for (const Vector3d& w : solved.w) speed = std::max(speed, w.cwiseAbs().maxCoeff());
  std::vector<double> forces(body.x.size(), 0.0);
  for (std::size_t s = 0; s < body.springs.size(); ++s) {
    const Spring& spring = body.springs[s];
    const auto [i, j] = body.ends[s];
    const double length = (body.x[j] - body.x[i]).cwiseAbs().maxCoeff();
    const double force = spring.stiffness * (length + spring.rest_length + tau * speed) + spring.damping * speed;
    forces[i] += force;
    forces[j] += force;
  }
  const auto defect = defects(body, solved.w, tau);
  for (std::size_t i = 0; i < defect.size(); ++i) {
    if (body.fixed[i]) continue;
    const double speeds = solved.w[i].cwiseAbs().maxCoeff() + body.v[i].cwiseAbs().maxCoeff();
    EXPECT_LE(body.mass[i] * defect[i].cwiseAbs().maxCoeff(), 16 * epsilon * (body.mass[i] * speeds + tau * forces[i]))
        << i;
  }
}

// |w - vh|_M^2 / 2 + U(xh + tau w), without dissipation.
double potential(const SpringArrays& body, std::span<const Vector3d> w, double tau) {
  std::vector<Vector3d> x(body.x), change(w.begin(), w.end());
  for (std::size_t i = 0; i < x.size(); ++i) {
    x[i] += tau * w[i];
    change[i] -= body.v[i];
  }
  return kinetic_energy(body.system(), change) + elastic_energy(body.system(), x);
}

// Bodies crushed to a point, steps of many periods: there a full step may well raise it.
TEST(Newton, LowersThePotentialWithEachIteration) {
  for (const double size : {0.02, 0.1, 0.3, 0.6})
    for (const double tau : {0.02, 0.1, 0.5, 2.0})
      for (const unsigned seed : {1u, 2u, 3u}) {
        SpringArrays body = crushed_grid(size);
        disturb(body, 0.05, 5.0, seed);
        const std::vector<Vector3d> at_rest(body.v.size(), Vector3d(0, 0, 0));
        double before = std::min(potential(body, body.v, tau), potential(body, at_rest, tau));
        for (const int iterations : {1, 2, 3, 4}) {
          ImplicitOptions options;
          options.solver = LinearSolver::fresh_factor;
          options.max_iterations = iterations;
          options.iterate_once = true;
          const Solved solved = solve(body, options, tau);
          ASSERT_TRUE(solved.result.ok()) << to_string(solved.result);
          const double now = potential(body, solved.w, tau);
          EXPECT_LE(now, before * (1 + 1e-12)) << size << ", " << tau << ", iteration " << iterations;
          before = now;
        }
      }
}

// ---- reports

// |r| in the norm of M^-1 is the root of the sum of m |defect|^2.
TEST(Newton, TellsTheResidualThatItStallsAtInTheNormOfTheInverseMasses) {
  SpringArrays body = crushed_grid(0.5);
  for (std::size_t i = 0; i < body.x.size(); ++i) body.set_mass(i, i % 2 == 0 ? 0.02 : 5.0);
  ImplicitOptions options;
  options.max_iterations = 1;
  const Solved solved = solve(body, options, 0.1);
  ASSERT_EQ(solved.result.code, StepCode::newton_stalled);
  double sum = 0.0;
  const auto defect = defects(body, solved.w, 0.1);
  for (std::size_t i = 0; i < defect.size(); ++i) sum += body.mass[i] * defect[i].squaredNorm();
  EXPECT_NEAR(solved.result.value, std::sqrt(sum), 1e-9 * std::sqrt(sum));
}

// Vertex 13 is in the middle: its neighbours' residuals are NaN, too, and the first of all is reported.
TEST(Newton, TellsTheFirstVertexWithoutAResidual) {
  SpringArrays body = stiff_grid();
  body.v[13].y() = NAN;
  std::uint32_t first = 13;
  for (const auto& [i, j] : body.ends)
    if (i == 13 || j == 13)
      for (const std::uint32_t k : {i, j})
        if (!body.fixed[k]) first = std::min(first, k);
  const StepResult result = solve(body, {}, 0.01).result;
  EXPECT_EQ(result.code, StepCode::nonfinite);
  EXPECT_EQ(result.number, first);
  EXPECT_EQ(result.quantity, "residual");
  EXPECT_TRUE(std::isnan(result.value));
}

// ---- counts

// A force evaluation at the start, one at rest, to see whether that is a better start, and one for each trial.
TEST(Newton, CountsTheTrialsOfItsLineSearch) {
  std::uint64_t trials = 0;
  for (const double size : {0.9, 0.5, 0.2, 0.05})
    for (const double tau : {0.05, 0.2, 1.0}) {
      ImplicitOptions options;
      options.tolerance = 1e-6;
      options.tangent = TangentPolicy::projected;  // one search for each iteration
      const WorkCounters work = solve(crushed_grid(size), options, tau, StageForce::discrete_gradient).work;
      EXPECT_EQ(work.force_evaluations, 2 + work.newton_iterations + work.line_search_trials);
      trials += work.line_search_trials;
    }
  EXPECT_GT(trials, 0u);
}

// ---- projections, in every method

template <class Method>
struct Projecting : testing::Test {};
using Methods = testing::Types<BackwardEuler, BaraffWitkin, ImplicitMidpoint, EnergyMomentum, Ros2, Sdirk2, Bdf2>;
TYPED_TEST_SUITE(Projecting, Methods);

ImplicitOptions asking(LinearSolver solver, TangentPolicy tangent) {
  ImplicitOptions options;
  options.solver = solver;
  options.tangent = tangent;
  options.tolerance = 1e-5;
  return options;
}

// A body so crushed that its exact tangents are indefinite in such a step.
TYPED_TEST(Projecting, IsDoneOnDemandWhateverSolves) {
  for (const LinearSolver solver :
       {LinearSolver::fresh_factor, LinearSolver::kept_factor, LinearSolver::conjugate_gradients}) {
    SpringArrays body = crushed_grid(0.3);
    TypeParam integrator(asking(solver, TangentPolicy::on_demand));
    const StepResult result = integrator.step(body.system(), body.motion(), 0.2);
    EXPECT_TRUE(result.ok()) << to_string(result);
    EXPECT_GT(integrator.work().projections, 0u);
  }
}

TYPED_TEST(Projecting, IsDoneFromTheBeginningWhereThatIsAskedFor) {
  for (const LinearSolver solver :
       {LinearSolver::fresh_factor, LinearSolver::kept_factor, LinearSolver::conjugate_gradients}) {
    SpringArrays body = crushed_grid(0.3);
    TypeParam integrator(asking(solver, TangentPolicy::projected));
    for (int k = 0; k < 2; ++k) {
      const StepResult result = integrator.step(body.system(), body.motion(), 0.2);
      EXPECT_TRUE(result.ok()) << to_string(result);
    }
    EXPECT_EQ(integrator.work().projections, 0u);
  }
}

}  // namespace
}  // namespace dartboard::newton_test
