// Predictions for a scene before it is run, on scenes with known features.

#include "validation/scenes/scene_features.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/meshes/generators/mesh_generators.h"
#include "core/time/integrators.h"
#include "reference/closed_form.h"
#include "tests/support/moving_box.h"
#include "tests/support/ticking_clock_for_tests.h"
#include "validation/scenes/scene_of_file.h"

namespace dartboard::scene_features_test {
namespace {

// A chain of 8 masses of 0.01 kg on springs of 50 N/m, 0.1 m apart, for 64 radians of its fastest mode.
SceneFeatures of_a_chain(double damping, double viscosity = 0.0) {
  TradeoffScene scene = chain_scene(8, 64.0);
  for (reference::Spring& s : scene.motion.network.springs) s.damping = damping;
  scene.motion.network.viscosity = viscosity;
  return features_of(scene, ticking());
}

TEST(SceneFeatures, CountTheSceneAndBracketItsFastestFrequency) {
  const SceneFeatures f = of_a_chain(0.0);
  EXPECT_EQ(f.vertices, 10u);
  EXPECT_EQ(f.springs, 9u);
  EXPECT_EQ(f.events, 0u);
  const double omega = reference::chain_omega_fixed(8, 50.0, 0.01, 8);
  EXPECT_NEAR(f.omega_low, omega, 1e-9 * omega);
  // Gershgorin: two springs of 50 N/m at a mass, twice
  EXPECT_DOUBLE_EQ(f.omega_high, std::sqrt(2.0 * 100.0 / 0.01));
  EXPECT_NEAR(f.phase, 64.0, 1e-7);
  EXPECT_EQ(f.damping_ratio, 0.0);
}

// However fast the damping decays (here a hundred times as fast as the springs oscillate), it is no frequency.
TEST(SceneFeatures, TakeNoRateOfDecayForAFrequency) {
  const SceneFeatures undamped = of_a_chain(0.0), damped = of_a_chain(100.0), in_a_medium = of_a_chain(0.0, 1e6);
  EXPECT_EQ(damped.omega_low, undamped.omega_low);
  EXPECT_EQ(damped.omega_high, undamped.omega_high);
  EXPECT_EQ(damped.phase, undamped.phase);
  EXPECT_EQ(in_a_medium.omega_low, undamped.omega_low);
}

// zeta = omega c / (2 k), and half the viscosity over omega.
TEST(SceneFeatures, TellTheDampingRatioOfTheFastestMode) {
  const SceneFeatures f = of_a_chain(0.25, 10.0);
  EXPECT_DOUBLE_EQ(f.damping_ratio, 0.5 * f.omega_low * 0.25 / 50.0 + 5.0 / f.omega_low);
}

// Without springs the scale of time is that of the scene.
TEST(SceneFeatures, OfFreePointsHaveTheRateOfTheScene) {
  TradeoffScene scene = chain_scene(8, 64.0);
  scene.motion.network.springs.clear();
  const SceneFeatures f = features_of(scene, ticking());
  EXPECT_DOUBLE_EQ(f.omega_low, 1.0 / scene.duration);
  EXPECT_DOUBLE_EQ(f.omega_high, 1.0 / scene.duration);
}

TEST(StabilityLimit, IsTheLeastOfTheLimitsBeforeAndAfterEvents) {
  const Scheme& verlet = scheme_of("verlet");
  SceneFeatures soft = of_a_chain(0.0);
  ASSERT_EQ(soft.limits.size(), 1u);
  const double limit = stability_limit(verlet, soft, 1.0);
  EXPECT_LE(limit, 2.0 / soft.omega_low * 1.001);  // weaker growth than this counts as stable
  EXPECT_GE(limit, 0.5 * 2.0 / soft.omega_low);
  TradeoffScene stiffer = chain_scene(8, 64.0);
  for (reference::Spring& s : stiffer.motion.network.springs) s.stiffness *= 4.0;
  const SceneFeatures stiff = features_of(stiffer, ticking());
  EXPECT_NEAR(stability_limit(verlet, stiff, 1.0), limit / 2.0, 0.02 * limit);
  soft.limits.push_back(stiff.limits[0]);
  EXPECT_EQ(stability_limit(verlet, soft, 1.0), stability_limit(verlet, stiff, 1.0));
  soft.limits = {stiff.limits[0], soft.limits[0]};
  EXPECT_EQ(stability_limit(verlet, soft, 1.0), stability_limit(verlet, stiff, 1.0));
}

// c = beta k in every spring, and zeta = beta omega / 2 = 1 at the fastest omega of the undamped body.
TEST(StiffScene, IsCriticallyDampedAtItsFastestModeWhereItIsDamped) {
  const Mesh mesh = kuhn_box(3, 3, 3, 0.1);
  const TradeoffScene undamped = stiff_scene("", mesh, 1e2, {}), damped = stiff_scene("", mesh, 1e2, {.damped = true});
  for (const reference::Spring& s : undamped.motion.network.springs) EXPECT_EQ(s.damping, 0.0);
  for (const reference::Spring& s : damped.motion.network.springs)
    EXPECT_NEAR(0.5 * undamped.fastest_rate * s.damping / s.stiffness, 1.0, 1e-12);
  EXPECT_EQ(damped.duration, undamped.duration);
}

TEST(SceneFeatures, OfManyEventsLookAtSomeOfTheStepsThatTheyAllowAndAtTheLast) {
  moving::Json json = moving::with_events(
      moving::moving_box(),
      R"([{"from": 0.0001, "every": 0.0002, "until": 0.0079, "remove": {"random": {"count": 1, "seed": 3}}},
                                {"at": 0.009, "refine": {"cells": {"sphere": {"centre": [0, 0, 0], "radius": 1}}}}])");
  const TradeoffScene scene = scene_of_file(moving::parse(json));
  ASSERT_EQ(scene.motion.events.size(), 41u);
  const SceneFeatures f = features_of(scene, ticking());
  EXPECT_GE(f.limits.size(), 17u);
  EXPECT_LE(f.limits.size(), 33u);
  EXPECT_GT(f.limits.back().lower, 1.2 * f.limits[f.limits.size() - 2].upper);  // of shorter edges
}

TEST(SizesInWords, NameSpringsWhereThereAreSomeOrNothingElse) {
  EXPECT_EQ(sizes_in_words(5, 4, {}), "5 vertices, 4 springs");
  EXPECT_EQ(sizes_in_words(5, 0, {}), "5 vertices, 0 springs");
  EXPECT_EQ(sizes_in_words(5, 0, {{"tetrahedra", 3}}), "5 vertices, 3 tetrahedra");
  EXPECT_EQ(sizes_in_words(5, 4, {{"membranes", 2}, {"tetrahedra", 3}}),
            "5 vertices, 4 springs, 2 membranes, 3 tetrahedra");
}

// A body of elements has no network of springs to be judged by: its frequencies are those that limit a step.
TEST(SceneFeatures, OfElementsAreThoseOfTheBodyThatASimulationSteps) {
  moving::Json json = moving::moving_box();
  json.merge_patch(
      moving::Json::parse(R"({"material": {"stiffness": null, "young": 3000, "poisson": 0.3, "damping": null}})"));
  const SceneFile file = moving::parse(json);
  const SceneFeatures f = features_of(scene_of_file(file), ticking());
  const StableStep limits = Simulation(file).stable_step();
  EXPECT_EQ(f.omega_low, limits.lower);
  EXPECT_EQ(f.omega_high, limits.upper);
  EXPECT_EQ(f.damping_ratio, limits.damping_ratio().upper);
  EXPECT_EQ(f.springs, 0u);
  EXPECT_EQ(f.pieces, (PieceCounts{{"tetrahedra", 48}}));
}

}  // namespace
}  // namespace dartboard::scene_features_test
