// A run that diverges outputs its last good state, at its own time, and nothing after it.

#include <gtest/gtest.h>

#include <limits>
#include <optional>
#include <variant>
#include <vector>

#include "core/base/archive.h"
#include "core/scene/run/scene_run.h"
#include "tests/support/moving_box.h"

namespace dartboard::last_good_state_test {
namespace {

using namespace moving;

struct Keeper : RunWatcher {
  std::vector<Frame> frames;
  std::vector<double> times_of_diagnostics;
  void frame(const Frame& f) override { frames.push_back(f); }
  void diagnostics(const Diagnostics& d) override { times_of_diagnostics.push_back(d.time); }
};

/// Stable for a while, since its energy has to grow from rounding: the step is above the limit by a hundredth.
Json slowly_unstable() {
  Json json = moving_box();
  json["step"] = 1.01 * Simulation(parse(json)).step_limit().stable;
  json["duration"] = 1e4 * json["step"].get<double>();
  return json;
}

TEST(LastGoodState, IsTheLastFrame) {
  const SceneFile scene = parse(slowly_unstable());
  Simulation simulation(scene);
  Keeper keeper;
  const RunResult result = run_scene(simulation, scene.output, keeper);
  ASSERT_TRUE(result.divergence);
  const auto kept = static_cast<double>(result.divergence->step - result.divergence->taken_back) * scene.step;
  ASSERT_GT(kept, 0.0);
  ASSERT_EQ(keeper.frames.size(), 2u);
  EXPECT_EQ(keeper.frames[1].time, kept);
  EXPECT_EQ(keeper.frames[1].mesh.points, simulation.frame().mesh.points);
  EXPECT_EQ(keeper.times_of_diagnostics, (std::vector<double>{0.0, kept}));
  EXPECT_EQ(result.last.time, kept);
  EXPECT_EQ(simulation.time(), kept);

  Simulation again(scene);
  while (again.time() < kept) ASSERT_FALSE(again.advance()) << again.time();
  EXPECT_EQ(again.body().vertices().position, simulation.body().vertices().position);
}

TEST(LastGoodState, IsNotHandedOutAfterALaterOne) {
  Json json = slowly_unstable();
  json["output"] = {{"frames_every", {{"steps", 1}}}, {"diagnostics_every", {{"steps", 1}}}};
  const SceneFile scene = parse(json);
  Simulation simulation(scene);
  Keeper keeper;
  ASSERT_TRUE(run_scene(simulation, scene.output, keeper).divergence);
  for (std::size_t k = 1; k < keeper.frames.size(); ++k)
    ASSERT_GT(keeper.frames[k].time, keeper.frames[k - 1].time) << k;
}

// The body lies on a floor that rises, in the wind, and its step is too long. The state after the event is kept; sums
// are those of a run until there.
TEST(LastGoodState, HasItsOwnSums) {
  Json json = with_events(moving_box(), R"([{"at": 0.4, "remove": {"ids": [47]}}])");
  json["gravity"] = {0, 0, -1};
  json["initial_velocity"] = {0, 0, -0.5};
  json["contact"] = Json::parse(R"({"pressure": 400, "depth": 0.02, "restitution": 0.5, "friction": 0.3,
    "obstacles": [{"plane": {"point": [0, 0, -0.001], "normal": [0, 0, 1]}, "velocity": [0, 0, 0.01]}]})");
  json["air"] = Json::parse(R"({"drag": 100, "velocity": [1, 0, 0]})");
  json["integrator"] = "verlet";
  json["step"] = 0.04;
  json["duration"] = 40.0;
  const SceneFile scene = parse(json);
  Simulation simulation(scene), again(scene);
  while (!simulation.advance()) ASSERT_LT(simulation.steps_done(), 100u);
  EXPECT_GT(simulation.steps_done(), 10u);
  for (int n = 0; n < 10; ++n) ASSERT_FALSE(again.advance());
  const Diagnostics found = simulation.diagnostics(), right = again.diagnostics();
  EXPECT_EQ(found.time, right.time);
  EXPECT_GT(right.contact->damped, 0.0);
  EXPECT_EQ(found.contact->damped, right.contact->damped);
  EXPECT_GT(right.contact->rubbed, 0.0);
  EXPECT_EQ(found.contact->rubbed, right.contact->rubbed);
  EXPECT_GT(right.contact->supplied, 0.0);
  EXPECT_EQ(found.contact->supplied, right.contact->supplied);
  EXPECT_GT(*right.applied, 0.0);
  EXPECT_EQ(*found.applied, *right.applied);
}

TEST(LastGoodState, HasItsOwnLongestStep) {
  const SceneFile scene = parse(slowly_unstable());
  Simulation simulation(scene);
  std::optional<EarlyEnd> end;
  while (!(end = simulation.advance())) ASSERT_LT(simulation.steps_done(), 10000u);
  const auto& divergence = std::get<Divergence>(*end);
  EXPECT_DOUBLE_EQ(divergence.stable, simulation.step_limit().stable);
  EXPECT_LT(divergence.stable, scene.step);
}

TEST(LastGoodState, IsGoneBackToFromAStateWhoseFaultHasAUnit) {
  Divergence d;
  d.step = 12, d.time = 0.012, d.quantity = "speed", d.vertex = 3, d.value = 4.1e8;
  EXPECT_EQ(to_string(d), "diverged at step 12, t = 0.012 s: speed of vertex 3 is 4.1e+08 m/s: faster than light");
  d.quantity = "speed (UNSTABLE_DT)", d.value = 1.5;
  EXPECT_EQ(to_string(d),
            "diverged at step 12, t = 0.012 s: speed (UNSTABLE_DT) of vertex 3 is 1.5 m/s: there is more energy than "
            "anything in the scene supplies");
  d.quantity = "position (NONFINITE)", d.value = std::numeric_limits<double>::infinity();
  EXPECT_EQ(to_string(d), "diverged at step 12, t = 0.012 s: position (NONFINITE) of vertex 3 is inf m");
}

TEST(LastGoodState, WithinAStepHasItsOwnTime) {
  Json json = moving_box();
  const double h = 1.5 * Simulation(parse(json)).step_limit().stable;
  json["step"] = h;
  json["duration"] = 1000 * h;
  json["event_times"] = "exact";
  // the state that is kept last is that where the drive ends
  json["driven"] = Json::array({{{"ids", {0}}, {"velocity", {1, 0, 0}}, {"from", 0.4 * h}, {"until", 2.4 * h}}});
  const SceneFile scene = parse(json);
  Simulation simulation(scene);
  while (!simulation.advance()) ASSERT_LT(simulation.steps_done(), 1000u);
  EXPECT_NEAR(simulation.time(), 2.4 * h, 1e-12 * h);
  EXPECT_NEAR(simulation.frame().mesh.points[0].x(), 2.0 * h, 1e-12);

  Simulation again(scene);
  Archive archive;
  simulation.save(archive);
  Archive written(archive.written(), "state");
  again.load(written);
  EXPECT_EQ(again.time(), simulation.time());
}

}  // namespace
}  // namespace dartboard::last_good_state_test
