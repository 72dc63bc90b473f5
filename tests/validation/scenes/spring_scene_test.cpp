// Scenes of the studies in time: the networks that they pass to the oracle, and the times of their events.

#include "validation/scenes/spring_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "core/mechanics/adapt.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/operations/dissociate_all.h"
#include "core/plain/error.h"
#include "core/time/integrators.h"

namespace dartboard::spring_scene_test {
namespace {

SpringScene box() {
  SpringScene scene{"box", {}, {}, {}, 1.0, 4};
  scene.problem.mesh = kuhn_box(2, 2, 2, 0.5, 0.2, 1);
  scene.problem.surroundings.gravity = {0, 0.25, -0.5};  // the default pulls these springs flat
  scene.problem.fixed = {0};
  return scene;
}
TimedCut cut_at(double time) { return plane_cut(time, {0.5, 0.5, 0.5}, {1, 0, 0}); }
constexpr std::uint32_t inner = 13;  // the one point within the box

// By its ends, the sum of the parallel springs.
template <class Springs, class Ends>
std::map<std::pair<std::uint32_t, std::uint32_t>, double> stiffnesses(const Springs& springs, Ends&& ends) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, double> sums;
  for (std::size_t e = 0; e < springs.size(); ++e) sums[std::minmax(ends(e)[0], ends(e)[1])] += springs[e].stiffness;
  return sums;
}

TEST(SpringScene, HandsTheOracleTheMassesAndSpringsThatTheBodyHas) {
  SpringScene scene = box();
  scene.events = {cut_at(0.25), fan_tear(0.5, inner)};
  const PreparedScene prepared = prepare(scene);
  ASSERT_EQ(prepared.motion.events.size(), 2u);
  TetBody body = prepared.body;
  for (std::size_t interval = 0; interval <= 2; ++interval) {
    if (interval > 0) adapt(body, dissociate_all(body.map, std::span<const Dart>(prepared.faces[interval - 1])));
    const reference::SpringNetwork& network = prepared.motion.network_of(interval);
    ASSERT_EQ(network.point_count(), body.vertices.size());
    for (std::size_t k = 0; k < body.vertices.size(); ++k) {
      // up to 24 shares are added in another order
      EXPECT_NEAR(network.mass[k], body.vertices.mass[k], 24 * 0x1p-53 * body.vertices.mass[k]);
      EXPECT_EQ(network.fixed[k], body.vertices.fixed[k]);
    }
    SpringEndsView ends;
    ends.rebuild(body);
    const auto of_body = stiffnesses(body.springs, [&](std::size_t e) { return ends.ends[e]; });
    const auto of_network = stiffnesses(network.springs, [&](std::size_t e) {
      return SpringEnds{network.springs[e].a, network.springs[e].b};
    });
    EXPECT_EQ(of_body, of_network);  // whole multiples of 50
  }
  EXPECT_GT(prepared.motion.events[0].network.point_count(), prepared.motion.network.point_count());
  EXPECT_GT(prepared.motion.events[1].network.point_count(), prepared.motion.events[0].network.point_count());
}

TEST(SpringScene, TellsWhichPointEachPartCameFrom) {
  SpringScene scene = box();
  scene.events = {cut_at(0.25)};
  const PreparedScene prepared = prepare(scene);
  TetBody body = prepared.body;
  const std::vector<std::uint32_t> before = body.vertices.point;
  adapt(body, dissociate_all(body.map, std::span<const Dart>(prepared.faces[0])));
  const auto& from = prepared.motion.events[0].from;
  ASSERT_EQ(from.size(), body.vertices.size());
  for (std::size_t k = 0; k < from.size(); ++k) EXPECT_EQ(before[from[k]], body.vertices.point[k]);
}

TEST(SpringScene, StartsWhereItIsTold) {
  SpringScene scene = box();
  scene.initial_position = scene.problem.mesh.points;
  scene.initial_position[5][0] += 0.25;
  scene.problem.initial_velocity.assign(scene.initial_position.size(), {0, 0, 0});
  scene.problem.initial_velocity[6] = {0, 1, 0};
  const PreparedScene prepared = prepare(scene);
  for (std::size_t k = 0; k < prepared.body.vertices.size(); ++k) {
    const std::uint32_t point = prepared.body.vertices.point[k];
    EXPECT_EQ(prepared.motion.start.x[k], scene.initial_position[point]);
    EXPECT_EQ(prepared.motion.start.v[k], scene.problem.initial_velocity[point]);
    EXPECT_EQ(prepared.body.vertices.position[k], scene.initial_position[point]);
  }
  // the springs have the shape at rest, not that one
  EXPECT_EQ(reference::mean_rest_length(prepared.motion.network),
            reference::mean_rest_length(prepare(box()).motion.network));
}

// Records the steps that it is asked to take, and the numbers of vertices.
class Recorder : public Integrator {
 public:
  const Scheme& scheme() const override {
    static const Scheme scheme = make_integrator("verlet")->scheme();
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

TEST(SpringScene, SplitsTheStepAtAnEventThatIsNotAligned) {
  SpringScene scene = box();
  scene.events = {cut_at(0.3)};
  const PreparedScene prepared = prepare(scene);
  Recorder recorder;
  const SceneRun run = run_scene(prepared, recorder, 8);
  // steps of 1/8 to 0.25, one of 0.05, two of 0.1, and on: no step is longer, none shorter than it need be
  const std::vector<double> expected{0.125, 0.125, 0.05, 0.1, 0.1, 0.125, 0.125, 0.125, 0.125};
  ASSERT_EQ(recorder.steps.size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_NEAR(recorder.steps[k], expected[k], 1e-15) << k;
  EXPECT_EQ(recorder.restarts, (std::vector<std::size_t>{0, 3}));
  EXPECT_EQ(recorder.vertices[2], prepared.motion.network.point_count());
  EXPECT_EQ(recorder.vertices[3], prepared.motion.events[0].network.point_count());
  EXPECT_EQ(run.work.steps, expected.size());
  EXPECT_EQ(run.states.size(), 4u);
}

TEST(SpringScene, TakesAnEventAtTheEndOfTheStepThatReachesIt) {
  SpringScene scene = box();
  scene.events = {cut_at(0.3)};
  const PreparedScene prepared = prepare(scene);
  Recorder recorder;
  run_scene(prepared, recorder, 8, EventTiming::end_of_step);
  EXPECT_EQ(recorder.steps, std::vector<double>(8, 0.125));
  EXPECT_EQ(recorder.restarts, (std::vector<std::size_t>{0, 3}));
  EXPECT_THROW(run_scene(prepared, recorder, 9, EventTiming::end_of_step), InputError);
}

TEST(SpringScene, ShowsTheStateBeforeAnEventAtACheckpoint) {
  SpringScene scene = box();
  scene.events = {cut_at(0.5)};
  const PreparedScene prepared = prepare(scene);
  for (const EventTiming timing : {EventTiming::split_step, EventTiming::end_of_step}) {
    Recorder recorder;
    const SceneRun run = run_scene(prepared, recorder, 8, timing);
    ASSERT_EQ(run.states.size(), 4u);
    for (std::size_t c = 0; c < 4; ++c)
      EXPECT_EQ(run.states[c].x.size(), prepared.motion.network_of(prepared.motion.interval_at(c)).point_count()) << c;
    EXPECT_EQ(run.states[1].x.size(), prepared.motion.network.point_count());
    EXPECT_EQ(recorder.steps, std::vector<double>(8, 0.125));
  }
}

TEST(SpringScene, EndsWithTheFirstStepThatIsNotOk) {
  Recorder recorder;
  recorder.fail_at = 5;
  const SceneRun run = run_scene(prepare(box()), recorder, 8);
  EXPECT_EQ(run.result.code, StepCode::newton_stalled);
  EXPECT_EQ(run.states.size(), 2u);
  EXPECT_EQ(recorder.steps.size(), 5u);
}

TEST(SpringScene, IsRunByAnIntegratorThatChoosesItsSteps) {
  SpringScene scene = box();
  scene.events = {cut_at(0.3)};
  const PreparedScene prepared = prepare(scene);
  const auto fixed = make_integrator("dormand-prince-54"), chosen = make_integrator("dormand-prince-54");
  auto* adaptive = dynamic_cast<AdaptiveIntegrator*>(chosen.get());
  ASSERT_NE(adaptive, nullptr);
  const SceneRun fine = run_scene(prepared, *fixed, 512), run = run_scene(prepared, *adaptive, {1e-10, 1e-10});
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

TEST(SpringScene, RefusesEventsThatCannotBe) {
  SpringScene scene = box();
  scene.events = {cut_at(1.0)};
  EXPECT_THROW(prepare(scene), InputError);
  scene.events = {plane_cut(0.5, {9, 9, 9}, {1, 0, 0})};  // misses the body
  EXPECT_THROW(prepare(scene), InputError);
  scene.events = {fan_tear(0.5, 1000)};
  EXPECT_THROW(prepare(scene), InputError);
  scene.events = {cut_at(0.5), cut_at(0.25)};
  EXPECT_THROW(prepare(scene), InputError);
}

}  // namespace
}  // namespace dartboard::spring_scene_test
