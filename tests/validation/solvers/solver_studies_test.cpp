// The studies behind `validate solvers`, on small bodies.

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "core/meshes/generators/mesh_generators.h"
#include "core/time/integrators.h"
#include "reference/error_norms.h"
#include "tests/support/ticking_clock_for_tests.h"
#include "validation/solvers/break_even.h"
#include "validation/solvers/crossover.h"
#include "validation/solvers/factor_edits.h"
#include "validation/solvers/solver_accuracy.h"
#include "validation/solvers/solver_bodies.h"

namespace dartboard::solver_studies_test {
namespace {

TEST(DissociationPairs, HaveOneVertexMoreAndTheSameMassAndStiffness) {
  const DissociationPairs pairs = dissociation_pairs(5, 0.1, 3);
  ASSERT_EQ(pairs.torn.size(), 3u);
  const auto mass = [](const SpringColumns& c) { return std::accumulate(c.mass.begin(), c.mass.end(), 0.0); };
  const auto stiffness = [](const SpringColumns& c) {
    double sum = 0.0;
    for (const Spring& s : c.springs) sum += s.stiffness;
    return sum;
  };
  for (const SpringColumns& torn : pairs.torn) {
    EXPECT_EQ(torn.mass.size(), pairs.whole.mass.size() + 1);
    EXPECT_GT(torn.springs.size(), pairs.whole.springs.size());
    // sums of some 1,000 positive terms, the same but for two or so of them: within n epsilon
    EXPECT_NEAR(mass(torn), mass(pairs.whole), 1e-12 * mass(torn));
    EXPECT_NEAR(stiffness(torn), stiffness(pairs.whole), 1e-12 * stiffness(torn));
  }
}

TEST(SolveAccuracy, OneRefinementReachesRoundingOverAllScales) {
  for (const SolveCell& cell : solve_accuracy({.side = 4, .h_omega_step = 1e11, .pcg_tolerance = 1e-10})) {
    if (cell.path == SolvePath::conjugate_gradients) continue;
    ASSERT_EQ(cell.status, SolveStatus::ok) << name(cell.path) << " " << cell.state << " " << cell.h_omega;
    EXPECT_LE(cell.after, 1e-15) << name(cell.path) << " " << cell.state << " " << cell.h_omega;
  }
}

TEST(IndefiniteSystems, EndWithADiagnosisOnEveryPath) {
  const auto cells = indefinite_systems();
  EXPECT_GT(cells.size(), 50u);
  for (const IndefiniteCell& cell : cells)
    EXPECT_EQ(cell.status, SolveStatus::not_positive_definite) << cell.path << " at h omega " << cell.h_omega;
}

TEST(FactorEdits, StayAccurateUnderEveryPolicy) {
  for (const EditPolicy& policy : edit_policies()) {
    const EditRun run = run_edits(policy, 5, 0.2, 60, ticking());
    EXPECT_EQ(run.failure, "") << policy.name;
    EXPECT_EQ(run.edits, 60u);
    // growth is slow: after 60 edits all are below what 3,000 may reach
    EXPECT_LE(run.largest, 2e-15) << policy.name;
    EXPECT_GT(run.counters.rank_one_updates + run.counters.rows_replaced, 0u) << policy.name;
  }
}

TEST(BreakEven, IsWhereBothSidesOfTheLawAreEqual) {
  ImplicitWork work;
  work.forces = 10.0;
  work.linearisations = 4.0;
  work.solves = 20.0;
  work.factorisations = 2.0;
  const StepPrices prices{.force = 1e-5, .linearisation = 5e-5, .factorisation = 4e-3, .solve = 2e-4};
  const double implicit_s = implicit_seconds(30.0, work, prices);
  EXPECT_DOUBLE_EQ(implicit_s, 30.0 * (1e-4 + 2e-4 + 4e-3) + 8e-3);
  // Verlet: T omega_max there, in steps of 0.9 * 2 / omega_max
  const double step_s = 1.2e-5, omega = 50.0;
  const double duration = break_even_phase(2.0, step_s, implicit_s) / omega;
  EXPECT_NEAR(steps_for_stability(duration, 2.0 / omega) * step_s, implicit_s, 1e-14 * implicit_s);
}

TEST(BreakEven, CountsTheWorkOfAStep) {
  WorkCounters counters;
  counters.steps = 10;
  counters.force_evaluations = 50;
  counters.newton_iterations = 40;
  counters.line_search_trials = 10;
  counters.solves = 120;
  counters.factorisations = 3;
  const ImplicitWork work = implicit_work(counters);
  EXPECT_DOUBLE_EQ(work.forces, 10.0);  // the line search evaluates every spring once an iteration, and once a trial
  EXPECT_DOUBLE_EQ(work.linearisations, 4.0);
  EXPECT_DOUBLE_EQ(work.solves, 12.0);
  EXPECT_DOUBLE_EQ(work.factorisations, 3.0);
}

// The clock ticks once per reading, so the explicit side costs the same however many steps it takes: there is no
// crossover, and the study has to say so.
TEST(Crossover, SaysWhenThereIsNone) {
  CrossoverOptions options;
  options.most_evaluations = 2;
  options.pilot_steps = 8;
  options.error = 1e-2;
  const Crossover found = find_crossover(3, options, ticking());
  EXPECT_FALSE(found.failure.empty());
}

/// A clock on which every reading takes two milliseconds, so that a run reads it after each step: all steps of all
/// methods cost the same.
CpuClock a_look_a_step() {
  return [t = std::int64_t{0}]() mutable { return t += 2'000'000; };
}

constexpr CrossoverOptions crossover_options{.error = 1e-3, .pilot_steps = 8};

const Crossover& crossover_of_equal_steps() {
  static const Crossover found = find_crossover(3, crossover_options, a_look_a_step());
  return found;
}

// Verlet takes phase / 1.8 steps, nine tenths of the longest stable ones, and up to an eighth more to end at four
// checkpoints; the readings before and after all steps are some per cent of the total.
TEST(Crossover, IsWhereBothTakeAsManyStepsWhereAllStepsCostTheSame) {
  const Crossover& found = crossover_of_equal_steps();
  ASSERT_EQ(found.failure, "");
  EXPECT_NEAR(found.measured_phase / 1.8 / found.costs.back().implicit_steps, 1.0, 0.2);
  // the stiffness goes with the square of the frequency
  EXPECT_NEAR(found.measured_factor / found.predicted_factor, std::pow(found.measured_phase / found.predicted_phase, 2),
              1e-12);
}

// Between the last runs on either side the ratio is a power of the phase.
TEST(Crossover, IsWhereTheRatioBetweenTwoRunsIsOne) {
  const Crossover& found = crossover_of_equal_steps();
  const CostPair *low = nullptr, *high = nullptr;
  for (const CostPair& costs : found.costs) (costs.ratio() < 1.0 ? low : high) = &costs;
  ASSERT_TRUE(low != nullptr && high != nullptr);
  ASSERT_GT(std::abs(std::log(found.costs.back().ratio())), 0.03);  // else it would be at the last run itself
  const double power = std::log(high->ratio() / low->ratio()) / std::log(high->phase / low->phase);
  EXPECT_NEAR(low->ratio() * std::pow(found.measured_phase / low->phase, power), 1.0, 1e-12);
}

TEST(Crossover, PredictsByTheLawFromWhatItSaysOfThePilots) {
  const Crossover& found = crossover_of_equal_steps();
  ASSERT_GT(found.predicted_s, 0.0);
  EXPECT_DOUBLE_EQ(found.predicted_s,
                   found.overhead * implicit_seconds(found.predicted_steps, found.work, found.prices));
  EXPECT_DOUBLE_EQ(found.predicted_phase, break_even_phase(2.0, found.explicit_step_s, found.predicted_s));
}

// The steps lie between two runs on either side of the error, or near it, and their error is a power of them. The
// study's own reference is Verlet's with half the step: off by a third of its error for the explicit run.
TEST(Crossover, ComparesWithTheStepsThatMeetTheError) {
  for (const CostPair& costs : crossover_of_equal_steps().costs) {
    const TradeoffScene scene =
        stiff_scene("", kuhn_box(2, 2, 2, 0.1, 0.25, 1), costs.factor, {.phase = 13.2, .checkpoints = 4});
    const auto states = [&](std::string_view method, double steps) {
      return run_timed(scene, *make_integrator(method), {.steps = static_cast<std::uint64_t>(steps)}, ticking()).states;
    };
    const auto exact = states("verlet", std::ceil(4.0 * costs.phase));
    const double few = 4.0 * std::floor(costs.implicit_steps / 4.0);
    const auto error = [&](double steps) {
      return reference::motion_errors(scene.motion, states(costs.implicit_method, steps), exact).x;
    };
    const double off = costs.explicit_error / 3.0;
    EXPECT_GT(error(few), 0.9 * crossover_options.error - off) << costs.factor;
    EXPECT_LT(error(few + 4.0), 1.1 * crossover_options.error + off) << costs.factor;
  }
}

}  // namespace
}  // namespace dartboard::solver_studies_test
