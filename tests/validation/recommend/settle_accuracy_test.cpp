#include "validation/recommend/settle_accuracy.h"
#include "benchmarks/checkout/source_folder.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/plain/error.h"
#include "core/scene/run/scene_run.h"
#include "core/scene/run/scene_verdict.h"
#include "tests/support/moving_box.h"
#include "validation/recommend/recommended_scene.h"

namespace dartboard::settle_accuracy_test {
namespace {

using namespace moving;

/// A clock that advances by a millisecond at each reading: the same choices on every machine.
CpuClock ticking() {
  return [t = std::int64_t{0}]() mutable { return t += 1'000'000; };
}

Json accurate_box(double accuracy) {
  Json scene = moving_box();
  scene.erase("step");
  scene["duration"] = 0.1;
  scene["accuracy"] = accuracy;
  return scene;
}

TEST(StepFittingTimes, DividesTheDuration) {
  SceneFile scene = parse(accurate_box(1e-3));
  EXPECT_EQ(step_fitting_times(scene, 0.05), 0.1 / 2);
  EXPECT_EQ(step_fitting_times(scene, 0.04), 0.1 / 3);
  EXPECT_EQ(step_fitting_times(scene, 3.0), 0.1);
}

TEST(StepFittingTimes, DividesTheTimesOfOutputToo) {
  Json json = with_events(accurate_box(1e-3), R"([{"at": 0.03, "remove": {"ids": [5]}}])");
  json["output"] = {{"frames_every", 0.02}};
  SceneFile scene = parse(json);
  EXPECT_EQ(step_fitting_times(scene, 0.012), 0.1 / 10);
  EXPECT_EQ(step_fitting_times(scene, 0.0099), 0.1 / 15);
  // a time that no number of steps meets costs no steps
  scene.output.frame_time = 0.0314159265358979;
  EXPECT_EQ(step_fitting_times(scene, 0.012), 0.1 / 9);
}

TEST(SettleAccuracy, IsMetByBodiesThatHaveMoreThanSprings) {
  const char* const patches[] = {
      R"({"material": {"stiffness": null, "young": 3000, "poisson": 0.3, "damping": null}})",
      R"({"material": {"stiffness": null, "young": 3000, "poisson": 0.3, "damping": null},
          "body": {"generate": {"box": {"kind": "hexahedra", "pattern": null}}}})",
      R"({"body": {"generate": {"chain": {"links": 4, "spacing": 0.125}, "box": null}}, "fixed": [{"ids": [0]}]})",
      R"({"driven": [{"plane": {"point": [0, 0, 0], "normal": [-1, 0, 0]}, "velocity": [0.5, 0, 0], "from": 0.0077, "reverse_every": 0.02525}]})",
      R"({"forces": [{"plane": {"point": [0, 0, 0], "normal": [-1, 0, 0]}, "force": [20, 0, 0], "from": 0.0031, "until": 0.04975}],
          "events": [{"at": 0.01975, "remove": {"ids": [5]}}]})"};
  for (const char* patch : patches) {
    Json json = accurate_box(1e-3);
    json.merge_patch(Json::parse(patch));
    SceneFile scene = parse(json), fine = scene;
    ASSERT_TRUE(settle_accuracy(scene, ticking()));
    fine.integrator = "blanes-moan-4";
    fine.step = 0.1 / 4000;  // which all times of these scenes are multiples of
    Simulation simulation(scene), certain(fine);
    run(simulation);
    run(certain);
    const auto &x = simulation.body().vertices().position, &exact = certain.body().vertices().position;
    ASSERT_EQ(x.size(), exact.size());
    double sum = 0.0;
    for (std::size_t k = 0; k < x.size(); ++k) sum += (x[k] - exact[k]).squaredNorm();
    EXPECT_LT(std::sqrt(sum / static_cast<double>(x.size())), 2e-3 * 0.15) << patch;
  }
}

TEST(SettleAccuracy, ChoosesAStepAndAnIntegratorThatMeetIt) {
  SceneFile scene = parse(accurate_box(1e-4)), fine = scene;
  const auto settled = settle_accuracy(scene, ticking());
  ASSERT_TRUE(settled);
  EXPECT_EQ(scene.step, settled->step);
  EXPECT_EQ(scene.integrator, settled->integrator);
  EXPECT_FALSE(settled->integrator_named);
  EXPECT_LE(settled->step, settled->recommended_step);
  Simulation simulation(scene);
  run(simulation);
  // a run of order 4 with h omega of 0.02 or so is off by its fourth power at most, 2e-7
  fine.integrator = "blanes-moan-4";
  fine.step = 0x1p-12 * 0.1;
  Simulation certain(fine);
  run(certain);
  for (std::size_t k = 0; k < 27; ++k)
    EXPECT_LT((simulation.body().vertices().position[k] - certain.body().vertices().position[k]).norm(),
              2e-4 * 0.125)  // twice the root mean square over all
        << k;
  EXPECT_NE(to_string(*settled).find(scene.integrator), std::string::npos);
  EXPECT_EQ(nlohmann::json(*settled).at("step"), scene.step);
  // the members that are printed to be pasted make a scene of the same step, to the last bit
  const std::string said = to_string(*settled);
  const auto from = said.find("\"integrator\": ");
  ASSERT_NE(from, std::string::npos) << said;
  const Json pasted = Json::parse("{" + said.substr(from, said.find('\n', from) - from) + "}");
  EXPECT_EQ(pasted.at("step").get<double>(), scene.step);
  EXPECT_EQ(pasted.at("integrator"), scene.integrator);
}

// Frames at times that the recommended step does not meet shorten it, and the promise is for the shorter one.
TEST(SettleAccuracy, PromisesTheErrorOfTheStepThatIsTaken) {
  Json json = accurate_box(1e-3);
  json["integrator"] = "verlet";
  SceneFile plain = parse(json);
  const auto alone = settle_accuracy(plain, ticking());
  json["output"] = {{"frames_every", 0.1 * 7 / 128}};
  SceneFile timed = parse(json);
  const auto fitted = settle_accuracy(timed, ticking());
  ASSERT_TRUE(alone && fitted);
  EXPECT_EQ(fitted->recommended_step, alone->recommended_step);
  ASSERT_LT(fitted->step, 0.97 * alone->step);
  // the order is 2, and an observed one is between half of that and that
  const double power =
      std::log(fitted->predicted_error / alone->predicted_error) / std::log(fitted->step / alone->step);
  EXPECT_GT(power, 0.9);
  EXPECT_LT(power, 2.1);
  EXPECT_GT(fitted->predicted_s, alone->predicted_s);
}

TEST(SettleAccuracy, KeepsTheIntegratorThatTheSceneNames) {
  Json json = accurate_box(1e-3);
  json["integrator"] = "verlet";
  SceneFile scene = parse(json);
  const auto settled = settle_accuracy(scene, ticking());
  EXPECT_EQ(scene.integrator, "verlet");
  EXPECT_TRUE(settled->integrator_named);
}

TEST(SettleAccuracy, RefusesWhatDoublesCannotMeet) {
  for (const double accuracy : {1e-17, 1e-30}) {
    SceneFile scene = parse(accurate_box(accuracy));
    try {
      settle_accuracy(scene, ticking());
      ADD_FAILURE() << "settled on " << scene.integrator << " with " << scene.step;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("/accuracy: is"), std::string::npos) << error.what();
      EXPECT_NE(std::string(error.what()).find("cannot be met in double precision"), std::string::npos) << error.what();
    }
  }
}

TEST(SettleAccuracy, LeavesASceneWithAStepAlone) {
  SceneFile scene = parse(moving_box());
  EXPECT_FALSE(settle_accuracy(scene, ticking()));
  EXPECT_EQ(scene.step, 0.001);
}

TEST(SettleAccuracy, SettlesASceneThatDoesNotMove) {
  Json json = accurate_box(1e-3);
  json["duration"] = 0;
  SceneFile scene = parse(json);
  EXPECT_TRUE(settle_accuracy(scene, ticking()));
  EXPECT_EQ(Simulation(scene).step_count(), 0u);
}

TEST(SettleAccuracy, ScenesOfTheProjectThatAskForOneEndAsTheyExpect) {
  namespace fs = std::filesystem;
  std::size_t count = 0;
  for (const auto& entry : fs::directory_iterator(source_folder() / "benchmarks" / "scenes")) {
    SceneFile scene = read_scene(entry.path());
    if (!settle_accuracy(scene, ticking())) continue;
    ++count;
    EXPECT_FALSE(scene.expect.empty()) << entry.path();
    EXPECT_FALSE(scene.expect.hash) << entry.path() << ": the step depends on the machine";
    Simulation simulation(scene);
    RunWatcher nobody;
    const RunResult result = run_scene(simulation, scene.output, nobody);
    for (const ExpectedRow& row : compare_with_expectation(scene, simulation, result))
      EXPECT_TRUE(row.holds) << entry.path() << ": " << row.what << " is " << row.actual;
  }
  EXPECT_GE(count, 1u);
}

}  // namespace
}  // namespace dartboard::settle_accuracy_test
