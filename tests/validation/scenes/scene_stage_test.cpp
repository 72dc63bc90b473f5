// Runs through events: when they take place, and what the checkpoints show.

#include "validation/scenes/scene_stage.h"

#include <gtest/gtest.h>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "core/time/integrators.h"

namespace dartboard::scene_stage_test {
namespace {

/// A box that is cut in two; four checkpoints in one second.
TradeoffScene box_cut_at(double time) {
  TableScene scene{.name = "box", .problem = {}, .checkpoints = 4};
  scene.problem.mesh = kuhn_box(2, 2, 2, 0.5, 0.2, 1);
  scene.problem.surroundings.gravity = {0, 0.25, -0.5};  // the default pulls these springs flat
  scene.problem.fixed = {0};
  add_cut(scene, time, {0.5, 0.5, 0.5}, {1, 0, 0});
  return tradeoff_scene({}, scene);
}

// Records the steps that it is asked to take, and the numbers of vertices.
class Recorder : public Integrator {
 public:
  const Scheme& scheme() const override {
    static const Scheme scheme = scheme_of("verlet");
    return scheme;
  }
  StepResult step(const SpringSystem& system, Motion, double h) override {
    if (steps.size() == fail_at) return {StepCode::newton_stalled, Witness::none, 0, "residual", 1.0};
    steps.push_back(h);
    vertices.push_back(system.vertex_count());
    ++work_.steps;
    return {};
  }
  void restart() override { restarts.push_back(steps.size()); }

  std::vector<double> steps;
  std::vector<std::size_t> vertices, restarts;
  std::size_t fail_at = 1000;
};

TEST(RunTimed, DividesTheStepThatAnEventIsWithinAsASimulationDoes) {
  const TradeoffScene scene = box_cut_at(0.3);
  Recorder recorder;
  const TimedRun run = run_timed(scene, recorder, {.steps = 8}, no_clock);
  const std::vector<double> expected{0.125, 0.125, 0.05, 0.075, 0.125, 0.125, 0.125, 0.125, 0.125};
  ASSERT_EQ(recorder.steps.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(recorder.steps[k], expected[k], 1e-15) << k;
  EXPECT_EQ(recorder.restarts, (std::vector<std::size_t>{0, 3}));
  EXPECT_EQ(recorder.vertices[2], scene.motion.network.point_count());
  EXPECT_EQ(recorder.vertices[3], scene.motion.events[0].network.point_count());
  EXPECT_EQ(run.work.steps, expected.size());
  EXPECT_EQ(run.states.size(), 4u);
}

TEST(RunTimed, TakesAnEventAtTheEndOfTheStepThatReachesIt) {
  const TradeoffScene scene = box_cut_at(0.3);
  Recorder recorder;
  run_timed(scene, recorder, {.steps = 8, .timing = EventTiming::end_of_step}, no_clock);
  EXPECT_EQ(recorder.steps, std::vector<double>(8, 0.125));
  EXPECT_EQ(recorder.restarts, (std::vector<std::size_t>{0, 3}));
  EXPECT_EQ(recorder.vertices[3], scene.motion.events[0].network.point_count());
}

TEST(RunTimed, HasTwiceAsManyStepsInEachIntervalWithStepsInTwoParts) {
  const TradeoffScene scene = box_cut_at(0.3);
  Recorder whole, halves;
  run_timed(scene, whole, {.steps = 8}, no_clock);
  const TimedRun run = run_timed(scene, halves, {.steps = 8, .parts = 2}, no_clock);
  EXPECT_EQ(run.h, 0.0625);
  EXPECT_EQ(halves.restarts, (std::vector<std::size_t>{0, 6}));
  ASSERT_EQ(halves.steps.size(), 2 * whole.steps.size());
  for (std::size_t k = 0; k < halves.steps.size(); ++k)
    EXPECT_NEAR(halves.steps[k], whole.steps[k / 2] / 2, 1e-15) << k;
}

TEST(RunTimed, KeepsTheLengthOfStepsOnlyWhereTheyEndAtCheckpoints) {
  const TradeoffScene scene = box_cut_at(0.3);
  Recorder recorder;
  EXPECT_THROW(run_timed(scene, recorder, {.steps = 9, .timing = EventTiming::end_of_step}, no_clock), InputError);
  EXPECT_THROW(run_timed(scene, *make_integrator("dormand-prince-54"),
                         {.tolerance = 1e-6, .timing = EventTiming::end_of_step}, no_clock),
               InputError);
}

TEST(RunTimed, ShowsTheStateBeforeAnEventAtACheckpoint) {
  const TradeoffScene scene = box_cut_at(0.5);
  for (const EventTiming timing : {EventTiming::split_step, EventTiming::end_of_step}) {
    Recorder recorder;
    const TimedRun run = run_timed(scene, recorder, {.steps = 8, .timing = timing}, no_clock);
    ASSERT_EQ(run.states.size(), 4u);
    for (std::size_t c = 0; c < 4; ++c)
      EXPECT_EQ(run.states[c].x.size(), scene.motion.network_of(scene.motion.interval_at(c)).point_count()) << c;
    EXPECT_EQ(run.states[1].x.size(), scene.motion.network.point_count());
    EXPECT_EQ(recorder.steps, std::vector<double>(8, 0.125));
  }
}

TEST(RunTimed, EndsWithTheFirstStepThatIsNotOk) {
  Recorder recorder;
  recorder.fail_at = 5;
  const TimedRun run = run_timed(box_cut_at(0.75), recorder, {.steps = 8}, no_clock);
  EXPECT_EQ(run.result.code, StepCode::newton_stalled);
  EXPECT_EQ(run.states.size(), 2u);
  EXPECT_EQ(recorder.steps.size(), 5u);
}

TEST(RunTimed, GoesThroughEventsInStepsThatTheIntegratorChooses) {
  const TradeoffScene scene = box_cut_at(0.3);
  const auto integrator = make_integrator("dormand-prince-54");
  const TimedRun fine = run_timed(scene, *integrator, {.steps = 512}, no_clock),
                 run = run_timed(scene, *integrator, {.tolerance = 1e-10}, no_clock);
  ASSERT_TRUE(run.result.ok());
  ASSERT_EQ(run.states.size(), 4u);
  EXPECT_LT(run.work.steps, 512u);
  for (std::size_t c = 0; c < 4; ++c) {
    ASSERT_EQ(run.states[c].x.size(), fine.states[c].x.size());
    // fewer than 512 steps, each off by 1e-10 or so
    for (std::size_t i = 0; i < run.states[c].x.size(); ++i)
      EXPECT_LT((run.states[c].x[i] - fine.states[c].x[i]).norm(), 512 * 1e-10);
  }
}

}  // namespace
}  // namespace dartboard::scene_stage_test
