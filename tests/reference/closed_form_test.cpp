#include "reference/closed_form.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "core/plain/eigenvalues.h"

namespace dartboard::reference::closed_form_test {
namespace {

constexpr double u = 0x1p-53;

TEST(FreeFall, IsAParabolaWithoutDrag) {
  const Flight end = free_fall({{1, 2, 3}, {4, 0, -2}}, {0, 0, -10}, 0.0, 0.5);
  EXPECT_EQ(end.x, Eigen::Vector3d(3, 2, 0.75));  // all terms are short binary fractions
  EXPECT_EQ(end.v, Eigen::Vector3d(4, 0, -7));
}

TEST(FreeFall, ReachesGravityOverViscosityInTheEnd) {
  const Flight end = free_fall({{0, 0, 0}, {3, 0, 0}}, {0, 0, -10}, 2.0, 50.0);
  EXPECT_LT(end.v[0], 1e-40);  // 3 exp(-100)
  EXPECT_DOUBLE_EQ(end.v[2], -5.0);
}

TEST(FreeFall, ContinuesFromWhereItWas) {
  // z is below and above the switch to the series; every factor has a few roundings, 40 in all on sizes below 100
  const Flight start{{1, 2, 3}, {4, -5, 6}};
  for (double viscosity : {1e-9, 0.1, 0.7, 4.0}) {
    const Flight half = free_fall(start, {0, 1, -10}, viscosity, 0.5);
    const Flight twice = free_fall(half, {0, 1, -10}, viscosity, 0.75);
    const Flight once = free_fall(start, {0, 1, -10}, viscosity, 1.25);
    EXPECT_LT((twice.x - once.x).norm(), 40 * u * 100) << viscosity;
    EXPECT_LT((twice.v - once.v).norm(), 40 * u * 100) << viscosity;
  }
}

TEST(Oscillate, AgreesWithManySmallRungeKuttaStepsForEveryDamping) {
  // omega = 2, t = 1 in 2000 steps of h. With the larger root r = max(omega, drag) of the motion each step has the
  // error (r h)^5 / 120 < 1e-14 / 120 and, in the 2 x 2 product, some 10 roundings; neither grows by more than
  // max(1, omega) = 2, since the motion is damped. The sizes are below 3.
  const double h = 1.0 / 2048.0;
  for (double drag : {0.0, 0.5, 3.0, 4.0, 4.0 + 1e-7, 5.0}) {
    const Swing exact = oscillate(4.0, drag, {1.0, -0.5}, 1.0);
    const Swing small = rk4_oscillate(4.0, drag, {1.0, -0.5}, h, 2048);
    const double root = std::max(2.0, drag);
    const double tolerance = 2048 * 3.0 * 2.0 * (std::pow(root * h, 5) / 120 + 10 * u);
    EXPECT_NEAR(exact.q, small.q, tolerance) << drag;
    EXPECT_NEAR(exact.v, small.v, 2.0 * tolerance) << drag;
  }
}

TEST(Oscillate, SlowsDownByDragAlone) {
  const Swing end = oscillate(0.0, 2.0, {1.0, 4.0}, 3.0);
  EXPECT_NEAR(end.q, 1.0 + 2.0 * (1.0 - std::exp(-6.0)), 16 * u * 3.0);
  EXPECT_NEAR(end.v, 4.0 * std::exp(-6.0), 64 * u * 4.0);  // a difference of numbers below 4
  const Swing drift = oscillate(0.0, 0.0, {1.0, 4.0}, 3.0);
  EXPECT_EQ(drift.q, 13.0);
  EXPECT_EQ(drift.v, 4.0);
}

TEST(Oscillate, StaysFiniteWhenHeavilyOverdamped) {
  // the slow root is omega2 / drag (1 + 1e-12): q decays by exp(-1e-3)
  const Swing end = oscillate(1.0, 1e6, {1.0, 0.0}, 1e3);
  EXPECT_NEAR(end.q, std::exp(-1e-3), 1e-11);
}

TEST(Dumbbell, MirrorsItsDistanceAfterHalfAPeriodAndFliesOn) {
  const Dumbbell body{.m1 = 1.0, .m2 = 3.0, .stiffness = 12.0, .rest_length = 2.0};  // reduced mass 3/4, omega 4
  const DumbbellState start{0.0, 2.5, 1.0, 1.0};
  const double t = std::numbers::pi / 4.0;
  const DumbbellState end = swing(body, start, t);
  EXPECT_NEAR(end.x2 - end.x1, 1.5, 32 * u * 4);
  EXPECT_NEAR((end.x1 + 3.0 * end.x2) / 4.0, 1.875 + t, 32 * u * 4);
  EXPECT_NEAR(end.v1, 1.0, 32 * u * 4);
  EXPECT_NEAR(end.v2, 1.0, 32 * u * 4);
}

TEST(Dumbbell, LosesMomentumToTheMediumAndNotToItsSpring) {
  const Dumbbell body{1.0, 3.0, 12.0, 5.0, 2.0, 0.5};
  const DumbbellState end = swing(body, {0.0, 3.0, 2.0, -1.0}, 1.5);
  EXPECT_NEAR(end.v1 + 3.0 * end.v2, -std::exp(-0.75), 64 * u * 4);
}

// The frequencies of K = k / m (2 -1; -1 2 -1; ...), by an eigenvalue solver.
Eigen::VectorXd chain_squares(int n, double k, double m, double end_diagonal) {
  Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    K(i, i) = i == 0 || i == n - 1 ? end_diagonal : 2.0;
    if (i > 0) K(i, i - 1) = K(i - 1, i) = -1.0;
  }
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(k / m * K)).eigenvalues();
}

TEST(Chain, HasTheFrequenciesOfItsStiffnessMatrix) {
  // the solver is backward stable: eigenvalues within a modest multiple of n u |K|, |K| <= 4 k / m
  const int n = 9;
  const double k = 30.0, m = 0.2, tolerance = 10 * n * u * 4 * k / m;
  const Eigen::VectorXd fixed = chain_squares(n, k, m, 2.0), free = chain_squares(n, k, m, 1.0);
  for (int j = 0; j < n; ++j) {
    EXPECT_NEAR(std::pow(chain_omega_fixed(n, k, m, j + 1), 2), fixed[j], tolerance);
    EXPECT_NEAR(std::pow(chain_omega_free(n, k, m, j), 2), free[j], tolerance);
  }
}

// m omega^2 shape - K shape at every mass, where the ends are walls (fixed) or nothing (free).
template <class Shape>
double worst_defect(int n, double k, double m, double omega, bool wall_before, bool wall_behind, Shape&& shape) {
  double worst = 0.0;
  for (int i = 1; i <= n; ++i) {
    const double before = i > 1 ? shape(i - 1) : wall_before ? 0.0 : shape(i);
    const double behind = i < n ? shape(i + 1) : wall_behind ? 0.0 : shape(i);
    const double force = k * (before - shape(i)) + k * (behind - shape(i));
    worst = std::max(worst, std::abs(m * omega * omega * shape(i) + force));
  }
  return worst;
}

TEST(Chain, SwingsInTheShapesOfItsModes) {
  // shapes are at most 1 and their arguments below n pi, so they are within (n pi + 1) u; 4 k of them meet
  const int n = 7;
  const double k = 30.0, m = 0.2, tolerance = 2 * 4 * k * (n * std::numbers::pi + 4) * u;
  for (int j = 1; j <= n; ++j) {
    EXPECT_LT(worst_defect(n, k, m, chain_omega_fixed(n, k, m, j), true, true,
                           [&](int i) { return chain_shape_fixed(n, j, i); }),
              tolerance);
    EXPECT_LT(worst_defect(n, k, m, chain_omega_fixed_free(n, k, m, j), true, false,
                           [&](int i) { return chain_shape_fixed_free(n, j, i); }),
              tolerance);
    EXPECT_LT(worst_defect(n, k, m, chain_omega_free(n, k, m, j - 1), false, false,
                           [&](int i) { return chain_shape_free(n, j - 1, i); }),
              tolerance);
  }
}

TEST(Chain, CarriesWavesAtTheFrequenciesOfItsModes) {
  // mode j of n free masses is a standing wave of j half waves on n spacings
  const double k = 30.0, m = 0.2, a = 0.5;
  for (int j = 0; j < 8; ++j)
    EXPECT_NEAR(chain_dispersion(k, m, a, j * std::numbers::pi / (8 * a)), chain_omega_free(8, k, m, j), 30 * 8 * u);
}

TEST(Chain, HasTheGroupVelocityThatIsTheSlopeOfItsDispersion) {
  // the difference quotient is off by d^2/6 times the third derivative, c a^2 / 4 or less, and by rounding 4 omega u /
  // d
  const double k = 30.0, m = 0.2, a = 0.5, d = 1e-4, c = a * std::sqrt(k / m);
  for (const double q : {-3.0, -0.5, 0.25, 1.0, 4.0})
    EXPECT_NEAR((chain_dispersion(k, m, a, q + d) - chain_dispersion(k, m, a, q - d)) / (2 * d),
                chain_group_velocity(k, m, a, q), c * a * a * d * d / 24 * 1.01 + 8 * 25 * u / d)
        << q;
}

TEST(RotatingDumbbell, PullsAsMuchAsItsMassesFlyApart) {
  const double k = 40.0, rest = 2.0, reduced = 0.75, rate = 3.0;
  const double length = rotating_length(k, rest, reduced, rate);
  EXPECT_NEAR(k * (length - rest), reduced * rate * rate * length, 32 * u * k * length);
}

TEST(HangingChain, CarriesWhatHangsBelow) {
  const std::vector<double> masses{1.0, 2.0, 4.0};
  EXPECT_EQ(hanging_lengths(masses, 8.0, 0.5, 2.0), (std::vector{2.25, 2.0, 1.5}));
}

TEST(Rk4, IsNeutralAtItsStabilityLimitOnTheImaginaryAxis) {
  // |R(iy)|^2 = 1 - y^6/72 + y^8/576, which is 1 at y^2 = 8
  EXPECT_NEAR(std::abs(rk4_amplification({0.0, std::sqrt(8.0)})), 1.0, 64 * u);
  EXPECT_LT(std::abs(rk4_amplification({0.0, 2.82})), 1.0);
  EXPECT_GT(std::abs(rk4_amplification({0.0, 2.83})), 1.0);
}

TEST(Rk4, MapsAnOscillatorAsItsAmplificationSays) {
  // with omega = 1, q + i v turns by exp(-i t): z = -i h
  const double h = 0.3;
  const std::complex<double> once = rk4_amplification({0.0, -h});
  std::complex<double> y(0.25, 0.5);
  for (int i = 0; i < 20; ++i) y *= once;
  const Swing end = rk4_oscillate(1.0, 0.0, {0.25, 0.5}, h, 20);
  EXPECT_NEAR(end.q, y.real(), 20 * 16 * u);
  EXPECT_NEAR(end.v, y.imag(), 20 * 16 * u);
}

TEST(ImplicitMethods, HaveTheirPhasesAndAmplitudes) {
  for (const double theta : {0.1, 1.0, 20.0}) {
    const auto euler = backward_euler_amplification({0.0, theta});
    EXPECT_NEAR(std::abs(euler), 1.0 / std::sqrt(1.0 + theta * theta), 8 * u);
    EXPECT_NEAR(std::arg(euler), std::atan(theta), 8 * u);
    const auto midpoint = implicit_midpoint_amplification({0.0, theta});
    EXPECT_NEAR(std::abs(midpoint), 1.0, 8 * u);
    EXPECT_NEAR(std::arg(midpoint), 2.0 * std::atan(theta / 2.0), 16 * u);
  }
}

// 20 steps written as the methods are; amplitudes stay below 2 and each step makes some 6 roundings.
constexpr double omega2 = 4.0, step = 0.3, twenty_steps = 20 * 20 * 6 * u * 4;

TEST(Verlet, TurnsAsItsRecurrence) {
  Swing drift{0.25, 0.5}, kick = drift;
  for (int i = 0; i < 20; ++i) {
    drift.q += step / 2 * drift.v;
    drift.v -= step * omega2 * drift.q;
    drift.q += step / 2 * drift.v;
    kick.v -= step / 2 * omega2 * kick.q;
    kick.q += step * kick.v;
    kick.v -= step / 2 * omega2 * kick.q;
  }
  const Swing drift_end = verlet_oscillate(VerletForm::drift_kick_drift, omega2, {0.25, 0.5}, step, 20);
  const Swing kick_end = verlet_oscillate(VerletForm::kick_drift_kick, omega2, {0.25, 0.5}, step, 20);
  EXPECT_NEAR(drift.q, drift_end.q, twenty_steps);
  EXPECT_NEAR(drift.v, drift_end.v, twenty_steps);
  EXPECT_NEAR(kick.q, kick_end.q, twenty_steps);
  EXPECT_NEAR(kick.v, kick_end.v, twenty_steps);
}

TEST(Verlet, KeepsItsInvariant) {
  for (const auto form : {VerletForm::drift_kick_drift, VerletForm::kick_drift_kick}) {
    const double before = verlet_invariant(form, omega2, step, {0.25, 0.5});
    for (const int n : {1, 7, 20})
      EXPECT_NEAR(verlet_invariant(form, omega2, step, verlet_oscillate(form, omega2, {0.25, 0.5}, step, n)), before,
                  16 * u);
  }
}

TEST(SymplecticEuler, TurnsAsItsRecurrenceAndKeepsItsInvariant) {
  Swing at{0.25, 0.5};
  const double before = symplectic_euler_invariant(omega2, step, at);
  for (int i = 0; i < 20; ++i) {
    at.v -= step * omega2 * at.q;
    at.q += step * at.v;
  }
  const Swing end = symplectic_euler_oscillate(omega2, {0.25, 0.5}, step, 20);
  EXPECT_NEAR(at.q, end.q, twenty_steps);
  EXPECT_NEAR(at.v, end.v, twenty_steps);
  EXPECT_NEAR(symplectic_euler_invariant(omega2, step, end), before, 16 * u);
}

// Of order 4 with a symmetric table: half the trace is cos(theta) up to theta^6, so half the step leaves a 64th; a
// wrong digit anywhere would leave a multiple of theta^2. In extended precision, where both are far above rounding.
TEST(BlanesMoan, HasTheOrderOfItsTable) {
  const auto off = [](long double theta) {
    return static_cast<double>(blanes_moan_step(theta, 0.0L).trace() / 2 - std::cos(theta));
  };
  EXPECT_NEAR(off(0.25L) / off(0.125L), 64.0, 2.0);
  EXPECT_LT(std::abs(off(0.125L)), 1e-9);
  EXPECT_NEAR(static_cast<double>(blanes_moan_step(0.5L, 0.0L).determinant()), 1.0, u);
}

TEST(BlanesMoan, HasDriftsAndKicksThatAddUpToAStep) {
  const auto [a, b] = blanes_moan_numbers();
  EXPECT_NEAR(static_cast<double>(2.0L * (a[0] + a[1] + a[2]) + a[3]), 1.0, u);
  EXPECT_NEAR(static_cast<double>(2.0L * (b[0] + b[1] + b[2])), 1.0, u);
}

TEST(EulerFall, IsOffTheParabolaByHalfAStepOfVelocity) {
  const Flight start{{1, 2, 3}, {4, 0, -2}};
  const Flight exact = free_fall(start, {0, 0, -8}, 0.0, 2.0);  // short binary fractions throughout
  const Flight early = euler_fall(EulerForm::start_velocity, start, {0, 0, -8}, 0.25, 8);
  const Flight late = euler_fall(EulerForm::end_velocity, start, {0, 0, -8}, 0.25, 8);
  EXPECT_EQ(early.x - exact.x, Eigen::Vector3d(0, 0, 2));
  EXPECT_EQ(late.x - exact.x, Eigen::Vector3d(0, 0, -2));
  EXPECT_EQ(early.v, exact.v);
  EXPECT_EQ(late.v, exact.v);
}

}  // namespace
}  // namespace dartboard::reference::closed_form_test
