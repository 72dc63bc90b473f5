#include "validation/tradeoff/work_precision.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/plain/error.h"
#include "core/time/integrators.h"
#include "tests/support/ticking_clock_for_tests.h"
#include "validation/scenes/scene_of_file.h"
#include "validation/tradeoff/cvode_adams.h"

namespace dartboard::work_precision_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

WorkPoint point(const std::string& contender, double error, std::vector<double> costs) {
  WorkPoint p;
  p.contender = contender;
  p.setting.steps = 1;
  p.errors.x = error;
  p.costs = std::move(costs);
  p.cost = p.costs[p.costs.size() / 2];
  return p;
}

TEST(Classify, FrontUndecidedDominatedUselessAndFailed) {
  std::vector<WorkPoint> points{point("a", 1e-3, {9, 10, 11}),       point("b", 1e-3, {10.5, 12, 13}),
                                point("c", 1e-2, {14, 15, 16}),      point("d", 2.0, {1, 1, 1}),
                                point("e", std::nan(""), {1, 1, 1}), point("f", 1e-9, {1, 1, 1})};
  points[5].code = "NONFINITE";
  classify(points, 0.0);
  EXPECT_EQ(points[0].standing, Standing::front);
  EXPECT_EQ(points[1].standing, Standing::undecided);  // 10.5 is not above 11
  EXPECT_EQ(points[2].standing, Standing::dominated);
  EXPECT_EQ(points[3].standing, Standing::useless);
  EXPECT_EQ(points[4].standing, Standing::useless);  // a NaN is no small error
  EXPECT_EQ(points[5].standing, Standing::failed);
}

TEST(Classify, ErrorsBelowTheFloorAreEqual) {
  std::vector<WorkPoint> points{point("a", 1e-14, {20, 20, 20}), point("b", 1e-13, {10, 10, 10})};
  classify(points, 1e-12);
  EXPECT_EQ(points[0].standing, Standing::dominated);
  EXPECT_EQ(points[1].standing, Standing::front);
}

TEST(CostAt, LiesBetweenTheStepsThatEncloseTheError) {
  std::vector<WorkPoint> points{point("a", 1e-2, {10}), point("a", 1e-4, {1000}), point("b", 1e-3, {5})};
  classify(points, 0.0);
  EXPECT_NEAR(cost_at(points, "a", 1e-3), 100.0, 1e-10);  // halfway on both scales; a few roundings of pow
  EXPECT_EQ(cost_at(points, "a", 1e-1), 10.0);
  EXPECT_EQ(cost_at(points, "a", 1e-5), infinity);
}

TEST(CostAt, DoesNotInterpolateAcrossARunThatFailed) {
  std::vector<WorkPoint> points{point("a", 1e-2, {10}), point("a", 0.0, {20}), point("a", 1e-4, {1000})};
  points[1].code = "NONFINITE";
  classify(points, 0.0);
  EXPECT_EQ(cost_at(points, "a", 1e-3), 1000.0);
}

TEST(Winners, SayHowOftenForcesAreEvaluatedBesideTheCost) {
  std::vector<WorkPoint> points{point("a", 1e-2, {10}), point("a", 1e-4, {1000})};
  points[0].work.force_evaluations = 4;
  points[1].work.force_evaluations = 400;
  points[0].h = 4.0;
  points[1].h = 1.0;
  classify(points, 0.0);
  const double errors[]{1e-3, 1e-4, 1e-6};
  const auto best = winners(points, errors);
  EXPECT_NEAR(best[0].evaluations, 40.0, 1e-11);  // as the cost, halfway on both scales
  EXPECT_EQ(best[1].evaluations, 400.0);
  EXPECT_NEAR(best[0].h, 2.0, 1e-13);
  EXPECT_EQ(best[1].h, 1.0);
  EXPECT_EQ(best[2].evaluations, 0.0);  // no run reaches it
}

TEST(Winners, PeersDoNotTakePartAndHaveARegret) {
  std::vector<WorkPoint> points{point("a", 1e-3, {10}), point("b", 1e-3, {30}), point("peer", 1e-3, {5})};
  points[2].peer = true;
  classify(points, 0.0);
  const double errors[]{1e-3, 1e-6};
  const auto best = winners(points, errors);
  EXPECT_EQ(best[0].contender, "a");
  EXPECT_EQ(best[0].runner_up, "b");
  EXPECT_EQ(best[1].contender, "");
  const auto all = regrets(points, errors);
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[1].of_error[0], 3.0);
  EXPECT_EQ(all[1].worst, infinity);
  EXPECT_EQ(all[2].of_error[0], 0.5);
}

TEST(RunTimed, TheChainConvergesToItsClosedForm) {
  const TradeoffScene scene = chain_scene(6, 16.0, 4);
  const SceneReference reference = reference_of(scene, ticking());
  EXPECT_EQ(reference.kind, ReferenceKind::closed_form);
  const auto error = [&](std::uint64_t steps) {
    const auto integrator = make_integrator("verlet");
    const TimedRun run = run_timed(scene, *integrator, {.steps = steps}, ticking());
    EXPECT_EQ(run.work.force_evaluations, steps);
    return reference::motion_errors(scene.motion, run.states, reference.states).x;
  };
  // order 2 at h omega = 1/64, where the next term is (h omega)^2 of the first
  EXPECT_NEAR(error(1024) / error(2048), 4.0, 0.01);
}

TEST(RunTimed, AToleranceNeedsAnIntegratorThatChoosesItsSteps) {
  const TradeoffScene scene = chain_scene(4, 4.0, 2);
  EXPECT_THROW(run_timed(scene, *make_integrator("verlet"), {.tolerance = 1e-3}, ticking()), InputError);
  EXPECT_THROW(run_timed(scene, *make_integrator("verlet"), {}, ticking()), InputError);
  const auto adaptive = make_integrator("dormand-prince-54");
  EXPECT_EQ(run_timed(scene, *adaptive, {.tolerance = 1e-3}, ticking()).states.size(), 2u);
}

/// Records the lengths of its steps, and moves everything on at its speed.
class RemembersItsSteps : public Integrator {
 public:
  const Scheme& scheme() const override { return real_->scheme(); }
  StepResult step(const SpringSystem&, Motion motion, double h) override {
    lengths.push_back(h);
    for (std::size_t i = 0; i < motion.x.size(); ++i) motion.x[i] += h * motion.v[i];
    return {};
  }
  std::vector<double> lengths;

 private:
  std::unique_ptr<Integrator> real_ = make_integrator("verlet");
};

// A tenth of a second is no sum of powers of two, and differences of its multiples are a rounding longer or shorter.
TEST(RunTimed, MakesStepsOfOneLengthWhereTheyFit) {
  TradeoffScene scene = chain_scene(4, 8.0, 2);
  scene.duration = 1.0;
  scene.motion.checkpoints.clear();
  for (int c = 1; c <= 10; ++c) scene.motion.checkpoints.push_back(c / 10.0);
  RemembersItsSteps integrator;
  run_timed(scene, integrator, {.steps = 10}, ticking());
  EXPECT_EQ(integrator.lengths, std::vector<double>(10, 0.1));
}

TEST(RunTimed, DividesTheStepThatACheckpointIsWithin) {
  TradeoffScene scene = chain_scene(4, 8.0, 2);
  scene.duration = 1.0;
  scene.motion.checkpoints = {0.125, 0.3125, 1.0};
  RemembersItsSteps integrator;
  const TimedRun run = run_timed(scene, integrator, {.steps = 8}, ticking());
  std::vector<double> expected{0.125, 0.125, 0.0625, 0.0625};
  expected.insert(expected.end(), 5, 0.125);
  EXPECT_EQ(integrator.lengths, expected);
  for (std::size_t c = 0; c < 3; ++c)
    EXPECT_NEAR(run.states[c].x[1].x(),
                scene.motion.start.x[1].x() + scene.motion.checkpoints[c] * scene.motion.start.v[1].x(), 1e-15);
}

TEST(RunTimed, ARunThatTakesTooLongIsGivenUpWithADiagnosis) {
  const TradeoffScene scene = chain_scene(4, 64.0, 2);
  const TimedRun run = run_timed(scene, *make_integrator("verlet"), {.steps = 4096}, ticking(), {.cpu_ns = 10'000});
  EXPECT_EQ(run.result.code, StepCode::budget);
  EXPECT_LT(run.states.size(), 2u);
}

TEST(RunTimed, APrefixEndsAtItsCheckpoint) {
  const TradeoffScene scene = chain_scene(4, 8.0, 4);
  const auto whole = run_timed(scene, *make_integrator("rk4"), {.steps = 64}, ticking());
  const auto part = run_timed(scene, *make_integrator("rk4"), {.steps = 64}, ticking(), {.checkpoints = 2});
  ASSERT_EQ(part.states.size(), 2u);
  EXPECT_EQ(part.states[1].x, whole.states[1].x);
  EXPECT_EQ(part.work.steps, 32u);
}

TEST(TradeoffScenes, AnUnknownNameIsAnsweredWithTheKnownOnes) {
  try {
    make_tradeoff_scene("nonsense", "");
    FAIL();
  } catch (const InputError& error) {
    for (const TradeoffEntry& entry : tradeoff_scenes())
      EXPECT_NE(std::string(error.what()).find(entry.name), std::string::npos);
  }
}

TEST(ErrorOfRest, IsTheSizeOfTheMotion) {
  const TradeoffScene scene = chain_scene(6, 16.0, 4);
  const SceneReference reference = reference_of(scene, ticking());
  double expected = 0.0;
  for (const PointState& state : reference.states) {
    double sum = 0.0;
    for (std::size_t i = 0; i < state.x.size(); ++i) sum += (state.x[i] - scene.motion.start.x[i]).squaredNorm();
    expected = std::max(expected, std::sqrt(sum / 8.0) / scene.edge);  // 6 masses and 2 walls, all equal
  }
  EXPECT_NEAR(error_of_rest(scene, reference), expected, 1e-13);
}

// A run that stays at its start is of no use, nor is one that is an edge off.
TEST(WorkPrecisionStudy, CallsErrorsUselessFromThatOfRestOnAndFromAnEdgeOn) {
  TradeoffScene scene = chain_scene(6, 16.0, 4);
  SceneReference reference = reference_of(scene, ticking());
  const double rest = error_of_rest(scene, reference);
  ASSERT_LT(rest, 1.0);
  EXPECT_EQ(work_precision(scene, reference, {}, ticking(), {}).useless_from, rest);
  for (PointState& state : reference.states)
    for (auto& x : state.x) x.y() += 2.0 * scene.edge;
  EXPECT_EQ(work_precision(scene, reference, {}, ticking(), {}).useless_from, 1.0);
}

TEST(WorkPrecisionStudy, EveryContenderMeetsItsFailurePointAndConverges) {
  const TradeoffScene scene = chain_scene(4, 16.0, 4);
  const SceneReference reference = reference_of(scene, ticking());
  WorkPrecisionOptions options;
  options.fewest_repetitions = options.most_repetitions = 1;
  options.most_s = 3e-4;  // on this clock a reading takes a microsecond
  std::vector<TradeoffContender> contenders;
  for (const std::string name : {"verlet", "blanes-moan-4", "rk4"})
    contenders.push_back({name, [name] { return make_integrator(name); }, false, false});
  std::size_t seen = 0;
  const WorkPrecision study =
      work_precision(scene, reference, contenders, ticking(), options, [&](const WorkPoint&) { ++seen; });
  EXPECT_EQ(seen, study.points.size());
  for (const TradeoffContender& c : contenders) {
    const double limit = c.make()->scheme().imaginary_limit;
    double largest = 0.0, least = infinity;
    for (const WorkPoint& p : study.points)
      if (p.contender == c.name) {
        largest = std::max(largest, p.h_omega);
        if (!p.failed()) least = std::min(least, p.errors.x);
      }
    EXPECT_GT(largest, limit) << c.name;
    EXPECT_LT(least, 1e-2) << c.name;
  }
}

WorkPrecisionOptions once() {
  WorkPrecisionOptions options;
  options.fewest_repetitions = options.most_repetitions = 1;
  return options;
}

std::vector<TradeoffContender> only(const std::string& name) {
  return {{name, [name] { return make_integrator(name); }, false, false}};
}

TEST(WorkPrecisionStudy, EndsWhereTheReferenceTellsNoErrorsAnyMore) {
  const TradeoffScene scene = chain_scene(4, 16.0, 4);
  SceneReference reference = reference_of(scene, ticking());
  reference.floor = 1e-4;
  const WorkPrecision study = work_precision(scene, reference, only("rk4"), ticking(), once());
  ASSERT_GT(study.points.size(), 2u);
  for (std::size_t k = 0; k + 1 < study.points.size(); ++k) {
    EXPECT_TRUE(study.points[k].failed() || study.points[k].errors.x >= 3e-4) << k;
    EXPECT_EQ(study.points[k + 1].setting.steps, 2 * study.points[k].setting.steps);
  }
  EXPECT_LT(study.points.back().errors.x, 3e-4);
  EXPECT_EQ(study.omissions, scene.omissions);
  for (const WorkPoint& p : study.points) EXPECT_EQ(p.under_floor, !p.failed() && p.errors.x < 1e-4);
}

TEST(WorkPrecisionStudy, GivesARunUpThatTakesHalfAsLongAgainAsAllowed) {
  const TradeoffScene scene = chain_scene(4, 16.0, 4);
  const SceneReference reference = reference_of(scene, ticking());
  WorkPrecisionOptions options = once();
  options.most_s = 1e-6;  // one reading: the first run has more
  const WorkPrecision study = work_precision(scene, reference, only("rk4"), ticking(), options);
  ASSERT_EQ(study.points.size(), 1u);
  EXPECT_EQ(study.points[0].code, to_string(StepCode::budget));
  ASSERT_EQ(study.omissions.size(), scene.omissions.size() + 1);
  EXPECT_TRUE(study.omissions.back().starts_with("rk4: nothing below h omega_max = ")) << study.omissions.back();
}

TEST(WorkPrecisionStudy, LeavesOutAMethodThatTheSceneCannotHave) {
  const SceneFile file = parse_scene(R"({"name": "stack", "bodies": [
      {"generate": {"box": {"cells": [1, 1, 1], "spacing": 0.1}}},
      {"generate": {"box": {"cells": [1, 1, 1], "spacing": 0.1}}, "translate": [0, 0, 0.11]}],
      "material": {"density": 1000, "stiffness": 1000}, "step": 1e-3, "duration": 0.01,
      "contact": {"pressure": 1e4, "depth": 0.01, "bodies": "others"}})",
                                     "stack.json", {});
  const TradeoffScene scene = scene_of_file(file);
  SceneReference reference;
  reference.states.assign(scene.motion.checkpoints.size(), scene.motion.start);
  const WorkPrecision study = work_precision(scene, reference, only("energy-momentum"), ticking(), once());
  EXPECT_TRUE(study.points.empty());
  ASSERT_FALSE(study.omissions.empty());
  EXPECT_EQ(study.omissions.back(), "energy-momentum: contact between bodies has kinks");
  EXPECT_TRUE(takes(scene, "rk4"));
}

/// Refuses every step.
class Refusal : public Integrator {
 public:
  const Scheme& scheme() const override { return real_->scheme(); }
  StepResult step(const SpringSystem&, Motion, double h) override {
    return {StepCode::step_underflow, Witness::none, 0, "step", h};
  }
  void restart() override {}

 private:
  std::unique_ptr<Integrator> real_ = make_integrator("verlet");
};

TEST(WorkPrecisionStudy, GivesAMethodUpThatFailsEvenWithSmallSteps) {
  const TradeoffScene scene = chain_scene(4, 16.0, 4);
  const SceneReference reference = reference_of(scene, ticking());
  const std::vector<TradeoffContender> refusal{{"refusal", [] { return std::make_unique<Refusal>(); }, false, false}};
  const WorkPrecision study = work_precision(scene, reference, refusal, ticking(), once());
  ASSERT_FALSE(study.points.empty());
  for (const WorkPoint& p : study.points) {
    EXPECT_TRUE(p.failed());
    EXPECT_EQ(p.standing, Standing::failed);
    EXPECT_EQ(p.h_omega < 1e-3, &p == &study.points.back());
  }
}

TEST(Winners, NameTheRunnerUpAndItsCost) {
  std::vector<WorkPoint> points{point("a", 1e-3, {10}), point("b", 1e-3, {30}), point("c", 1e-3, {20})};
  classify(points, 0.0);
  const double errors[]{1e-3};
  Winner best = winners(points, errors)[0];
  EXPECT_EQ(best.contender, "a");
  EXPECT_EQ(best.cost, 10.0);
  EXPECT_EQ(best.runner_up, "c");
  EXPECT_EQ(best.runner_up_cost, 20.0);
  points.pop_back();
  points.pop_back();
  best = winners(points, errors)[0];
  EXPECT_EQ(best.contender, "a");
  EXPECT_EQ(best.runner_up, "");
  EXPECT_EQ(best.runner_up_cost, 0.0);
}

TEST(CvodeAdamsPeer, FollowsTheChainWithinItsToleranceOrSaysThatThereIsNoSundials) {
  const TradeoffScene scene = chain_scene(6, 16.0, 4);
  if (!CvodeAdams::available()) {
    CvodeAdams integrator;
    EXPECT_THROW(run_timed(scene, integrator, {.tolerance = 1e-6}, ticking()), InputError);
    return;
  }
  const SceneReference reference = reference_of(scene, ticking());
  const auto error = [&](double tolerance) {
    CvodeAdams integrator;
    const TimedRun run = run_timed(scene, integrator, {.tolerance = tolerance}, ticking());
    EXPECT_TRUE(run.result.ok());
    EXPECT_GT(run.work.force_evaluations, run.work.steps);
    return reference::motion_errors(scene.motion, run.states, reference.states).x;
  };
  // The tolerance is per step. Over this run, some hundred steps, errors add up to a few hundred of them at most.
  EXPECT_LT(error(1e-6), 1e-3);
  EXPECT_LT(error(1e-10), 1e-7);
}

TEST(WorkPrecisionEnds, WhereAMethodIsGoodEnough) {
  const TradeoffScene scene = chain_scene(4, 16.0, 4);
  WorkPrecisionOptions options;
  options.fewest_repetitions = options.most_repetitions = 1;
  options.enough_error = 1e-3;
  const std::vector<TradeoffContender> verlet{{"verlet", [] { return make_integrator("verlet"); }, false, false}};
  const auto points = work_precision(scene, reference_of(scene, ticking()), verlet, ticking(), options).points;
  ASSERT_GE(points.size(), 2u);
  EXPECT_LE(points.back().errors.x, 1e-3);
  for (std::size_t k = 0; k + 1 < points.size(); ++k) EXPECT_FALSE(points[k].errors.x <= 1e-3) << k;
}

// With as much time as a run of 4096 steps takes, Verlet reaches some 1e-6, and not 1e-9: that is clear at once.
TEST(WorkPrecisionEnds, WhereAMethodCannotBecomeUseful) {
  const TradeoffScene scene = chain_scene(4, 16.0, 4);
  const std::vector<TradeoffContender> verlet{{"verlet", [] { return make_integrator("verlet"); }, false, false}};
  const auto points_for = [&](double error) {
    WorkPrecisionOptions options;
    options.fewest_repetitions = options.most_repetitions = 1;
    options.most_s = 4e-5;  // on this clock a reading takes a microsecond
    options.useful_error = error;
    return work_precision(scene, reference_of(scene, ticking()), verlet, ticking(), options);
  };
  const WorkPrecision all = points_for(1.0), few = points_for(1e-12);
  EXPECT_LT(few.points.size(), all.points.size());
  ASSERT_FALSE(few.omissions.empty());
  EXPECT_NE(few.omissions.back().find("at best"), std::string::npos) << few.omissions.back();
}

}  // namespace
}  // namespace dartboard::work_precision_test
