// The judges of linear systems and of implicit methods: bad solutions, and methods that do not keep their promises.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "benchmarks/checkout/source_folder.h"
#include "core/time/integrators.h"
#include "tests/support/ticking_clock_for_tests.h"
#include "validation/order/implicit_gains.h"
#include "validation/solvers/crossover.h"
#include "validation/solvers/factor_edits.h"
#include "validation/solvers/solver_accuracy.h"
#include "validation/solvers/solver_bodies.h"

namespace dartboard::solver_judges_test {
namespace {

TEST(IndefiniteCellJudge, CallsAMatrixThatPassedAsSolvedUndiagnosed) {
  IndefiniteCell cell{.path = "simplicial", .h_omega = 1e3, .least = -1e-3, .status = SolveStatus::ok};
  EXPECT_FALSE(cell.diagnosed());
  for (const SolveStatus status : {SolveStatus::not_positive_definite, SolveStatus::not_converged}) {
    cell.status = status;
    EXPECT_TRUE(cell.diagnosed());
  }
}

TEST(IndefiniteCellJudge, LooksAtMatricesThatAreIndefinite) {
  for (const IndefiniteCell& cell : indefinite_systems()) {
    EXPECT_LT(cell.least, -1e-8) << cell.path;
    EXPECT_GE(cell.least, -1.0) << cell.path;
  }
}

// Conjugate gradients stop at the requested residual: a hundredth leaves errors far above rounding, and less after
// another round.
TEST(SolveAccuracyJudge, TellsABadSolutionFromAGoodOne) {
  std::size_t bad = 0;
  double refined = 0.0;
  for (const SolveCell& cell : solve_accuracy({.side = 4, .h_omega_step = 1e11, .pcg_tolerance = 1e-2})) {
    if (cell.status != SolveStatus::ok) continue;
    if (cell.path == SolvePath::conjugate_gradients) {
      bad += cell.before > 1e-6;
      EXPECT_GT(cell.iterations, 0);
    } else {
      EXPECT_GT(cell.before, 0.0) << name(cell.path);
      EXPECT_GT(cell.normwise, 0.0) << name(cell.path);
      EXPECT_LE(cell.normwise, 1e-13) << name(cell.path);
      refined += cell.after;
    }
  }
  EXPECT_GE(bad, 4u);
  EXPECT_GT(refined, 0.0);  // to rounding, and no better
}

TEST(FactorEditsJudge, MeasuresTheErrorsOfItsSolutions) {
  const EditRun run = run_edits(edit_policies().at(0), 4, 0.2, 24, ticking());
  EXPECT_EQ(run.failure, "");
  EXPECT_GT(run.last, 0.0);
  EXPECT_GE(run.largest, run.last);
  EXPECT_GE(run.componentwise, run.largest);  // the componentwise error is never below the normwise one
}

// The first edit removes a spring and the second restores it: up to three rank-one terms each, as many both times.
TEST(FactorEditsJudge, TakesSpringsAwayAndPutsThemBack) {
  const EditRun run = run_edits(edit_policies().at(0), 4, 0.2, 1, ticking());
  EXPECT_EQ(run.failure, "");
  EXPECT_EQ(run.edits, 2u);
  EXPECT_GE(run.counters.rank_one_updates, 2u);
  EXPECT_LE(run.counters.rank_one_updates, 6u);
  EXPECT_EQ(run.counters.rank_one_updates % 2, 0u);
}

TEST(EnergyDriftJudge, SeesAMethodThatDoesNotKeepTheEnergy) {
  const ConservedDrift kept = measure_energy_drift(10, 20.0);
  EXPECT_LE(kept.drift, 1e-12);
  for (const char* name : {"backward-euler", "implicit-midpoint"}) {
    const auto integrator = make_integrator(name);
    const ConservedDrift lost = measure_energy_drift(10, 20.0, *integrator);
    EXPECT_TRUE(lost.drift > 1e-6 || !lost.diagnosis.empty()) << name << ": " << lost.drift;
  }
}

TEST(KeptFactorJudge, ComparesTwoRunsThatAreNotTheSame) {
  const KeptFactor found = compare_kept_factor(4, source_folder().string() + "/benchmarks/meshes");
  EXPECT_EQ(found.diagnosis, "");
  EXPECT_GT(found.fresh, found.kept);
  EXPECT_GT(found.difference, 0.0);
  EXPECT_GT(found.step_error, 0.0);
}

TEST(BreakEvenLaw, TakesNineTenthsOfTheStableStep) { EXPECT_DOUBLE_EQ(steps_for_stability(9.0, 0.5), 20.0); }

TEST(CrossoverJudge, IsOffByTheShareThatPredictionExceedsMeasurement) {
  Crossover found;
  found.predicted_phase = 130.0;
  found.measured_phase = 100.0;
  EXPECT_NEAR(found.deviation(), 0.3, 1e-12);
  found.measured_phase = 260.0;
  EXPECT_NEAR(found.deviation(), -0.5, 1e-12);
  CostPair costs;
  costs.explicit_s = 3.0;
  costs.implicit_s = 2.0;
  EXPECT_DOUBLE_EQ(costs.ratio(), 1.5);
}

TEST(EditPolicies, DoWhatTheirNamesSay) {
  const std::uint32_t never = std::numeric_limits<std::uint32_t>::max();
  for (const EditPolicy& policy : edit_policies()) {
    const auto says = [&](const char* word) { return policy.name.find(word) != std::string::npos; };
    EXPECT_EQ(policy.refine, says("refinement")) << policy.name;
    EXPECT_EQ(policy.options.renew_after == never, says("never renewed")) << policy.name;
    if (says("after ")) {
      EXPECT_EQ(policy.options.renew_after, std::stoul(policy.name.substr(policy.name.find("after ") + 6)));
    }
    if (says("default")) {
      EXPECT_EQ(policy.options.renew_after, CholeskyOptions{}.renew_after);
    }
  }
}

// Evenly drawn on a logarithmic scale, all but one in 10^9 of several hundred springs come within a decade of either
// end of fourteen: (13/14)^300 is 2e-10.
TEST(SpreadScales, CoversTheDecadesThatItNames) {
  const SpringColumns whole = dissociation_pairs(6, 0.0, 1).whole;
  ASSERT_GT(whole.springs.size(), 300u);
  SpringColumns spread = whole;
  spread_scales(spread, false, true);
  double least = 1e300, most = 0.0;
  for (std::size_t s = 0; s < whole.springs.size(); ++s) {
    const double factor = spread.springs[s].stiffness / whole.springs[s].stiffness;
    least = std::min(least, factor);
    most = std::max(most, factor);
  }
  EXPECT_GE(least, 1.0);
  EXPECT_LT(least, 10.0);
  EXPECT_GT(most, 1e13);
  EXPECT_LE(most, 1.0001e14);
  EXPECT_EQ(spread.mass, whole.mass);
}

}  // namespace
}  // namespace dartboard::solver_judges_test
