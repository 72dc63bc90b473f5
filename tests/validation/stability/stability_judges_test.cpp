// The judges of steps: a limit, a boundary or a factor of one step that is off is refused.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/plain/random.h"
#include "tests/support/stand_in_integrators_for_tests.h"
#include "validation/extremes/extreme_run.h"
#include "validation/stability/amplification_study.h"
#include "validation/stability/detection_study.h"
#include "validation/stability/frequency_oracle.h"
#include "validation/stability/stability_limits.h"
#include "validation/stability/stability_map.h"

namespace dartboard::stability_judges_test {
namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

// ---- limits

StabilityLimit limit(double measured, double tolerance = 1e-3) {
  return {.body = "", .integrator = "", .theory = 2.0, .measured = measured, .tolerance = tolerance};
}

TEST(StabilityLimitJudge, AcceptsHalfATolerance) {
  EXPECT_TRUE(limit(2.0).holds());
  EXPECT_TRUE(limit(2.0 * (1 + 0.5e-3)).holds());
  EXPECT_TRUE(limit(2.0 * (1 - 0.5e-3)).holds());
}

TEST(StabilityLimitJudge, RefusesTwoTolerancesAndNoLimitAtAll) {
  for (const double measured : {2.0 * (1 + 2e-3), 2.0 * (1 - 2e-3), 0.0, no_number})
    EXPECT_FALSE(limit(measured).holds()) << measured;
}

std::vector<StabilityLimit> limits_of(const IntegratorEntry& entry) {
  return measure_stability_limits(true, std::span(&entry, 1));
}

// A thousandth where frequencies are closed forms, five where Lanczos finds them.
TEST(StabilityLimitJudge, AllowsAThousandthWhereFrequenciesAreClosedForms) {
  for (const StabilityLimit& l : limits_of(stand_in<LongerSteps<verlet_name, 0>>("verlet"))) {
    EXPECT_TRUE(l.holds()) << l.body << " zeta " << l.zeta << ": " << l.measured << " for " << l.theory;
    EXPECT_EQ(l.tolerance, l.body == "oscillator" || l.body == "chain" ? 1e-3 : 5e-3) << l.body;
    // the resolution of the bisection is a twentieth of the tolerance
    EXPECT_GT(l.measured, 0.0);
  }
}

// Steps half a percent too long: the limit is found, half a percent too low.
TEST(StabilityLimitJudge, RefusesAnIntegratorWhoseStepsAreHalfAPercentTooLong) {
  for (const StabilityLimit& l : limits_of(stand_in<LongerSteps<verlet_name, 5>>("verlet"))) {
    if (l.body != "oscillator" && l.body != "chain") continue;
    EXPECT_FALSE(l.holds()) << l.body << " zeta " << l.zeta;
    EXPECT_NEAR(l.measured / l.theory, 1 / 1.005, 1e-4) << l.body << " zeta " << l.zeta;
  }
}

TEST(StabilityLimitJudge, FindsNoLimitWhereThereIsNoneNearTheTheory) {
  for (const StabilityLimit& l : limits_of(stand_in<LongerSteps<verlet_name, 30>>("verlet"))) {
    EXPECT_EQ(l.measured, 0.0) << l.body;
    EXPECT_FALSE(l.holds());
  }
}

// ---- maps

TEST(StabilityMapJudge, IsAsFarOffAsItsWorstCrossing) {
  StabilityMap map;
  EXPECT_EQ(map.worst(), 0.0);
  map.boundary = {{0.0, 2.0, 2.002}, {0.1, 2.0, 1.98}, {0.2, 2.0, 2.0}};
  EXPECT_NEAR(map.worst(), 0.01, 1e-12);
  map.boundary.push_back({0.3, 2.0});  // none found
  EXPECT_EQ(map.worst(), 1.0);
}

TEST(StabilityMapJudge, DoesNotPassOverWhatIsNotANumber) {
  StabilityMap map;
  map.boundary = {{0.0, 2.0, no_number}, {0.1, 2.0, 2.0}};
  EXPECT_FALSE(map.worst() <= 0.5);
}

TEST(StabilityMapJudge, SeesAnIntegratorWhoseStepsAreHalfAPercentTooLong) {
  const MapPlan plan{.columns = 4, .rows = 3, .boundary_rows = 3, .steps = 1000};
  const StabilityMap right = measure_stability_map(stand_in<LongerSteps<verlet_name, 0>>("verlet"), plan),
                     wrong = measure_stability_map(stand_in<LongerSteps<verlet_name, 5>>("verlet"), plan);
  EXPECT_LE(right.worst(), 2e-3);
  EXPECT_NEAR(wrong.boundary.at(0).distance(), 1 - 1 / 1.005, 1e-3);
  EXPECT_GT(wrong.worst(), 4e-3);
}

// ---- one step

AmplificationPoint off_by(double share_of_tolerance) {
  AmplificationPoint p;
  p.theory = {0.0, 1.0};
  p.tolerance = 1e-12;
  p.measured = p.theory * (1.0 + share_of_tolerance * p.tolerance);
  return p;
}

TEST(AmplificationJudge, AcceptsHalfATolerance) { EXPECT_TRUE(off_by(0.5).holds()); }

TEST(AmplificationJudge, RefusesTwoTolerancesAndWhatIsNotANumber) {
  EXPECT_FALSE(off_by(2.0).holds());
  EXPECT_FALSE(off_by(-2.0).holds());
  EXPECT_FALSE(off_by(no_number).holds());
  AmplificationPoint turned = off_by(0.0);
  turned.measured *= std::polar(1.0, 3e-12);  // as large, but later
  EXPECT_FALSE(turned.holds());
}

// Some tens of roundings of positions near 2, where the motion has a size of 1/8.
TEST(AmplificationJudge, AllowsSomeTensOfRoundingsOfPositions) {
  const double thetas[]{1.0};
  const IntegratorEntry entry = stand_in<LongerSteps<rk4_name, 0>>("rk4");
  const auto points = measure_amplification(thetas, std::span(&entry, 1));
  ASSERT_EQ(points.size(), 1u);
  const double rounding = 0x1p-51 * 2.0 / 0.125;  // a unit in the last place of 2 to 4, in units of the motion
  EXPECT_TRUE(points[0].holds());
  EXPECT_GE(points[0].tolerance * std::abs(points[0].theory), 10 * rounding);
  EXPECT_LE(points[0].tolerance * std::abs(points[0].theory), 100 * rounding);
}

TEST(AmplificationJudge, RefusesAStepThatIsOffInItsTenthDigit) {
  const double thetas[]{1.0};
  const IntegratorEntry entry = stand_in<LongerSteps<rk4_name, 1, 10'000'000>>("rk4");
  const auto points = measure_amplification(thetas, std::span(&entry, 1));
  EXPECT_FALSE(points.at(0).holds()) << points[0].deviation();
}

// ---- detection

TEST(DetectionJudge, RefusesARunThatNobodyPredicted) {
  const SpringColumns body = moving_body("oscillator");
  const IntegratorEntry entry = stand_in<LongerSteps<verlet_name, 0>>("verlet");
  const double limit = 2.0 / fastest_mode(body).omega;
  EXPECT_TRUE(watch_for_divergence(entry, body, 1.1 * limit, 1.1).predicted);
  const Detection stable = watch_for_divergence(entry, body, 0.5 * limit, 1.1);
  EXPECT_FALSE(stable.predicted);
  EXPECT_FALSE(stable.holds());
  EXPECT_FALSE(stable.passed);
  EXPECT_EQ(stable.steps, 5000u);
}

// At 1.1 of Verlet's limit an oscillation grows by 2.4 a step: the bound of 100 in energy is passed within ten steps.
TEST(DetectionJudge, CountsTheStepsAboveTheBound) {
  const SpringColumns body = moving_body("oscillator");
  const IntegratorEntry entry = stand_in<LongerSteps<verlet_name, 0>>("verlet");
  const Detection found = watch_for_divergence(entry, body, 1.1 * 2.0 / fastest_mode(body).omega, 1.1);
  ASSERT_TRUE(found.passed && found.detected);
  EXPECT_LE(*found.passed, 10u);
  EXPECT_LE(*found.passed, *found.detected);
  EXPECT_GE(found.above, 1u);
  EXPECT_TRUE(found.holds());
}

// ---- frequencies

// The largest eigenvalue has an eigenvector that is orthogonal to the start, which is drawn from a known seed: Lanczos
// converges to another one, and only the proof shows it.
TEST(FrequencyOracle, ProvesNothingWhereItMissesTheLargest) {
  SplitMix64 random(1);
  const double w0 = random.next_signed(), w1 = random.next_signed();
  const Eigen::Vector2d missed = Eigen::Vector2d(w1, -w0).normalized(), met(missed[1], -missed[0]);
  Eigen::SparseMatrix<double> a(2, 2);
  const Eigen::Matrix2d dense = 3.0 * missed * missed.transpose() + met * met.transpose();
  for (int r = 0; r < 2; ++r)
    for (int c = 0; c < 2; ++c) a.insert(r, c) = dense(r, c);
  const LargestEigenvalue found = largest_eigenvalue(a);
  EXPECT_NEAR(found.value, 1.0, 1e-9);
  EXPECT_FALSE(found.proven);
}

}  // namespace
}  // namespace dartboard::stability_judges_test
