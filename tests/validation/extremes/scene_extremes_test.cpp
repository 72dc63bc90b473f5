#include "validation/extremes/scene_extremes.h"

#include <gtest/gtest.h>

#include "benchmarks/checkout/source_folder.h"
#include "core/time/integrators.h"
#include "validation/judges/wrong_integrators.h"
#include "validation/scenes/scene_of_file.h"

namespace dartboard::scene_extremes_test {
namespace {

std::shared_ptr<const TradeoffScene> scene_of(std::string_view text) {
  return std::make_shared<const TradeoffScene>(scene_of_file(parse_scene(text, "scene.json", source_folder())));
}

constexpr std::string_view bar =
    R"({"name": "bar", "body": {"generate": {"box": {"cells": [4, 1, 1], "spacing": 0.01}}},
  "material": {"density": 1000, "young": 1e5, "poisson": 0.3}, "gravity": [0, 0, -9.81],
  "fixed": [{"plane": {"point": [0.001, 0, 0], "normal": [-1, 0, 0]}}], "step": 1e-4, "duration": 0.1,
  "forces": [{"plane": {"point": [0.039, 0, 0], "normal": [1, 0, 0]}, "force": [0, 0, -1e-3], "from": 0.02}],
  "events": [{"at": 0.05, "dissociate": {"plane": {"point": [0.02, 0, 0], "normal": [1, 0, 0]}}}]})";

constexpr std::string_view springs = R"({"name": "springs",
  "body": {"generate": {"box": {"cells": [3, 1, 1], "spacing": 0.01}}},
  "material": {"density": 1000, "stiffness": 30}, "gravity": [0, 0, -9.81],
  "fixed": [{"plane": {"point": [0.001, 0, 0], "normal": [-1, 0, 0]}}], "step": 1e-3, "duration": 0.1,
  "driven": [{"plane": {"point": [0.029, 0, 0], "normal": [1, 0, 0]}, "velocity": [0.1, 0, 0]}],
  "events": [{"at": 0.05, "remove": {"ids": [3]}}]})";

constexpr std::string_view damped_springs = R"({"name": "damped springs",
  "body": {"generate": {"box": {"cells": [3, 1, 1], "spacing": 0.01}}},
  "material": {"density": 1000, "stiffness": 30, "damping": 0.01, "viscosity": 1}, "gravity": [0, 0, -9.81],
  "fixed": [{"plane": {"point": [0.001, 0, 0], "normal": [-1, 0, 0]}}], "step": 1e-3, "duration": 0.1,
  "events": [{"at": 0.05, "remove": {"ids": [3]}}]})";

std::vector<ExtremeCell> run(const std::vector<ExtremeCase>& cases, std::string_view value,
                             const MakeIntegrator& make = make_sound) {
  std::vector<ExtremeCell> cells;
  for (const ExtremeCase& one : cases)
    if (one.value == value) cells.push_back(one.run(make));
  return cells;
}

TEST(SceneExtremes, TakeTheStepOfTheSceneAndStepsOfEveryLength) {
  const auto scene = scene_of(bar);
  const std::vector<SceneStep> all = extreme_steps_of(*scene, false), few = extreme_steps_of(*scene, true);
  EXPECT_EQ(all.front().h, 1e-4);
  EXPECT_EQ(all.size(), 9u);
  EXPECT_EQ(few.size(), 5u);
  EXPECT_NEAR(all.back().h * scene->fastest_rate, 1e6, 1e-3);
  EXPECT_EQ(scene_extreme_cases(scene, true).size(), 5 * integrators().size());
}

TEST(SceneExtremes, ChangesTakePlaceAtEqualIntervalsAmongTheSteps) {
  const auto scene = scene_of(bar);
  ASSERT_EQ(scene->motion.events.size(), 2u);  // a force that begins, and a cut
  const auto motion = motion_in_steps(*scene, 2.0, 100);
  ASSERT_TRUE(motion.has_value());
  EXPECT_EQ(motion->events[0].time, 66.0);
  EXPECT_EQ(motion->events[1].time, 132.0);
  EXPECT_EQ(motion->checkpoints, std::vector{200.0});
  EXPECT_GT(motion->events[1].network.point_count(), motion->network.point_count());
  EXPECT_FALSE(motion_in_steps(*scene, 2.0, 2).has_value());
}

// Elements, a force, a cut: with short steps every integrator ends where Odeint does, and each of its steps is right.
TEST(SceneExtremes, ShortStepsOfSoundIntegratorsAreOk) {
  for (const std::string_view text : {bar, springs})
    for (const ExtremeCell& cell : run(scene_extreme_cases(scene_of(text), true), "h omega 0.5")) {
      const bool grows = cell.integrator == "explicit-euler";  // by exp(h^2 omega^2 / 2) a step, with a warning
      EXPECT_EQ(cell.outcome, grows ? ExtremeOutcome::degraded : ExtremeOutcome::ok)
          << cell.scene << " " << cell.integrator << ": " << to_string(cell.outcome) << " " << cell.note;
      EXPECT_TRUE(grows || cell.judged_by == JudgedBy::motion) << cell.integrator;
      EXPECT_EQ(cell.step, 100u);
    }
}

TEST(SceneExtremes, NoSoundIntegratorIsSilent) {
  for (const std::string_view text : {bar, springs})
    for (const ExtremeCase& one : scene_extreme_cases(scene_of(text), true)) {
      const ExtremeCell cell = one.run();
      EXPECT_NE(cell.outcome, ExtremeOutcome::silent)
          << cell.scene << " " << cell.integrator << ", " << cell.value << ": " << cell.note;
    }
}

TEST(SceneExtremes, EveryWrongIntegratorIsSeen) {
  const auto cases = scene_extreme_cases(scene_of(damped_springs), true);
  for (const WrongIntegrator& wrong : wrong_integrators()) {
    const auto make = [&wrong](std::string_view name) { return make_wrong(wrong.kind, name); };
    for (const ExtremeCell& cell : run(cases, "h omega 0.5", make))
      EXPECT_TRUE(cell.outcome == ExtremeOutcome::silent || cell.outcome == ExtremeOutcome::diagnosed)
          << wrong.name << ", " << cell.integrator << ": " << to_string(cell.outcome);
  }
}

TEST(SceneExtremes, UnstableStepsOfExplicitMethodsAreStopped) {
  for (const ExtremeCell& cell : run(scene_extreme_cases(scene_of(springs), true), "h omega 30"))
    EXPECT_TRUE(scheme_of(cell.integrator).implicit || cell.outcome == ExtremeOutcome::diagnosed)
        << cell.integrator << " " << cell.note;
}

TEST(SceneExtremes, OfAMembraneAreJudgedByTheirSurvival) {
  constexpr std::string_view membrane = R"({"name": "membrane", "body": {"generate": {"sheet": {"cells": [3, 3],
    "spacing": 0.01}}}, "material": {"density": 1, "young": 100, "poisson": 0.3}, "gravity": [0, 0, -9.81],
    "fixed": [{"plane": {"point": [0.001, 0, 0], "normal": [-1, 0, 0]}}], "step": 1e-4, "duration": 0.1})";
  for (const ExtremeCell& cell : run(scene_extreme_cases(scene_of(membrane), true), "h omega 0.5"))
    EXPECT_EQ(cell.outcome, cell.integrator == "explicit-euler" ? ExtremeOutcome::degraded : ExtremeOutcome::survived)
        << cell.integrator;
}

// It has no energy that it could come from.
TEST(SceneExtremes, OfAPressureThatFollowsItsFacesAreNotStoppedForItsWork) {
  constexpr std::string_view pressed = R"({"name": "pressed", "body": {"generate": {"box": {"cells": [3, 1, 1],
    "spacing": 0.01}}}, "material": {"density": 1000, "young": 1e5, "poisson": 0.3}, "gravity": [0, 0, 0],
    "fixed": [{"plane": {"point": [0.001, 0, 0], "normal": [-1, 0, 0]}}], "step": 1e-4, "duration": 0.1,
    "forces": [{"plane": {"point": [0, 0, 0.01], "normal": [0, 0, 1]}, "pressure": 3000, "normals": "current"}]})";
  for (const ExtremeCell& cell : run(scene_extreme_cases(scene_of(pressed), true), "h omega 0.5"))
    EXPECT_EQ(cell.outcome, cell.integrator == "explicit-euler" ? ExtremeOutcome::diagnosed : ExtremeOutcome::survived)
        << cell.integrator << " " << cell.note;
}

}  // namespace
}  // namespace dartboard::scene_extremes_test
