// The uncertainty of a reference, and that it is reported.

#include "validation/scenes/scene_reference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "reference/error_norms.h"
#include "tests/support/ticking_clock_for_tests.h"

namespace dartboard::scene_reference_test {
namespace {

reference::CertifiedMotion codes_that_agree() {
  reference::CertifiedMotion certified;
  certified.accepted = certified.independent = true;
  certified.self_difference = certified.agreement = 1e-15;
  return certified;
}

TEST(CertaintyOf, CallsCodesIndependentOnlyWhereTheyAre) {
  reference::CertifiedMotion certified = codes_that_agree();
  EXPECT_EQ(certainty_of(certified), "certified by two independent codes");
  certified.independent = false;  // as without SUNDIALS, where the extrapolation of the same library is accepted
  EXPECT_EQ(certainty_of(certified),
            "confirmed by another method of the same library, by no independent code to 2e-13");
}

TEST(CertaintyOf, SaysWhereCodesDoNotAgree) {
  for (const double bad : {1e-9, std::numeric_limits<double>::quiet_NaN()}) {
    reference::CertifiedMotion certified = codes_that_agree();
    certified.accepted = certified.independent = false;
    certified.agreement = bad;
    EXPECT_EQ(certainty_of(certified), "NOT certified: the codes do not agree") << bad;
    certified.agreement = 1e-15;
    certified.self_difference = bad;
    EXPECT_EQ(certainty_of(certified), "NOT certified: the codes do not agree") << bad;
  }
}

/// A chain whose closed form is not given, and no time for the oracle.
SceneReference self_converged(double most_s) {
  TradeoffScene scene = chain_scene(6, 16.0, 4);
  scene.closed_form = nullptr;
  return reference_of(scene, ticking(), {.oracle_s = 0.0, .self_converged_s = most_s, .gain = false});
}

TEST(SelfConverged, PromisesNoMoreThanTheSecondMethodConfirms) {
  EXPECT_EQ(self_converged_floor(0.0, 0.0), 1e-12);
  EXPECT_EQ(self_converged_floor(1.5e-6, 1e-9), 1e-6);
  EXPECT_EQ(self_converged_floor(1.5e-9, 1e-3), 1e-3);
  EXPECT_TRUE(std::isnan(self_converged_floor(1.5e-9, std::numeric_limits<double>::quiet_NaN())));
  const SceneReference found = self_converged(0.0);
  EXPECT_EQ(found.kind, ReferenceKind::self_converged);
  EXPECT_GT(found.agreement, 0.0);
  EXPECT_GE(found.floor, found.agreement);
  // and it is true
  const TradeoffScene scene = chain_scene(6, 16.0, 4);
  EXPECT_LE(reference::motion_errors(scene.motion, found.states, scene.closed_form()).x, found.floor);
}

// A run of the oracle makes steps of h omega = 0.25 with 13 evaluations each. No machine evaluates a spring in extended
// precision in a nanosecond, and none takes a microsecond.
TEST(ReferenceOf, AsksTheOracleWhereARunOfItIsQuickEnough) {
  TradeoffScene scene = chain_scene(6, 16.0, 4);
  scene.closed_form = nullptr;
  const double evaluations = 16.0 / 0.25 * 13.0 * 7.0;  // of seven springs
  const auto kind = [&](double oracle_s) {
    return reference_of(scene, ticking(), {.oracle_s = oracle_s, .self_converged_s = 0.0, .gain = false}).kind;
  };
  EXPECT_EQ(kind(1e-9 * evaluations), ReferenceKind::self_converged);
  EXPECT_EQ(kind(1e-6 * evaluations), ReferenceKind::certified);
  // this takes a tick, and does not report how small disturbances grow unless requested
  const SceneReference found = reference_of(scene, ticking(), {.oracle_s = 1e-6 * evaluations, .gain = true});
  EXPECT_DOUBLE_EQ(found.cpu_s, 1e-6);
  EXPECT_GE(found.gain, 1.0);
}

// A run reads the clock at its start and at its end, or more often, so that at least half of all time is in runs.
TEST(SelfConverged, TakesTheTimeOfAllItsRuns) {
  TradeoffScene scene = chain_scene(6, 16.0, 4);
  scene.closed_form = nullptr;
  std::int64_t now = 0;
  const CpuClock clock = [&now] { return now += 1000; };
  const SceneReference found = reference_of(scene, clock, {.oracle_s = 0.0, .self_converged_s = 1e9, .gain = false});
  EXPECT_GE(found.cpu_s, 0.5e-9 * static_cast<double>(now));
  EXPECT_LT(found.cpu_s, 1e-9 * static_cast<double>(now));
}

TEST(SelfConverged, IsConfirmedWhereThereIsTime) {
  const SceneReference found = self_converged(1e9);
  EXPECT_LE(found.agreement, found.floor);
  EXPECT_LE(found.floor, 1e-11);
  EXPECT_EQ(found.what.find("unconfirmed"), std::string::npos) << found.what;
}

}  // namespace
}  // namespace dartboard::scene_reference_test
