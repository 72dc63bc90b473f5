// The judge of extremes says no, at values and in runs that are made wrong.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/time/integrators.h"
#include "validation/extremes/extreme_judgement.h"
#include "validation/extremes/extreme_run.h"

namespace dartboard::extreme_judge_test {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

bool is_silent(const ExtremeObservation& run, const char* because) {
  const ExtremeVerdict verdict = verdict_of(run);
  if (verdict.outcome == ExtremeOutcome::silent) {
    EXPECT_NE(verdict.note.find(because), std::string::npos) << verdict.note;
  }
  return verdict.outcome == ExtremeOutcome::silent;
}

// ---- values

TEST(ExtremeVerdict, IsOkOrDegradedByWhetherThereWasAWarning) {
  EXPECT_EQ(verdict_of(ExtremeObservation{.energy_before = 1, .energy_after = 1}).outcome, ExtremeOutcome::ok);
  EXPECT_EQ(verdict_of(ExtremeObservation{.warned = true, .energy_before = 1, .energy_after = 1}).outcome,
            ExtremeOutcome::degraded);
}

TEST(ExtremeVerdict, IsSilentWhereTheStateIsNotFinite) { EXPECT_TRUE(is_silent({.finite = false}, "not finite")); }

TEST(ExtremeVerdict, IsSilentWhereEnergyGrowsTwoHundredfold) {
  ExtremeObservation run{.energy_before = 1, .energy_after = 199};
  EXPECT_FALSE(is_silent(run, ""));
  run.energy_after = 201;
  EXPECT_TRUE(is_silent(run, "grown"));
  run.energy_after = no_number;
  EXPECT_TRUE(is_silent(run, "grown"));
  // energy of the size of the rounding of positions may appear at rest
  run = {.energy_before = 0, .energy_after = 199, .energy_rounding = 1};
  EXPECT_FALSE(is_silent(run, ""));
  run.energy_after = 201;
  EXPECT_TRUE(is_silent(run, "grown"));
}

TEST(ExtremeVerdict, LetsEnergyGrowAMillionfoldAfterAWarningOfInstability) {
  ExtremeObservation run{.warned = true, .warned_of_instability = true, .energy_before = 1, .energy_after = 9e5};
  EXPECT_EQ(verdict_of(run).outcome, ExtremeOutcome::degraded);
  run.energy_after = 1.1e6;
  EXPECT_TRUE(is_silent(run, "grown"));
  run = {.warned = true, .energy_before = 1, .energy_after = 201};  // with another kind of warning
  EXPECT_TRUE(is_silent(run, "grown"));
}

TEST(ExtremeVerdict, IsSilentWhereEnergyFallsTwoHundredfoldAndNothingTakesIt) {
  ExtremeObservation run{.energy_before = 201, .energy_after = 1, .must_live = true};
  EXPECT_TRUE(is_silent(run, "fallen"));
  run.energy_before = 199;
  EXPECT_FALSE(is_silent(run, ""));
  run = {.energy_before = 201, .energy_after = 1};
  EXPECT_FALSE(is_silent(run, ""));
}

TEST(ExtremeVerdict, IsSilentBeyondTheBoundFromTheTrueMotion) {
  ExtremeObservation run{.energy_before = 1, .energy_after = 1, .distance_from_truth = 0.5, .bound_from_truth = 1.0};
  EXPECT_FALSE(is_silent(run, ""));
  run.distance_from_truth = 1.5;
  EXPECT_TRUE(is_silent(run, "true motion"));
  run.distance_from_truth = no_number;
  EXPECT_TRUE(is_silent(run, "true motion"));
}

TEST(EventsVerdict, IsSilentWhereEnergyGrowsByMoreThanAFifth) {
  const auto outcome = [](EventsObservation run) { return verdict_of(run).outcome; };
  EXPECT_EQ(outcome({.energy_before = 1.0, .energy_after = 1.19}), ExtremeOutcome::ok);
  EXPECT_EQ(outcome({.energy_before = 1.0, .energy_after = 1.21}), ExtremeOutcome::silent);
  EXPECT_EQ(outcome({.energy_before = 1.0, .energy_after = no_number}), ExtremeOutcome::silent);
  EXPECT_EQ(outcome({.finite = false, .energy_before = 1.0, .energy_after = 1.0}), ExtremeOutcome::silent);
  // theta^2 = 0.09 in each of 60 steps: a factor of 221
  EXPECT_EQ(outcome({.energy_before = 1.0, .energy_after = 220, .explicit_euler = true}), ExtremeOutcome::ok);
  EXPECT_EQ(outcome({.energy_before = 1.0, .energy_after = 223, .explicit_euler = true}), ExtremeOutcome::silent);
}

TEST(EventsVerdict, IsSilentWhereEnergyFallsAndNothingIsRemoved) {
  const auto outcome = [](bool must_live, double after) {
    return verdict_of(EventsObservation{.energy_before = 200.0, .energy_after = after, .must_live = must_live}).outcome;
  };
  EXPECT_EQ(outcome(true, 1.01), ExtremeOutcome::ok);
  EXPECT_EQ(outcome(true, 0.99), ExtremeOutcome::silent);
  EXPECT_EQ(outcome(false, 0.0), ExtremeOutcome::ok);
}

TEST(TruthBound, FallsWithTheOrderOfTheMethod) {
  for (const int order : {1, 2, 4}) {
    // over the same time; amplitude alone, far above rounding
    TruthScale coarse{.theta = 0.25, .order = order, .steps = 40, .amplitude = 1.0};
    TruthScale fine{.theta = 0.125, .order = order, .steps = 80, .amplitude = 1.0};
    EXPECT_NEAR(truth_bound(coarse) / truth_bound(fine), std::exp2(order), 1e-3) << order;
    // constants of 8: theta^p at once, theta^(p+1) in each of 40 steps
    EXPECT_NEAR(truth_bound(coarse), 8 * std::pow(0.25, order) * (1 + 40 * 0.25), 1e-6) << order;
  }
}

// Damping with a ratio zeta turns a rate omega into omega (1 + 2 zeta) at most.
TEST(TruthBound, TakesTheStepForLongerByWhatIsDamped) {
  for (const int order : {1, 2, 4}) {
    const TruthScale undamped{.theta = 0.25, .order = order, .steps = 40, .amplitude = 1.0};
    TruthScale damped = undamped;
    for (const double zeta : {0.125, 0.5, 1.5}) {
      damped.zeta = zeta;
      EXPECT_NEAR(truth_bound(damped) / truth_bound(undamped), std::pow(1 + 2 * zeta, order), 1e-4) << order;
    }
  }
}

TEST(TruthBound, IsRoundingOfCoordinatesWhereNothingMoves) {
  const TruthScale still{.theta = 0.25, .order = 2, .steps = 40, .size = 3.0};
  EXPECT_DOUBLE_EQ(truth_bound(still), 64 * epsilon * 3.0 * (1 + 40 * 0.25));
}

TEST(TruthBound, IsWiderForExplicitEulerAlone) {
  const TruthScale plain{.theta = 0.25, .order = 1, .steps = 32, .amplitude = 1.0};
  TruthScale euler = plain;
  euler.explicit_euler = true;
  EXPECT_NEAR(truth_bound(euler) / truth_bound(plain), std::exp(2.0), 1e-6);
}

TEST(OffsetObservation, AllowsThirtyRoundingsOfTheOffset) {
  const double rounding = 1e6 * epsilon;
  OffsetObservation seen{.distance = 29 * rounding, .offset = 1e6, .shortest = 1.0, .steps = 100};
  EXPECT_TRUE(seen.is_right());
  seen.distance = 31 * rounding;
  EXPECT_FALSE(seen.is_right());
  seen.iterates = true;
  EXPECT_TRUE(seen.is_right());
  seen.distance = 1001 * rounding;
  EXPECT_FALSE(seen.is_right());
  seen.distance = no_number;
  EXPECT_FALSE(seen.is_right());
}

TEST(OffsetObservation, AsksForAWarningWhereARoundingIsAMillionthOfAnEdge) {
  OffsetObservation seen{.offset = 1e-6 / epsilon, .shortest = 1.01};
  EXPECT_TRUE(seen.is_right());
  seen.shortest = 0.99;
  EXPECT_FALSE(seen.is_right());
  seen.warned = true;
  EXPECT_TRUE(seen.is_right());
}

TEST(UnstableByTheory, IsAStepAPercentBeyondTheLimitOfWhatNothingDamps) {
  const Horizon horizon{.steps = 100, .gain = 2.0};
  const Scheme& verlet = scheme_of("verlet");
  StableStep limits;
  limits.lower = limits.upper = 10.0;
  const double limit = stable_limit(verlet, 0.0, horizon.steps, horizon.gain) / 10.0;
  EXPECT_FALSE(is_unstable_by_theory(verlet, limits, 1.005 * limit, horizon));
  EXPECT_TRUE(is_unstable_by_theory(verlet, limits, 1.02 * limit, horizon));
  EXPECT_FALSE(is_unstable_by_theory(scheme_of("backward-euler"), limits, 1e3 * limit, horizon));
  limits.damping_time.upper = 1e-3;
  EXPECT_FALSE(is_unstable_by_theory(verlet, limits, 1.02 * limit, horizon));
}

TEST(Injected, MustBeFoundIn32Steps) {
  EXPECT_FALSE(must_be_found_by(62));
  EXPECT_TRUE(must_be_found_by(63));
  EXPECT_TRUE(must_be_found_by(64));
}

// ---- runs

ExtremeCell run(const char* integrator, ExtremeSetup setup) {
  return run_extreme({"test", "box", integrator, "wrong", {}}, std::move(setup));
}
ExtremeSetup forty_steps() { return with_theta(moving_body("box"), 0.2, 40); }

TEST(Extremes, CallsARunRightWhereNothingIsWrong) { EXPECT_EQ(run("rk4", forty_steps()).outcome, ExtremeOutcome::ok); }

TEST(Extremes, CallsARunSilentWhereWhatWasInjectedIsNotFound) {
  ExtremeSetup setup = with_theta(moving_body("box"), 0.2, 80);
  setup.halfway = [](SpringColumns&) {};  // nothing that could be detected
  const ExtremeCell cell = run("rk4", setup);
  EXPECT_EQ(cell.outcome, ExtremeOutcome::silent);
  EXPECT_NE(cell.note.find("injected"), std::string::npos) << cell.note;
}

// Gravity that is switched on half way, and announced: the energy changes, and the detector has no objection.
TEST(Extremes, CallsARunSilentWhoseEnergyGrows) {
  const auto lifted = [](double gravity) {
    ExtremeSetup setup = forty_steps();
    setup.compare = false;
    setup.announced = true;
    setup.halfway = [gravity](SpringColumns& body) { body.gravity = {-gravity, 0, 0}; };  // the body lies above 0
    return run("rk4", setup);
  };
  const ExtremeCell cell = lifted(10.0);
  EXPECT_EQ(cell.outcome, ExtremeOutcome::silent) << to_string(cell.diagnosis);
  EXPECT_NE(cell.note.find("grown"), std::string::npos) << cell.note;
  EXPECT_NE(lifted(1e-3).outcome, ExtremeOutcome::silent);
}

// Half way through one vertex is displaced. The motion has an amplitude of some hundredths of an edge, the bound of a
// method of order 4 is a ninth of that.
TEST(Extremes, CallsARunSilentThatEndsFarFromTheTrueMotion) {
  const auto displaced = [](double by) {
    ExtremeSetup setup = forty_steps();
    setup.halfway = [by](SpringColumns& body) { body.x[5].x() += by; };
    return run("rk4", setup);
  };
  const ExtremeCell cell = displaced(0.04);
  EXPECT_EQ(cell.outcome, ExtremeOutcome::silent);
  EXPECT_NE(cell.note.find("true motion"), std::string::npos) << cell.note;
  EXPECT_EQ(displaced(1e-5).outcome, ExtremeOutcome::ok);
}

/// A run at an offset of a million edges, whose twin at the origin starts displaced by some roundings of the offset.
ExtremeCell run_beside(double roundings) {
  ExtremeSetup setup = forty_steps();
  setup.offset = 1e6;
  setup.at_origin = setup.body.x;
  for (auto& p : setup.body.x) p.x() += setup.offset;
  setup.at_origin[5].y() += roundings * epsilon * setup.offset;
  return run("verlet", setup);
}

TEST(Extremes, CallsARunAtAnOffsetSilentThatEndsElsewhere) {
  const ExtremeCell same = run_beside(0.0), other = run_beside(1000.0);
  EXPECT_EQ(same.outcome, ExtremeOutcome::ok) << same.note;
  EXPECT_LT(*same.offset_error, 30.0);
  EXPECT_EQ(other.outcome, ExtremeOutcome::silent) << other.note;
  EXPECT_GT(*other.offset_error, 100.0);
}

}  // namespace
}  // namespace dartboard::extreme_judge_test
