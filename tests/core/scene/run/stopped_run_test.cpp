// A run whose step is given up ends in the state before it.

#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "core/scene/run/scene_run.h"
#include "core/time/solve/stop_request.h"
#include "tests/support/moving_box.h"

namespace dartboard::stopped_run_test {
namespace {

using namespace moving;

int looks_left = 0;
bool after_some_looks() { return --looks_left < 0; }

struct Times : RunWatcher {
  std::vector<double> frames, diagnosed, probed;
  void frame(const Frame& frame) override { frames.push_back(frame.time); }
  void diagnostics(const Diagnostics& d) override { diagnosed.push_back(d.time); }
  void probes(const ProbeRow& row) override { probed.push_back(row.time); }
};

SceneFile implicit_scene() {
  Json scene = moving_box();
  scene["integrator"] = "backward-euler";
  scene["output"] = Json::parse(R"({"frames_every": {"steps": 2}, "diagnostics_every": {"steps": 3}})");
  return parse(scene);
}

/// Stopped when the check for a stop has been called so many times.
RunResult stopped_run(Simulation& simulation, const SceneFile& scene, int looks, Times& times) {
  looks_left = looks;
  const StopRequest request(after_some_looks);
  return run_scene(simulation, scene.output, times);
}

TEST(StoppedRun, KeepsTheStateOfTheLastStepThatWasTaken) {
  const SceneFile scene = implicit_scene();
  for (int looks = 1; looks < 12; looks += 2) {
    Simulation stopped(scene), whole(scene);
    Times times, unused;
    const RunResult result = stopped_run(stopped, scene, looks, times);
    ASSERT_TRUE(result.interrupted);
    ASSERT_FALSE(result.divergence);
    const std::uint64_t n = stopped.steps_done();
    ASSERT_LT(n, stopped.step_count());
    run_scene(whole, scene.output, unused, n);
    EXPECT_EQ(stopped.body().state_hash(), whole.body().state_hash()) << n << " steps";
  }
}

// The changes of contact to the velocities before the step are undone, and obstacles and losses are restored.
TEST(StoppedRun, UndoesWhatContactHasBegun) {
  Json json = moving_box();
  json["integrator"] = "backward-euler";
  json["contact"] = Json::parse(R"({"pressure": 2000, "depth": 0.01, "restitution": 0.3, "friction": 0.4,
    "obstacles": [{"plane": {"point": [0, 0, 0.001], "normal": [0, 0, 1]}, "velocity": [0.2, 0, 0.1]}]})");
  const SceneFile scene = parse(json);
  for (int looks = 1; looks < 12; looks += 2) {
    Simulation stopped(scene), whole(scene);
    Times times, unused;
    const RunResult result = stopped_run(stopped, scene, looks, times);
    ASSERT_TRUE(result.interrupted);
    run_scene(whole, scene.output, unused, stopped.steps_done());
    EXPECT_EQ(stopped.body().state_hash(), whole.body().state_hash());
    EXPECT_EQ(diagnostics_row(stopped.diagnostics()), diagnostics_row(whole.diagnostics()));
    EXPECT_EQ(stopped.diagnostics().contact->damped > 0.0, stopped.steps_done() > 0);
  }
}

TEST(StoppedRun, HandsItsLastStateOutOnce) {
  const SceneFile scene = implicit_scene();
  std::set<std::uint64_t> seen;
  for (int looks = 0; looks < 16; ++looks) {
    Simulation simulation(scene);
    Times times;
    const RunResult result = stopped_run(simulation, scene, looks, times);
    ASSERT_TRUE(result.interrupted);
    const std::uint64_t n = simulation.steps_done();
    const auto expected = [n](std::uint64_t every) {
      std::vector<double> all;
      for (std::uint64_t k = 0; k <= n; k += every) all.push_back(0.001 * static_cast<double>(k));
      if (n % every != 0) all.push_back(0.001 * static_cast<double>(n));
      return all;
    };
    EXPECT_EQ(times.frames, expected(2)) << n;
    EXPECT_EQ(times.diagnosed, expected(3)) << n;
    EXPECT_EQ(times.probed, expected(3)) << n;
    EXPECT_EQ(result.last.time, times.diagnosed.back());
    seen.insert(n);
  }
  EXPECT_GT(seen.size(), 4u);
}

}  // namespace
}  // namespace dartboard::stopped_run_test
