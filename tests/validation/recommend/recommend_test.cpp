#include "validation/recommend/recommend.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "core/plain/nan_maximum.h"
#include "core/time/integrators.h"
#include "tests/support/moving_box.h"
#include "tests/support/ticking_clock_for_tests.h"
#include "validation/recommend/pilots.h"
#include "validation/recommend/recommendation_audit.h"
#include "validation/scenes/scene_of_file.h"

namespace dartboard::recommend_test {
namespace {

/// Eight seconds, a checkpoint at each.
reference::NetworkMotion eight_seconds() {
  reference::NetworkMotion motion;
  for (int c = 1; c <= 8; ++c) motion.checkpoints.push_back(c);
  return motion;
}

Candidate fourth_order() {
  Candidate c;
  c.confidence = Confidence::asymptotic;
  c.order = 4;
  c.limit_h = std::numeric_limits<double>::infinity();
  c.pilot_h = 0.1;
  c.error_at_pilot = 1e-2;
  c.slope = 4.0;
  c.step_cost = 6.0;
  return c;
}

TEST(SolveForError, TheStepFollowsTheOrderWithItsSafety) {
  Candidate c = fourth_order();
  solve_for_error(c, 1e-6, eight_seconds(), 2e-6, {});
  // (1e-4)^(1/4) = 1/10, times 0.93: h = 0.0093, 107.5 steps in each of 8 intervals of 1 s
  EXPECT_EQ(c.steps, 8u * 108u);
  EXPECT_DOUBLE_EQ(c.h, 8.0 / 864.0);
  EXPECT_NEAR(c.predicted_error, 1e-2 * std::pow(c.h / 0.1, 4), 1e-20);
  EXPECT_DOUBLE_EQ(c.predicted_cost, 6.0 * 864.0);
  EXPECT_DOUBLE_EQ(c.predicted_s, 2e-6 * c.predicted_cost);
  EXPECT_FALSE(c.limited_by_stability);
}

TEST(SolveForError, TheStepStaysWithinTheStabilityLimit) {
  Candidate c = fourth_order();
  c.limit_h = 0.004;
  solve_for_error(c, 1e-6, eight_seconds(), 2e-6, {});
  EXPECT_LE(c.h, 0.95 * 0.004);
  EXPECT_TRUE(c.limited_by_stability);
}

TEST(SolveForError, OneStepForEachCheckpointIsTheFewestTriedAndNoLimitOfStability) {
  Candidate c = fourth_order();
  c.limit_h = 3.0;  // a step of 2.85 s would be stable, one of 1 s is the largest considered
  solve_for_error(c, 1e9, eight_seconds(), 2e-6, {});
  EXPECT_EQ(c.steps, 8u);
  EXPECT_TRUE(c.fewest_steps);
  EXPECT_FALSE(c.limited_by_stability);
  c.limit_h = 0.9;  // 0.855 s
  solve_for_error(c, 1e9, eight_seconds(), 2e-6, {});
  EXPECT_EQ(c.steps, 16u);
  EXPECT_FALSE(c.fewest_steps);
  EXPECT_TRUE(c.limited_by_stability);
}

TEST(SolveForError, OrdersThatDoNotShowAskForLess) {
  Candidate sure = fourth_order(), unsure = fourth_order();
  unsure.confidence = Confidence::pre_asymptotic;
  solve_for_error(sure, 1e-6, eight_seconds(), 2e-6, {});
  solve_for_error(unsure, 1e-6, eight_seconds(), 2e-6, {});
  EXPECT_GT(unsure.steps, sure.steps);
}

// Steps of 6 us at no slope: h = 6e-6 s, errors (h / 0.1)^4 of those at the pilot.
TEST(RealTime, PassesOverPredictionsThatAreNoNumbers) {
  Candidate good = fourth_order(), bad = fourth_order(), worse = fourth_order();
  good.contender = "good";
  bad.contender = "bad";
  worse.contender = "worse";
  worse.error_at_pilot *= 2.0;
  const double expected = good.error_at(6e-6);
  for (const double no_number : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    bad.error_at_pilot = no_number;
    for (const auto& candidates : {std::vector{bad, good, worse}, std::vector{good, worse, bad},
                                   std::vector{worse, bad, good}, std::vector{good, bad, worse}}) {
      const RealTime best = best_in_real_time(candidates, 1e-6, 0.95);
      EXPECT_EQ(best.by, "good");
      EXPECT_NEAR(best.error, expected, 1e-12 * expected);
    }
    const RealTime none = best_in_real_time(std::vector{bad}, 1e-6, 0.95);
    EXPECT_TRUE(std::isnan(none.error));
    EXPECT_EQ(none.by, "");
  }
}

TEST(SolveForError, StepsThatEndAtEventsAreCounted) {
  reference::NetworkMotion motion = eight_seconds();
  motion.events.push_back({2.7505, {}, {}});
  Candidate c = fourth_order();
  c.step_evaluations = 6.0;
  solve_for_error(c, 1e-6, motion, 2e-6, {});
  // 108 steps a second would do for the error, and 2^(1/4) times as many for half of it, which is aimed at where an
  // event divides a step
  EXPECT_EQ(c.steps, 8u * 128u);
  EXPECT_DOUBLE_EQ(c.predicted_evaluations, 6.0 * (1024.0 + 1.0));
}

// The rounding error goes with the mean step, 8 s / 100 with the tolerance of the pilot, and 100^0.2 as short with a
// hundredth of it.
TEST(CandidateError, OfATolerancesHasTheRoundingOfItsMeanStep) {
  Candidate c;
  c.adaptive = true;
  c.pilot_h = 1e-6;
  c.error_at_pilot = 1e-9;
  c.pilot_steps = 100.0;
  c.steps_slope = 0.2;
  c.duration = 8.0;
  c.rounding = {.factor = 1e-4, .power = 0.5};
  EXPECT_NEAR(c.error_at(1e-6), 1e-9 + 1e-4 / std::sqrt(0.08), 1e-12);
  EXPECT_NEAR(c.error_at(1e-8), 1e-11 + 1e-4 / std::sqrt(0.08 / std::pow(100.0, 0.2)), 1e-12);
}

TEST(SolveForError, ATolerancePromisesAnErrorAndANumberOfSteps) {
  Candidate c;
  c.adaptive = true;
  c.confidence = Confidence::asymptotic;
  c.order = 5;
  c.pilot_h = 1e-6;
  c.error_at_pilot = 1e-4;
  c.slope = 1.0;
  c.pilot_steps = 100.0;
  c.steps_slope = 0.2;
  c.step_cost = 6.5;
  solve_for_error(c, 1e-6, eight_seconds(), 2e-6, {});
  // the error falls with the tolerance; 0.93^5 of safety; a hundredth of the error takes 100^0.2 the steps
  const double safety = std::pow(0.93, 5);
  EXPECT_NEAR(c.tolerance, 1e-8 * safety, 1e-20);
  EXPECT_NEAR(c.predicted_error, 1e-6 * safety, 1e-18);
  EXPECT_NEAR(c.predicted_cost, 650.0 * std::pow(100.0 / safety, 0.2), 1e-9);
  EXPECT_EQ(c.setting().steps, 0u);
  EXPECT_EQ(c.setting().tolerance, c.tolerance);
}

TEST(SolveForError, BetweenPilotsCountsWhatTheyShowed) {
  Candidate c = fourth_order();
  c.coarser = {{0.2, 1e-1}, {0.4, 4e-1}};  // of order 3.3, then 2
  EXPECT_NEAR(c.error_at(0.2), 1e-1, 1e-16);
  EXPECT_NEAR(c.error_at(0.4), 4e-1, 1e-15);
  EXPECT_NEAR(c.error_at(std::sqrt(0.1 * 0.2)), std::sqrt(1e-2 * 1e-1), 1e-15);
  EXPECT_NEAR(c.error_at(0.8), 4e-1 * 16.0, 1e-13);  // beyond, by the order
  solve_for_error(c, 1e-1, eight_seconds(), 2e-6, {});
  // 0.93 times 0.2 s: 5.4 steps a second
  EXPECT_EQ(c.steps, 8u * 6u);
  EXPECT_LE(c.predicted_error, 1e-1);
}

TEST(SolveForError, NoToleranceIsLooserThanThoseThatWereTried) {
  Candidate c;
  c.adaptive = true;
  c.confidence = Confidence::asymptotic;
  c.order = 5;
  c.pilot_h = 1e-6;
  c.error_at_pilot = 1e-5;
  c.pilot_steps = 100.0;
  c.steps_slope = 0.2;
  c.step_cost = 6.5;
  c.coarser = {{1e-5, 1e-4, 60.0}, {1e-4, 1e-3, 50.0}};
  solve_for_error(c, 1.0, eight_seconds(), 2e-6, {});
  EXPECT_EQ(c.tolerance, 1e-4);
  EXPECT_EQ(c.steps, 50u);
}

TEST(SolveForError, RoundingIsPartOfTheErrorThatIsPromised) {
  Candidate c = fourth_order();
  c.rounding = {.factor = 1e-12, .power = 0.5};
  solve_for_error(c, 1e-10, eight_seconds(), 2e-6, {});
  ASSERT_TRUE(c.usable()) << c.pruned;
  // steps of 1 ms: 1e-10 by the order, 3e-11 by rounding; together they have to fit
  EXPECT_LE(c.predicted_error, 1e-10);
  EXPECT_GT(c.predicted_error, c.rounding.at(c.h));
  EXPECT_GE(c.h, c.best_step());
  // half and twice the best step are worse
  EXPECT_GT(c.error_at(0.5 * c.best_step()), c.error_at(c.best_step()));
  EXPECT_GT(c.error_at(2.0 * c.best_step()), c.error_at(c.best_step()));
}

TEST(SolveForError, AnErrorBelowRoundingIsNotPromised) {
  for (const double error : {1e-15, 1e-30}) {
    Candidate c = fourth_order();
    c.rounding = {.factor = 1e-12, .power = 0.5};
    solve_for_error(c, error, eight_seconds(), 2e-6, {});
    EXPECT_FALSE(c.usable());
    // the steps are whole, and at most the best: the error is flat there, of second order in their difference
    EXPECT_NEAR(c.least_error, c.error_at(c.best_step()), 1e-3 * c.least_error);
  }
}

TEST(SolveForError, TooManyStepsAreNotOffered) {
  Candidate c = fourth_order();
  solve_for_error(c, 1e-50, eight_seconds(), 2e-6, {});
  // (1e-48)^(1/4) of 0.1 s
  EXPECT_NE(c.pruned.find("8.6e+13 steps"), std::string::npos) << c.pruned;
}

class RecommendChain : public ::testing::TestWithParam<double> {};

TEST_P(RecommendChain, ThePickMeetsTheError) {
  const TradeoffScene scene = chain_scene(8, 64.0);
  const Recommendation r = recommend(scene, GetParam(), ticking());
  const Candidate* pick = r.pick();
  ASSERT_NE(pick, nullptr);
  const SceneReference reference = reference_of(scene, ticking());
  const Audit a = audit(scene, reference, r, {}, ticking());
  EXPECT_TRUE(a.met()) << pick->contender << ": " << a.actual_error << " for " << a.error;
  // asymptotic or not, the estimate is a prediction and no bound of convenience
  EXPECT_GT(a.actual_error, GetParam() / 1e3);
  EXPECT_EQ(a.best, "");
}

INSTANTIATE_TEST_SUITE_P(Errors, RecommendChain, ::testing::Values(1e-3, 1e-5, 1e-8));

TEST(Recommend, EveryIntegratorIsRankedOrLeftOutForAReason) {
  const Recommendation r = recommend(chain_scene(8, 64.0), 1e-4, ticking());
  const auto plain =
      std::ranges::count_if(integrators(), [](const IntegratorEntry& e) { return !e.make()->scheme().compensated; });
  ASSERT_EQ(r.candidates.size(), static_cast<std::size_t>(plain) + 1);  // and one that chooses its steps
  double previous = 0.0;
  for (const Candidate& c : r.candidates) {
    if (!c.usable()) continue;
    EXPECT_GE(c.predicted_cost, previous);
    previous = c.predicted_cost;
    if (!c.implicit && !c.adaptive) {
      EXPECT_LE(c.h, c.limit_h);
    }
  }
  EXPECT_GE(r.one_more_digit, 1.0);
}

// With fixed steps it would take more than ten, so its cost with others is not needed.
TEST(Recommend, ForetellsNothingOfWhatHadNoPilots) {
  RecommendOptions options;
  options.only = "dormand-prince-54";
  options.most_steps = 10;
  const Recommendation r = recommend(chain_scene(8, 64.0), 1e-5, ticking(), options);
  const auto adaptive = std::ranges::find(r.candidates, true, &Candidate::adaptive);
  ASSERT_NE(adaptive, r.candidates.end());
  EXPECT_TRUE(adaptive->pruned.starts_with("as with fixed steps")) << adaptive->pruned;
  EXPECT_EQ(adaptive->tolerance, 0.0);
  EXPECT_EQ(adaptive->steps, 0u);
  EXPECT_EQ(adaptive->h, 0.0);
}

TEST(Recommend, TheBracketOfOmegaHoldsTheKnownOne) {
  const TradeoffScene scene = chain_scene(8, 16.0);
  const Recommendation r = recommend(scene, 1e-2, ticking());
  // omega_max of the chain is known; power iteration approaches it from below
  EXPECT_LE(r.features.omega_low, scene.fastest_rate * (1.0 + 1e-12));
  EXPECT_GE(r.features.omega_high, scene.fastest_rate);
}

TEST(Recommend, ConsidersOneIntegratorOnlyWhereOneIsNamed) {
  RecommendOptions options;
  options.only = "verlet";
  const Recommendation r = recommend(chain_scene(8, 64.0), 1e-4, ticking(), options);
  ASSERT_EQ(r.candidates.size(), 1u);
  EXPECT_EQ(r.candidates[0].contender, "verlet");
  EXPECT_NE(r.pick(), nullptr);
}

// A tenth of the error takes sqrt(10) times the steps of a method of order 2, up to whole steps between checkpoints.
TEST(Recommend, TellsWhatOneMoreDigitCosts) {
  RecommendOptions options;
  options.only = "verlet";
  options.adaptive = false;
  const Recommendation r = recommend(chain_scene(8, 64.0), 1e-5, ticking(), options);
  ASSERT_NE(r.pick(), nullptr);
  ASSERT_EQ(r.pick()->confidence, Confidence::asymptotic);
  EXPECT_NEAR(r.one_more_digit, std::sqrt(10.0), 0.05);
  EXPECT_EQ(r.one_more_digit_by, "verlet");
}

TEST(Recommend, AToleranceMeetsTheErrorToo) {
  RecommendOptions options;
  options.only = "dormand-prince-54";
  const TradeoffScene scene = chain_scene(8, 64.0);
  Recommendation r = recommend(scene, 1e-5, ticking(), options);
  const auto by_tolerance = std::ranges::find(r.candidates, true, &Candidate::adaptive);
  ASSERT_TRUE(by_tolerance != r.candidates.end() && by_tolerance->usable()) << by_tolerance->pruned;
  const TimedRun run = run_timed(scene, *by_tolerance->make(), by_tolerance->setting(), ticking());
  EXPECT_LE(reference::motion_errors(scene.motion, run.states, scene.closed_form()).x, 1e-5);
  // steps vary over the motion, and the last of an interval is cut short
  const auto evaluations = static_cast<double>(run.work.force_evaluations);
  EXPECT_NEAR(by_tolerance->predicted_evaluations / evaluations, 1.0, 0.15);
}

// Scenes have one step throughout.
TEST(Recommend, HandsOverFixedSteps) {
  Recommendation r = recommend(chain_scene(8, 64.0), 1e-5, ticking(), {.only = "dormand-prince-54"});
  ASSERT_NE(r.pick(), nullptr);
  EXPECT_FALSE(r.pick()->adaptive);
  for (Candidate& c : r.candidates)
    if (c.adaptive) c.predicted_cost = 0.5 * r.pick()->predicted_cost;
  ASSERT_NE(r.cheaper_by_tolerance(), nullptr);
  EXPECT_TRUE(r.cheaper_by_tolerance()->adaptive);
  for (Candidate& c : r.candidates)
    if (c.adaptive) c.predicted_cost = 2.0 * r.pick()->predicted_cost;
  EXPECT_EQ(r.cheaper_by_tolerance(), nullptr);
}

TEST(Recommend, PilotsEndWhenTheirTimeIsUpAndOneIsPickedAllTheSame) {
  // every reading of the clock takes a tenth of a second: there is time for a few only
  const CpuClock slow = [t = std::int64_t{0}]() mutable { return t += 100'000'000; };
  RecommendOptions options;
  options.pilot_part = 0.0;
  const Recommendation r = recommend(chain_scene(8, 64.0), 1e-4, slow, options);
  ASSERT_NE(r.pick(), nullptr);
  EXPECT_TRUE(
      std::ranges::any_of(r.candidates, [](const Candidate& c) { return c.pruned == "the time for pilots is up"; }));
  // methods that were not tried are named; those that were tried, or lost by the law, are not
  const auto untried = r.untried();
  EXPECT_FALSE(untried.empty());
  for (const Candidate& c : r.candidates) {
    EXPECT_EQ(std::ranges::count(untried, c.contender), c.untried ? 1 : 0) << c.contender << ": " << c.pruned;
    EXPECT_FALSE(c.untried && c.usable());
  }
}

// The pilots see some hundredths of it.
TEST(Recommend, ForetellsALongMotionWithinABudget) {
  const TradeoffScene scene = chain_scene(8, 2e4);
  for (const double error : {1e-2, 1e-4}) {
    RecommendOptions options;
    options.budget_s = 3e-4;
    const Recommendation r = recommend(scene, error, ticking(), options);
    const Candidate* pick = r.pick();
    ASSERT_NE(pick, nullptr) << error;
    EXPECT_LT(pick->seen_part, 0.5) << error;
    EXPECT_FALSE(pick->full_length) << error;
    const Audit a = audit(scene, reference_of(scene, ticking()), r, {}, ticking(), 1);
    EXPECT_TRUE(a.met()) << pick->contender << ": " << a.actual_error << " for " << error;
    EXPECT_GT(a.actual_error, 0.02 * error) << pick->contender;
    EXPECT_EQ(a.printed_s, pick->predicted_s);
  }
}

TEST(Recommend, ALargerBudgetTriesMore) {
  const TradeoffScene scene = chain_scene(8, 64.0);
  std::size_t before = 100;
  for (const double budget : {2e-4, 2.0}) {
    RecommendOptions options;
    options.budget_s = budget;
    const Recommendation r = recommend(scene, 1e-5, ticking(), options);
    ASSERT_NE(r.pick(), nullptr) << budget;
    EXPECT_LT(r.untried().size(), before) << budget;
    before = r.untried().size();
  }
  EXPECT_EQ(before, 0u);
}

TEST(Recommend, AnErrorThatDoublesCannotMeetIsNotPromised) {
  for (const double error : {1e-16, 1e-30}) {
    const Recommendation r = recommend(chain_scene(8, 64.0), error, ticking());
    EXPECT_EQ(r.pick(), nullptr);
    // coordinates of some ten edges: 1e-15 with compensation, a few thousand steps without it 1e-13
    EXPECT_GT(r.best_error, 1e-16);
    EXPECT_LT(r.best_error, 1e-13);
  }
}

TEST(Recommend, ACompensatedMethodGoesWherePlainOnesCannot) {
  const TradeoffScene scene = chain_scene(8, 64.0);
  const Recommendation r = recommend(scene, 1e-14, ticking());
  ASSERT_NE(r.pick(), nullptr);
  EXPECT_EQ(r.pick()->contender, "blanes-moan-4-compensated");
  EXPECT_TRUE(audit(scene, reference_of(scene, ticking()), r, {}, ticking()).met());
}

TEST(Recommend, OnAStiffSceneImplicitMethodsAreTriedBeforeTheTimeForPilotsIsUp) {
  // springs 1e8 times as stiff as those that the motion shows, and an error that a few steps of that motion meet
  const TradeoffScene scene = stiff_scene("stiff", kuhn_box(3, 3, 3, 0.1), 1e8, {});
  // a thousand readings of the clock: half of the explicit methods would use them up
  RecommendOptions options;
  options.pilot_part = 0.0;
  options.pilot_floor_s = 1e-3;
  const Recommendation r = recommend(scene, 1e-1, ticking(), options);
  EXPECT_FALSE(r.untried().empty());
  ASSERT_NE(r.pick(), nullptr);
  EXPECT_TRUE(r.pick()->implicit) << r.pick()->contender;
}

TEST(Recommend, ANonsensicalErrorIsRefused) {
  EXPECT_THROW(recommend(chain_scene(4, 4.0), 0.0, ticking()), InputError);
  EXPECT_THROW(recommend(chain_scene(4, 4.0), std::nan(""), ticking()), InputError);
}

/// A soft box that falls on a plane.
TradeoffScene falling_box() {
  moving::Json json = moving::moving_box();
  json["body"]["translate"] = {0, 0, 0.03};
  json["material"] = moving::Json::parse(R"({"density": 1000, "young": 30000, "poisson": 0.3})");
  json["initial_velocity"] = {0.1, 0, -0.3};
  json["duration"] = 0.25;
  json["contact"] = moving::Json::parse(R"({"pressure": 4000, "depth": 0.02, "restitution": 0.5, "friction": 0.3,
                                            "obstacles": [{"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}]})");
  return scene_of_file(moving::parse(json));
}

// The body flies for a third of the time: what its first part shows says nothing about the rest.
TEST(Recommend, MeetsTheErrorThroughContactByPilotsThatAreWholeRuns) {
  const TradeoffScene scene = falling_box();
  const TimedRun truth = run_timed(scene, *make_integrator("rk4"), {.steps = 8192}, no_clock);
  for (const double error : {1e-2, 1e-3}) {
    const Recommendation r = recommend(scene, error, ticking());
    ASSERT_NE(r.pick(), nullptr);
    EXPECT_TRUE(r.pick()->full_length);
    EXPECT_FALSE(r.pick()->adaptive);
    EXPECT_EQ(r.pick()->order, 1);  // friction leaves no more
    const TimedRun run = run_timed(scene, *r.pick()->make(), r.pick()->setting(), no_clock);
    EXPECT_LE(max_or_nan(differences(scene, run, truth)), error) << r.pick()->contender;
  }
}

}  // namespace
}  // namespace dartboard::recommend_test
