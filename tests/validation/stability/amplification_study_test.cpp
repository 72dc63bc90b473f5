// One step of every integrator against its closed form, over five decades of steps.

#include "validation/stability/amplification_study.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include "core/plain/error.h"

namespace dartboard::amplification_study_test {
namespace {

TEST(Amplification, IsThatOfTheClosedFormsForEveryIntegrator) {
  const std::vector<double> thetas = amplification_steps(12);
  const std::vector<AmplificationPoint> points = measure_amplification(thetas);
  std::set<std::string> seen;
  for (const AmplificationPoint& p : points) {
    EXPECT_TRUE(p.holds()) << p.integrator << " at " << p.theta << ": " << p.deviation() << " for " << p.tolerance;
    EXPECT_LE(p.deviation(), 1e-10) << p.integrator << " at " << p.theta;
    seen.insert(p.integrator);
  }
  // explicit Euler is stable nowhere
  EXPECT_EQ(seen.size(), integrators().size() - 1);
}

// Phases are in the upper half of the plane and, beyond, over the whole turn.
TEST(AmplificationPoint, TellsWhatWasMeasuredApartFromTheory) {
  AmplificationPoint p;
  p.measured = std::polar(0.5, 1.0);
  p.theory = std::polar(0.25, -1.0);
  const double turn = 2 * std::numbers::pi;
  EXPECT_DOUBLE_EQ(p.amplitude(), 0.5);
  EXPECT_DOUBLE_EQ(p.phase(), 1.0);
  EXPECT_DOUBLE_EQ(p.theoretical_phase(), turn - 1.0);
  EXPECT_DOUBLE_EQ(p.damping_ratio(), std::log(2.0));
  EXPECT_DOUBLE_EQ(p.theoretical_damping_ratio(), std::log(4.0) / (turn - 1.0));
  p.measured = p.theory * 1.25;
  EXPECT_DOUBLE_EQ(p.deviation(), 0.25);
  p.tolerance = 0.26;
  EXPECT_TRUE(p.holds());
  p.tolerance = 0.24;
  EXPECT_FALSE(p.holds());
}

TEST(Amplification, CoversFiveDecadesForImplicitMethods) {
  const std::vector<double> thetas = amplification_steps(1);
  ASSERT_EQ(thetas.size(), 6u);
  EXPECT_DOUBLE_EQ(thetas.front(), 1e-2);
  EXPECT_DOUBLE_EQ(thetas.back(), 1e3);
}

// Backward Euler: amplitude (1 + theta^2)^-1/2, phase atan theta; the midpoint rule: 1 and 2 atan(theta/2).
TEST(Amplification, IsReportedAsAmplitudePhaseAndDamping) {
  const double thetas[]{0.1, 10.0};
  for (const AmplificationPoint& p : measure_amplification(thetas)) {
    if (p.integrator == "backward-euler") {
      EXPECT_NEAR(p.amplitude(), 1 / std::hypot(1.0, p.theta), p.tolerance);
      EXPECT_NEAR(p.phase(), std::atan(p.theta), p.tolerance);
      EXPECT_NEAR(p.damping_ratio(), std::log(std::hypot(1.0, p.theta)) / std::atan(p.theta), 40 * p.tolerance);
    }
    if (p.integrator == "implicit-midpoint") {
      EXPECT_NEAR(p.phase(), 2 * std::atan(p.theta / 2), p.tolerance);
      EXPECT_NEAR(p.damping_ratio(), 0.0, 40 * p.tolerance);
    }
  }
}

TEST(Amplification, OfAMethodWithoutAClosedFormIsRefused) {
  Scheme scheme;
  scheme.name = "trapezoid";
  EXPECT_THROW(theoretical_amplification(scheme, 1.0), InputError);
}

}  // namespace
}  // namespace dartboard::amplification_study_test
