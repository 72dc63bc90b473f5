// The linear solver that the user requests is the one used.

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/plain/error.h"
#include "core/time/integrators.h"
#include "tests/support/spring_bodies_for_tests.h"

namespace dartboard::linear_solver_choice_test {
namespace {

SpringArrays moving_cube() {
  SpringArrays body = spring_grid(1, 1, 1, 5.0, 0.01);
  disturb(body, 0.004, 0.2);
  return body;
}

struct Taken {
  WorkCounters work;
  SpringArrays body;
};

Taken take_steps(std::string_view integrator, std::string_view solver) {
  constexpr double h = 0.02;
  const auto made = make_integrator(integrator, solver);
  Taken taken{{}, moving_cube()};
  for (int k = 0; k < 3; ++k) {
    const StepResult result = made->step(taken.body.system(), taken.body.motion(), h);
    EXPECT_TRUE(result.ok()) << integrator << " " << solver << ": " << to_string(result);
  }
  taken.work = made->work();
  return taken;
}

std::string refusal(std::string_view integrator, std::string_view solver) {
  try {
    make_integrator(integrator, solver);
    return "accepted";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST(LinearSolverChoice, IsThereForAllIntegratorsThatSolveButLocalGlobalWhoseMatrixIsTheMethod) {
  for (const IntegratorEntry& entry : integrators()) {
    const bool choice = entry.make()->scheme().implicit && entry.name != "local-global";
    EXPECT_EQ(refusal(entry.name, "fresh-factor") == "accepted", choice) << entry.name;
  }
}

TEST(LinearSolverChoice, OfFreshFactorsFactorsForEverySystem) {
  for (const IntegratorEntry& entry : integrators()) {
    if (entry.make_with == nullptr) continue;
    const WorkCounters fresh = take_steps(entry.name, "fresh-factor").work;
    const WorkCounters kept = take_steps(entry.name, "kept-factor").work;
    EXPECT_GE(fresh.factorisations, 3u) << entry.name;  // a step each
    EXPECT_GT(fresh.factorisations, kept.factorisations) << entry.name;
    EXPECT_GE(kept.factorisations, 1u) << entry.name;
  }
}

TEST(LinearSolverChoice, OfConjugateGradientsFactorsNothing) {
  for (const IntegratorEntry& entry : integrators()) {
    if (entry.make_with == nullptr) continue;
    const WorkCounters work = take_steps(entry.name, "conjugate-gradients").work;
    EXPECT_EQ(work.factorisations, 0u) << entry.name;
    EXPECT_GT(work.linear_iterations, 0u) << entry.name;
  }
}

// Conjugate gradients end at a residual of 1e-6. The matrix is M + h^2 K, h omega < 4 here, so that its condition is
// below 20 and an increment is wrong by 2e-5 of itself at most.
TEST(LinearSolverChoice, ChangesTheMotionByNoMoreThanItsTolerance) {
  for (const IntegratorEntry& entry : integrators()) {
    if (entry.make_with == nullptr) continue;
    const SpringArrays start = moving_cube(), own = take_steps(entry.name, "").body;
    double moved = 0.0;
    for (std::size_t i = 0; i < own.x.size(); ++i) moved = std::max(moved, (own.x[i] - start.x[i]).norm());
    for (const SolverEntry& solver : linear_solvers()) {
      const SpringArrays other = take_steps(entry.name, solver.name).body;
      for (std::size_t i = 0; i < own.x.size(); ++i)
        EXPECT_LE((own.x[i] - other.x[i]).norm(), 3 * 2e-5 * moved) << entry.name << " " << solver.name;
    }
  }
}

TEST(LinearSolverChoice, OfAnExplicitMethodOrOfNoSuchSolverIsRefusedWithThoseThatThereAre) {
  EXPECT_EQ(refusal("rk4", "fresh-factor"),
            "rk4 has no linear solver to choose; backward-euler, baraff-witkin, ros2, sdirk2, implicit-midpoint, "
            "energy-momentum, bdf2 have");
  EXPECT_EQ(refusal("ros2", "fresh"),
            "there is no linear solver 'fresh'; there are kept-factor, fresh-factor, conjugate-gradients");
}

}  // namespace
}  // namespace dartboard::linear_solver_choice_test
