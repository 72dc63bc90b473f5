// Pilots: the runs that are made before a method is given up, by a clock that counts its readings.

#include "validation/recommend/pilots.h"

#include <gtest/gtest.h>

#include <cmath>

#include "benchmarks/checkout/source_folder.h"
#include "core/plain/nan_maximum.h"
#include "core/scene/file/scene_file.h"
#include "core/time/integrators.h"
#include "reference/error_norms.h"
#include "tests/support/ticking_clock_for_tests.h"
#include "validation/recommend/candidate_pilots.h"
#include "validation/scenes/scene_of_file.h"

namespace dartboard::pilots_test {
namespace {

Candidate candidate(const char* name, bool implicit) {
  Candidate c;
  c.contender = name;
  c.implicit = implicit;
  c.order = implicit ? 1 : 2;
  c.limit_h = std::numeric_limits<double>::infinity();
  return c;
}

/// The result for a candidate if the cheapest method so far takes `cheapest_s`.
Candidate piloted(Candidate c, double cheapest_s, RecommendOptions options = {}, const CpuClock& clock = ticking()) {
  const TradeoffScene scene = chain_scene(8, 64.0);
  options.pilot_floor_s = std::max(options.pilot_floor_s, 0.5);
  Pilots pilots(scene, clock, options, clock());
  if (std::isfinite(cheapest_s)) pilots.predicted(cheapest_s);
  pilot_prefix(c, pilots, 0.5 / scene.fastest_rate, 1e-9, 1e-9);
  return c;
}

/// The seconds that its first pilot predicts for the whole run.
double predicted(const Candidate& c) {
  const Candidate pruned = piloted(c, 1e-30);
  const auto at = pruned.pruned.find("it takes ");
  EXPECT_NE(at, std::string::npos) << pruned.pruned;
  return at == std::string::npos ? 0.0 : std::stod(pruned.pruned.substr(at + 9));
}

// An explicit method is given up beyond 1.5 times the cheapest, an implicit one, of which coarser steps may do, beyond
// 4 times; the prediction is printed with two digits.
TEST(PilotPrefix, GivesAMethodUpWhoseCoarsestRunIsTooDear) {
  for (const bool implicit : {false, true}) {
    const Candidate c = candidate(implicit ? "backward-euler" : "verlet", implicit);
    const double seconds = predicted(c), most = implicit ? 4.0 : 1.5;
    ASSERT_GT(seconds, 0.0);
    EXPECT_TRUE(piloted(c, seconds / (0.9 * most)).usable()) << piloted(c, seconds / (0.9 * most)).pruned;
    const Candidate given_up = piloted(c, seconds / (1.1 * most));
    EXPECT_TRUE(given_up.pruned.starts_with("with h = ")) << given_up.pruned;
    EXPECT_FALSE(given_up.untried);
  }
}

// Each reading of this clock takes ten milliseconds. One run is affordable, one of twice the steps is not: two more.
TEST(PilotPrefix, LeavesAMethodUntriedWhoseSecondRunTakesTooLong) {
  const TradeoffScene scene = chain_scene(8, 64.0);
  const auto clock = [] { return CpuClock([t = std::int64_t{0}]() mutable { return t += 10'000'000; }); };
  // the readings of a run of 64 and of 128 steps over the prefix
  const auto seconds = [&](std::uint64_t steps) {
    const CpuClock ten = clock();
    return 1e-9 * static_cast<double>(
                      run_timed(scene, *make_integrator("verlet"), {.steps = steps}, ten, {.checkpoints = 2}).cpu_ns);
  };
  const double h = scene.duration / 64.0;
  ASSERT_LT(seconds(64), seconds(128));
  RecommendOptions options;
  options.most_pilot_s = 0.5 * (seconds(64) + seconds(128));
  const CpuClock ten = clock();
  Pilots pilots(scene, ten, options, ten());
  Candidate c = candidate("verlet", false);
  pilot_prefix(c, pilots, h, 1e-9, 1e-9);
  EXPECT_EQ(c.pruned, "its pilots take too long");
  EXPECT_TRUE(c.untried);
  EXPECT_EQ(c.confidence, Confidence::none);
}

// The machine is suspended for an hour in the second run: the rest of that run is no pilot.
TEST(PilotPrefix, TakesNoErrorsFromARunThatWasGivenUp) {
  const TradeoffScene scene = chain_scene(8, 64.0);
  const RecommendOptions options;
  std::uint64_t looks = 0, suspended_at = std::numeric_limits<std::uint64_t>::max();
  const CpuClock clock = [&] {
    ++looks;
    return static_cast<std::int64_t>(looks * 1'000'000 + (looks >= suspended_at ? 3'600'000'000'000u : 0u));
  };
  std::uint64_t after_first = 0, after_second = 0;
  {
    Pilots pilots(scene, clock, options, clock());
    pilots.run(candidate("verlet", false), scene, {.steps = 64}, 2);
    after_first = looks;
    pilots.run(candidate("verlet", false), scene, {.steps = 128}, 2);
    after_second = looks;
  }
  // the forces are timed with two readings before and after a run, whose first and last readings are its start and end
  ASSERT_LT(after_first + 4, after_second - 3);
  for (suspended_at = after_first + 4; suspended_at < after_second - 2; ++suspended_at) {
    looks = 0;
    Pilots pilots(scene, clock, options, clock());
    Candidate c = candidate("verlet", false);
    pilot_prefix(c, pilots, scene.duration / 64.0, 1e-9, 1e-9);
    EXPECT_EQ(c.pruned, "its pilots take too long") << suspended_at;
    EXPECT_TRUE(c.untried) << suspended_at;
    EXPECT_EQ(c.confidence, Confidence::none) << suspended_at;
  }
}

TEST(PilotPrefix, SeesTheOrderOfAMethodAndItsErrors) {
  const Candidate c = piloted(candidate("verlet", false), std::numeric_limits<double>::infinity());
  ASSERT_TRUE(c.usable()) << c.pruned;
  EXPECT_EQ(c.confidence, Confidence::asymptotic);
  EXPECT_NEAR(c.observed_order, 2.0, 0.3);
  EXPECT_EQ(c.slope, 2.0);
  EXPECT_EQ(c.step_evaluations, 1.0);
  EXPECT_GT(c.error_at_pilot, 0.0);
  double before_h = c.pilot_h, before_error = c.error_at_pilot;
  for (const Candidate::Seen& seen : c.coarser) {
    EXPECT_DOUBLE_EQ(seen.h, 2.0 * before_h);
    EXPECT_GT(seen.error, before_error);
    before_h = seen.h;
    before_error = seen.error;
  }
  EXPECT_FALSE(c.coarser.empty());
}

// Steps so short that rounding is all that two runs differ by.
TEST(PilotWhole, LeavesAMethodOutWhoseErrorsDoNotFall) {
  const TradeoffScene scene = chain_scene(8, 8.0);
  const CpuClock clock = [t = std::int64_t{0}]() mutable { return t += 1'000'000; };
  RecommendOptions options;
  options.most_pilot_s = 100.0;
  Pilots pilots(scene, clock, options, clock());
  Candidate c = candidate("rk4", false);
  c.order = 4;
  pilot_whole(c, pilots, 2e-3 / scene.fastest_rate, 1e-300);
  EXPECT_TRUE(c.pruned.starts_with("its errors do not fall with the step: ")) << c.pruned;
  EXPECT_FALSE(c.untried);
  EXPECT_FALSE(c.full_length);
}

TEST(FirstPart, EndsEarlierAndHasTheEventsBeforeItsEnd) {
  TradeoffScene scene = chain_scene(4, 8.0, 4);
  const double t = scene.duration;
  for (const double part : {0.25, 0.5, 0.75}) scene.motion.events.push_back({part * t, scene.motion.network, {}});
  const TradeoffScene half = first_part(scene, 0.5, 5);
  EXPECT_EQ(half.duration, 0.5 * t);
  ASSERT_EQ(half.motion.events.size(), 1u);  // one at the very end changes nothing
  EXPECT_EQ(half.motion.events[0].time, 0.25 * t);
  ASSERT_EQ(half.motion.checkpoints.size(), 5u);
  for (std::size_t c = 0; c < 5; ++c)
    EXPECT_DOUBLE_EQ(half.motion.checkpoints[c], 0.1 * t * static_cast<double>(c + 1));
  EXPECT_FALSE(half.closed_form);
}

TEST(WholeSteps, AreAtMostAsLongAsAskedAndAsManyInEveryInterval) {
  const TradeoffScene scene = chain_scene(4, 8.0, 4);
  EXPECT_EQ(whole_steps(scene, scene.duration), 4u);
  EXPECT_EQ(whole_steps(scene, scene.duration / 4), 4u);
  EXPECT_EQ(whole_steps(scene, 0.99 * scene.duration / 4), 8u);
  EXPECT_EQ(whole_steps(scene, scene.duration / 10.0), 12u);
}

// Masses 1 and 3 and a fixed one of 0: edges of 2.
TEST(Differences, AreMassWeightedInEdgesAtTheCheckpointsThatBothReached) {
  TradeoffScene scene{.name = "", .what = "", .motion = {}};
  scene.motion.network.mass = {1.0, 3.0};
  scene.motion.checkpoints = {1.0, 2.0};
  scene.edge = 2.0;
  const auto run = [](double y) {
    TimedRun made;
    made.states.assign(2, {{{0, y, 0}, {1, 0, 0}}, {{0, 0, 0}, {0, 0, 0}}});
    return made;
  };
  TimedRun shorter = run(0.5);
  shorter.states.pop_back();
  EXPECT_EQ(differences(scene, run(0.0), run(0.5)), (std::vector{0.125, 0.125}));  // sqrt(0.25 / 4) / 2
  EXPECT_EQ(differences(scene, run(0.0), shorter), (std::vector{0.125}));
}

TEST(DistanceFromStart, IsThatOfTheFarthestPointInEdges) {
  TradeoffScene scene{.name = "", .what = "", .motion = {}};
  scene.motion.start = {{{0, 0, 0}, {1, 0, 0}}, {{0, 0, 0}, {0, 0, 0}}};
  scene.edge = 2.0;
  TimedRun run;
  run.states = {{{{0, 3, 0}, {1, 0, 0}}, {}}, {{{0, 0, 0}, {1, 0, -8}}, {}}, {{{0, 1, 0}, {1, 0, 0}}, {}}};
  EXPECT_EQ(distance_from_start(scene, run), 4.0);
  run.states[0].x[0].x() = std::nan("");
  EXPECT_TRUE(std::isnan(distance_from_start(scene, run)));
}

TEST(Pilots, HaveAFloorAndAPartOfTheCheapestRunLessWhatTheyHaveSpent) {
  const TradeoffScene scene = chain_scene(4, 8.0, 4);
  std::int64_t now = 0;
  const CpuClock clock = [&now] { return now; };
  RecommendOptions options;
  options.pilot_floor_s = 0.25;
  options.pilot_part = 0.125;
  options.most_pilot_s = 3.0;
  Pilots pilots(scene, clock, options, 0);
  now = 125'000'000;
  EXPECT_DOUBLE_EQ(pilots.spent_s(), 0.125);
  EXPECT_EQ(pilots.left_s(), 3.0);  // nothing is predicted
  pilots.predicted(16.0);
  EXPECT_DOUBLE_EQ(pilots.left_s(), 0.25 + 2.0 - 0.125);
  pilots.predicted(8.0);
  pilots.predicted(24.0);  // the cheapest counts
  EXPECT_EQ(pilots.cheapest_s(), 8.0);
  EXPECT_DOUBLE_EQ(pilots.left_s(), 0.25 + 1.0 - 0.125);
}

TEST(Pilots, HaveTheirBudgetAndNoMoreWhateverIsPredicted) {
  const TradeoffScene scene = chain_scene(4, 8.0, 4);
  std::int64_t now = 0;
  const CpuClock clock = [&now] { return now += 1000; };
  RecommendOptions options;
  options.budget_s = 0.75;
  Pilots pilots(scene, clock, options, 0);
  now = 250'000'000 - 1000;
  EXPECT_DOUBLE_EQ(pilots.left_s(), 0.5);
  pilots.predicted(1e6);
  now = 250'000'000 - 1000;
  EXPECT_DOUBLE_EQ(pilots.left_s(), 0.5);
  now = 1'000'000'000 - 1000;
  EXPECT_DOUBLE_EQ(pilots.left_s(), -0.25);
}

TEST(Pilots, TimeTheForcesForLessWhereTheBudgetIsSmall) {
  const TradeoffScene scene = chain_scene(4, 8.0, 4);
  const CpuClock clock = ticking();
  const auto timing = [&](double budget) {
    RecommendOptions options;
    options.budget_s = budget;
    return Pilots(scene, clock, options, 0).timing_s();
  };
  EXPECT_EQ(timing(0.0), 5e-4);
  EXPECT_EQ(timing(10.0), 5e-4);
  EXPECT_DOUBLE_EQ(timing(0.04), 1e-4);
  EXPECT_EQ(timing(1e-6), 2e-5);
}

// A chain is linear, and errors of phase grow with time: the error of a prefix has to be extrapolated to the whole.
TEST(PilotFar, FindsThatTheErrorsOfALongChainGrowWithTime) {
  const TradeoffScene scene = chain_scene(8, 2e4);
  const CpuClock clock = ticking();
  RecommendOptions options;
  options.budget_s = 2e-3;
  Pilots pilots(scene, clock, options, clock());
  Candidate c = candidate("verlet", false);
  pilot_prefix(c, pilots, 0.05 / scene.fastest_rate, 1e-6, 1e-9);
  ASSERT_TRUE(c.usable()) << c.pruned;
  EXPECT_LT(c.seen_part, 0.1);
  const double seen = c.seen_part;
  c.h = c.pilot_h;
  c.predicted_s = 0.3e-3 * 0.5 / (3.0 * seen);  // so much that some times the prefix is affordable
  ASSERT_EQ(pilot_far(c, pilots), Longer::confirmed);
  EXPECT_GT(c.seen_part, 1.5 * seen);
  EXPECT_EQ(c.growth_rate, 0.0);
  const auto verlet = make_integrator("verlet");
  const auto steps = whole_steps(scene, c.pilot_h);
  const TimedRun run = run_timed(scene, *verlet, {.steps = steps}, clock);
  const double actual = reference::motion_errors(scene.motion, run.states, scene.closed_form()).x;
  EXPECT_GT(c.error_at(run.h), 0.4 * actual);
  EXPECT_LT(c.error_at(run.h), 3.0 * actual);
}

// Late parts of a motion are in no prefix of it; of a run of a millisecond the whole can be seen.
TEST(PilotLonger, SeesTheWholeOfAShortRunThoughTheTimeIsUp) {
  const TradeoffScene scene = chain_scene(8, 64.0);
  const CpuClock ticks = ticking();
  std::int64_t gone = 0;
  const CpuClock clock = [&] { return ticks() + gone; };
  const RecommendOptions options;
  Pilots pilots(scene, clock, options, clock());
  Candidate c = candidate("verlet", false);
  pilot_prefix(c, pilots, 0.5 / scene.fastest_rate, 1e-9, 1e-9);
  ASSERT_TRUE(c.usable()) << c.pruned;
  ASSERT_LT(c.seen_part, 0.5);
  c.limit_h = 0.5 / scene.fastest_rate;
  c.h = c.pilot_h;
  c.predicted_s = 1e-3;
  pilots.predicted(c.predicted_s);
  gone = 10'000'000'000;
  ASSERT_LT(pilots.left_s(), 0.0);
  EXPECT_EQ(pilot_longer(c, pilots), Longer::confirmed);
  EXPECT_TRUE(c.full_length);
  c.predicted_s = 1.0;  // of a long run it cannot
  EXPECT_EQ(pilot_longer(c, pilots), Longer::skipped);
}

// A sheet that crumples after its last cut: errors there are a thousand times those of the prefix, and do not fall by
// any
// order before steps are ten times shorter than the prefix asks for.
TEST(PilotLonger, GoesOnWhereLateErrorsAreFarFromThoseOfThePrefix) {
  const TradeoffScene scene = scene_of_file(read_scene(source_folder() / "benchmarks/scenes/sheet_cut.json"));
  // faster than `ticking`, so that runs are repeated less often
  const CpuClock clock = [t = std::int64_t{0}]() mutable { return t += 100'000; };
  const RecommendOptions options;
  Pilots pilots(scene, clock, options, clock());
  Candidate c = candidate("rk4", false);
  c.order = 4;
  pilot_prefix(c, pilots, 1e-3, 1e-9, 1e-4);
  ASSERT_TRUE(c.usable()) << c.pruned;
  c.limit_h = 1.7e-3;
  c.h = c.pilot_h;
  c.predicted_s = 1e-3;
  pilots.predicted(c.predicted_s);
  const auto rk4 = make_integrator("rk4");
  const TimedRun run = run_timed(scene, *rk4, {.steps = 4000}, clock);
  const double actual = max_or_nan(differences(scene, run, run_timed(scene, *rk4, {.steps = 8000}, clock)));
  ASSERT_LT(100.0 * c.error_at(run.h), actual);
  EXPECT_EQ(pilot_longer(c, pilots), Longer::confirmed);
  EXPECT_GT(c.error_at(run.h), 0.5 * actual);
  EXPECT_LT(c.error_at(run.h), 4.0 * actual);
}

TEST(PilotCheckpoints, AreAQuarterOrUpToTheOneAfterTheFirstEvent) {
  TradeoffScene scene{.name = "", .what = "", .motion = {}};
  for (int c = 1; c <= 16; ++c) scene.motion.checkpoints.push_back(c);
  EXPECT_EQ(pilot_checkpoints(scene), 4u);
  scene.motion.events.push_back({2.5, {}, {}});
  scene.motion.events.push_back({9.5, {}, {}});
  EXPECT_EQ(pilot_checkpoints(scene), 4u);
  scene.motion.events[0].time = 6.0;  // the state at 6 s is that before it
  EXPECT_EQ(pilot_checkpoints(scene), 7u);
  scene.motion.events.clear();
  scene.motion.checkpoints.resize(3);
  EXPECT_EQ(pilot_checkpoints(scene), 2u);
  scene.motion.checkpoints.resize(1);
  EXPECT_EQ(pilot_checkpoints(scene), 1u);
}

TEST(GrowthWithTime, IsThePowerThatTheLargestErrorFollows) {
  const std::vector<double> times{1, 2, 3, 4, 5, 6, 7, 8};
  for (const double power : {0.5, 1.0, 1.5, 2.0}) {
    std::vector<double> errors;
    for (std::size_t k = 0; k < 5; ++k) errors.push_back(1e-3 * std::pow(times[k], power));
    EXPECT_NEAR(growth_with_time(errors, times), power, 1e-12);  // though there are later times
  }
  EXPECT_EQ(growth_with_time({1, 1, 1, 1}, times), 0.5);
  EXPECT_EQ(growth_with_time({1, 16, 256, 4096}, times), 2.0);
  EXPECT_EQ(growth_with_time({1.0}, times), 1.0);
  EXPECT_EQ(growth_with_time({0, 0, 0, 1}, times), 1.0);
}

}  // namespace
}  // namespace dartboard::pilots_test
