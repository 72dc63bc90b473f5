// The longest stable step of a scene, from every part that reports one: one number, to the last bit.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "benchmarks/cli/scene_names.h"
#include "benchmarks/studies/scenes/step_explanation.h"
#include "core/plain/error.h"
#include "core/plain/random.h"
#include "core/scene/run/scene_run.h"
#include "core/time/integrators.h"
#include "core/time/watch/stable_step.h"
#include "tests/support/moving_box.h"
#include "validation/recommend/settle_accuracy.h"
#include "validation/scenes/scene_features.h"
#include "validation/scenes/scene_of_file.h"

namespace dartboard::step_agreement_test {
namespace {

using namespace moving;

/// A clock that advances by a millisecond at each reading: the same choices on every machine.
CpuClock ticking() {
  return [t = std::int64_t{0}]() mutable { return t += 1'000'000; };
}

/// The limits of the simulation, its warning, explain-dt and recommend. The step is so long that a warning is due.
void expect_one_limit(SceneFile scene) {
  scene.accuracy.reset();
  if (scene.integrator.empty()) scene.integrator = "rk4";
  const Scheme& scheme = scheme_of(scene.integrator);
  if (!(scene.step > 0.0)) scene.step = scene.duration / 16;
  const StepLimit limit = Simulation(scene).step_limit();
  const bool is_explained = !scene.has_contact();  // explain-dt refuses scenes with contact
  if (is_explained) {
    const StepExplanation explained = explain_step(scene);
    EXPECT_EQ(explained.limit.stable, limit.stable) << scene.file;
    EXPECT_EQ(explained.limit.unstable, limit.unstable) << scene.file;
  }
  SceneFile quiet = scene;
  quiet.events.clear();  // recommend also considers the bodies after events
  const TradeoffScene studied = scene_of_file(quiet);
  EXPECT_EQ(stability_limit(scheme, features_of(studied, ticking()), studied.duration),
            Simulation(quiet).step_limit().stable)
      << scene.file;
  // bodies after events may only shorten it, but are bracketed anew: to the last bit it is not the same bracket;
  // through contact, events that look at the body take an accurate run, half a minute for some scenes
  if (is_explained) {
    EXPECT_LE(stability_limit(scheme, features_of(scene_of_file(scene), ticking()), scene.duration),
              StableStepEstimate::excess * limit.stable)
        << scene.file;
  }
  if (!std::isfinite(limit.stable)) return;
  for (const double factor : {1.0, 1.0 + 1e-15, 1.5}) {
    SceneFile other = scene;
    other.step = factor * limit.stable;
    other.output = {};
    const Simulation simulation(other);
    EXPECT_EQ(simulation.step_warning().has_value(), factor > 1.0) << scene.file << ", " << factor;
    if (simulation.step_warning()) {
      EXPECT_EQ(simulation.step_warning()->stable, limit.stable) << scene.file << ", " << factor;
    }
    if (is_explained) {
      EXPECT_EQ(explain_step(other).limit.stable, limit.stable) << scene.file << ", " << factor;
    }
    other.unstable_step = UnstableStep::refuse;
    if (factor > 1.0)
      EXPECT_THROW(Simulation{other}, InputError) << scene.file << ", " << factor;
    else
      EXPECT_NO_THROW(Simulation{other}) << scene.file;
  }
}

TEST(StepAgreement, IsOneLimitForEveryGalleryScene) {
  for (const std::string& name : scene_names()) {
    SceneFile scene = read_scene(scene_file(name));
    scene.output = {};
    expect_one_limit(scene);
  }
}

TEST(StepAgreement, IsOneLimitForBoxesOfEveryMaterialAndMethod) {
  SplitMix64 random(11);
  for (const IntegratorEntry& entry : integrators())
    for (const double zeta : {0.0, 0.05, 1.0, 20.0}) {
      Json json = moving_box();
      const double stiffness = std::pow(10.0, 2.0 + 0.5 * (1.0 + random.next_signed()) * 3.0);
      json["material"]["stiffness"] = stiffness;
      // c / k of 2 zeta / omega, with omega of about sqrt(40 k / 0.1 kg)
      json["material"]["damping"] = 2 * zeta * stiffness / std::sqrt(400.0 * stiffness);
      json["material"]["viscosity"] = 0.5 * (1.0 + random.next_signed());
      json["integrator"] = std::string(entry.name);
      json["duration"] = 0.2;
      json["step"] = 0.01;
      expect_one_limit(parse(json));
    }
}

// ---- a scene that asks for an accuracy

Json accurate(const char* unstable_step, double damping, double stiffness = 6.4e4) {
  Json json = moving_box();
  json.erase("step");
  json["duration"] = 0.2;
  json["accuracy"] = 5e-2;
  json["unstable_step"] = unstable_step;
  json["material"]["stiffness"] = stiffness;
  json["material"]["damping"] = damping;
  json["initial_velocity"] = {0.1, 0, 0};
  return json;
}

TEST(StepAgreement, ASceneWithAnAccuracyIsNotWarnedOfTheStepThatWasChosenForIt) {
  for (const char* integrator : {"rk4", "verlet", "blanes-moan-4", "symplectic-euler", "dormand-prince-54"})
    for (const double damping : {0.0, 10.0, 300.0}) {
      Json json = accurate("warn", damping);
      json["integrator"] = integrator;
      SceneFile scene = parse(json);
      const auto settled = settle_accuracy(scene, ticking());
      ASSERT_TRUE(settled);
      const Simulation simulation(scene);
      EXPECT_FALSE(simulation.step_warning()) << integrator << ", damping " << damping << ", h = " << scene.step;
    }
}

TEST(StepAgreement, ASceneWithAnAccuracyRunsWhereItRefusesUnstableSteps) {
  SceneFile scene = parse(accurate("refuse", 10.0));
  ASSERT_TRUE(settle_accuracy(scene, ticking()));
  Simulation simulation(scene);
  run(simulation);
  EXPECT_FALSE(simulation.step_warning());
}

TEST(StepAgreement, ASceneWithAnAccuracyIsNotDividedForNothing) {
  SceneFile scene = parse(accurate("substep", 10.0));
  ASSERT_TRUE(settle_accuracy(scene, ticking()));
  Simulation simulation(scene);
  run(simulation);
  EXPECT_EQ(simulation.work().steps, simulation.step_count());
}

TEST(StepAgreement, ARefusedStepOfAnAccuracyNamesTheKeyThatTheSceneHas) {
  SceneFile scene = parse(accurate("refuse", 0.0));
  scene.integrator = "rk4";
  scene.step = 0.1;  // as if that had been the result for the accuracy
  try {
    const Simulation simulation(scene);
    FAIL() << "ran with h = " << scene.step;
  } catch (const InputError& error) {
    const std::string what = error.what();
    EXPECT_EQ(what.rfind("file: /accuracy: a step of 0.1 s is too long for rk4; expected 'step' in its place", 0), 0u)
        << what;
    EXPECT_EQ(what.find("/step"), std::string::npos) << what;
  }
}

TEST(StepAgreement, GalleryScenesWithAnAccuracyRunWithoutAWarning) {
  std::size_t count = 0;
  for (const std::string& name : scene_names()) {
    SceneFile scene = read_scene(scene_file(name));
    if (!settle_accuracy(scene, ticking())) continue;
    ++count;
    Simulation simulation(scene);
    RunWatcher nobody;
    run_scene(simulation, scene.output, nobody);
    EXPECT_FALSE(simulation.step_warning()) << name << ": " << scene.integrator << ", h = " << scene.step;
  }
  EXPECT_GE(count, 1u);
}

}  // namespace
}  // namespace dartboard::step_agreement_test
