#include "validation/tradeoff/rounding_floor.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/plain/nan_maximum.h"
#include "core/time/integrators.h"
#include "tests/support/ticking_clock_for_tests.h"
#include "validation/recommend/pilots.h"

namespace dartboard::rounding_floor_test {
namespace {

/// The error of a run whose steps are so short that only rounding shows.
double error_of(const TradeoffScene& scene, const char* name, std::uint64_t steps) {
  const auto integrator = make_integrator(name);
  const TimedRun run = run_timed(scene, *integrator, {.steps = steps}, ticking());
  TimedRun exact;
  exact.states = scene.closed_form();
  return max_or_nan(differences(scene, run, exact));
}

TEST(RoundingFloor, BoundsWhatRoundingLeavesOfAMotionInTinySteps) {
  const TradeoffScene scene = chain_scene(8, 64.0);
  // a constant of 0.1 to 0.6 was observed; 1.5 is assumed
  for (const char* name : {"blanes-moan-4", "dormand-prince-54"}) {
    const double floor = rounding_floor(scene, scheme_of(name)).at(scene.duration / 0x1p17);
    const double error = error_of(scene, name, 1 << 17);
    EXPECT_LT(error, floor) << name;
    EXPECT_GT(error, floor / 40) << name;
  }
}

TEST(RoundingFloor, StaysWhereItIsForCompensatedMethods) {
  const TradeoffScene scene = chain_scene(8, 64.0);
  const RoundingFloor floor = rounding_floor(scene, scheme_of("blanes-moan-4-compensated"));
  EXPECT_EQ(floor.at(1e-3), floor.at(1e-9));
  // the truncation of 2^17 steps: 3.6e-14 with 2^13, of order 4
  EXPECT_LT(error_of(scene, "blanes-moan-4-compensated", 1 << 17), floor.at(1e-3));
}

TEST(RoundingFloor, GrowsWithTheDistanceFromTheOriginAndWithTheRootOfTheSteps) {
  TradeoffScene scene = chain_scene(8, 64.0);
  const Scheme& rk4 = scheme_of("rk4");
  const RoundingFloor near = rounding_floor(scene, rk4);
  EXPECT_DOUBLE_EQ(near.at(1e-6), 1e3 * near.at(1.0));
  for (auto& x : scene.motion.start.x) x *= 100.0;
  EXPECT_NEAR(rounding_floor(scene, rk4).factor, 100.0 * near.factor, 1e-12 * 100.0 * near.factor);
}

// Each stage of an explicit splitting rounds the positions once more, and the others round them once, at the end.
TEST(RoundingFloor, CountsTheStagesThatRoundPositions) {
  const TradeoffScene scene = chain_scene(8, 64.0);
  const auto factor = [&](const char* name) { return rounding_floor(scene, scheme_of(name)).factor; };
  const double once = factor("rk4");
  for (const char* name : {"implicit-midpoint", "backward-euler", "verlet", "dormand-prince-54"})
    EXPECT_DOUBLE_EQ(factor(name), once) << name;
  const double stages = scheme_of("blanes-moan-4").stages;
  ASSERT_GT(stages, 1.0);
  EXPECT_DOUBLE_EQ(factor("blanes-moan-4"), std::sqrt(stages) * once);
}

}  // namespace
}  // namespace dartboard::rounding_floor_test
