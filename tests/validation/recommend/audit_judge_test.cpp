// An audit reports the error of a run, and so does a work-precision study; seeds draw what they say.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/time/integrators.h"
#include "reference/error_norms.h"
#include "tests/support/ticking_clock_for_tests.h"
#include "validation/recommend/recommendation_audit.h"
#include "validation/scenes/random_scenes.h"

namespace dartboard::audit_judge_test {
namespace {

/// The error of so many steps of Verlet, independent of any study.
double error_of(const TradeoffScene& scene, std::uint64_t steps) {
  const auto integrator = make_integrator("verlet");
  const TimedRun run = run_timed(scene, *integrator, {.steps = steps}, ticking());
  return reference::motion_errors(scene.motion, run.states, scene.closed_form()).x;
}

/// Verlet with so many steps, recommended for an error.
Recommendation verlet_for(double error, std::uint64_t steps) {
  Candidate pick;
  pick.contender = "verlet";
  pick.steps = steps;
  pick.predicted_error = 0.5 * error;
  pick.predicted_cost = 100.0;
  pick.predicted_evaluations = 99.0;
  Recommendation r;
  r.error = error;
  r.pilot_s = 0.25;
  r.candidates = {pick};
  return r;
}

class AuditOfAChain : public ::testing::Test {
 protected:
  Audit audit_of(double error, std::uint64_t steps, std::span<const WorkPoint> sweep = {}) const {
    return audit(scene, exact, verlet_for(error, steps), sweep, ticking());
  }
  TradeoffScene scene = chain_scene(6, 16.0, 4);
  SceneReference exact = reference_of(scene, ticking());
};

TEST_F(AuditOfAChain, ReportsTheErrorThatTheRunHas) {
  for (const std::uint64_t steps : {64u, 512u}) EXPECT_EQ(audit_of(1.0, steps).actual_error, error_of(scene, steps));
}

TEST_F(AuditOfAChain, SaysThatAnErrorIsMissed) {
  const double error = error_of(scene, 64);
  EXPECT_TRUE(audit_of(1.01 * error, 64).met());
  EXPECT_FALSE(audit_of(0.99 * error, 64).met());
  EXPECT_FALSE(audit_of(error / 5, 64).met());
}

TEST_F(AuditOfAChain, SaysThatAnErrorIsMissedWhereTheRunFailsOrNothingIsKnown) {
  // h omega = 10: a hundredfold in each of a thousand steps
  const TradeoffScene longer = chain_scene(6, 1e4, 4);
  const Audit failed = audit(longer, reference_of(longer, ticking()), verlet_for(1e9, 1000), {}, ticking());
  EXPECT_EQ(failed.actual_error, std::numeric_limits<double>::infinity());
  EXPECT_FALSE(failed.met());
  SceneReference nothing = exact;
  nothing.states.clear();
  EXPECT_FALSE(audit(scene, nothing, verlet_for(1.0, 64), {}, ticking()).met());
}

TEST_F(AuditOfAChain, CountsTheEvaluationsThatTheRunMakes) {
  const Audit a = audit_of(1.0, 64);
  EXPECT_EQ(a.actual_evaluations, 64.0);  // Verlet, one a step
  EXPECT_EQ(a.predicted_evaluations, 99.0);
  EXPECT_EQ(a.predicted_error, 0.5);
  EXPECT_EQ(a.predicted_cost, 100.0);
  EXPECT_EQ(a.pilot_s, 0.25);
  EXPECT_GT(a.actual_cost, 0.0);
}

TEST_F(AuditOfAChain, ComparesWithTheCheapestOfTheSweepThatMeetsTheError) {
  const auto point = [](const char* name, double error, double cost) {
    WorkPoint p;
    p.contender = name;
    p.errors.x = error;
    p.cost = cost;
    p.costs = {cost};
    return p;
  };
  std::vector<WorkPoint> sweep{point("at first", 1e-4, 50.0), point("cheap", 1e-4, 5.0), point("coarse", 0.5, 1.0)};
  classify(sweep, 0.0);
  const Audit a = audit_of(1e-3, 64, sweep);
  EXPECT_EQ(a.best, "cheap");
  EXPECT_EQ(a.best_cost, 5.0);
  EXPECT_DOUBLE_EQ(a.regret(), a.actual_cost / 5.0);
}

TEST(WorkPrecisionJudge, ReportsTheErrorsThatItsRunsHave) {
  const TradeoffScene scene = chain_scene(4, 16.0, 4);
  WorkPrecisionOptions options;
  options.fewest_repetitions = options.most_repetitions = 1;
  options.most_s = 2.5e-5;  // on this clock a reading takes a microsecond
  const std::vector<TradeoffContender> verlet{{"verlet", [] { return make_integrator("verlet"); }, false, false}};
  std::size_t compared = 0;
  for (const WorkPoint& p : work_precision(scene, reference_of(scene, ticking()), verlet, ticking(), options).points) {
    if (p.failed()) continue;
    EXPECT_EQ(p.errors.x, error_of(scene, p.setting.steps));
    EXPECT_EQ(p.work.force_evaluations, p.setting.steps);
    EXPECT_DOUBLE_EQ(p.h, scene.duration / static_cast<double>(p.setting.steps));
    ++compared;
  }
  EXPECT_GE(compared, 3u);
}

// The oracle knows nothing of normal modes: it must find the closed form of the chain.
TEST(SceneReferenceJudge, FindsTheClosedFormWithoutBeingTold) {
  TradeoffScene scene = chain_scene(4, 8.0, 2);
  const auto exact = scene.closed_form();
  scene.closed_form = nullptr;
  const SceneReference found = reference_of(scene, ticking(), {.gain = false});
  EXPECT_EQ(found.kind, ReferenceKind::certified);
  EXPECT_LE(reference::motion_errors(scene.motion, found.states, exact).x, found.floor + 1e-13);
  EXPECT_GT(found.floor, 0.0);
  EXPECT_LE(found.floor, 1e-10);
}

// ---- seeds

TEST(RandomSceneSeeds, DrawOtherScenes) {
  const RandomSceneOptions small{.most_points = 150, .most_work = 2e4};
  for (std::uint64_t number = 0; number < 3; ++number) {
    const TradeoffScene a = random_scene(4, number, small), b = random_scene(5, number, small);
    EXPECT_NE(a.what, b.what) << number;
    EXPECT_NE(a.motion.start.x, b.motion.start.x) << number;
    EXPECT_NE(a.duration, b.duration) << number;
  }
}

}  // namespace
}  // namespace dartboard::audit_judge_test
