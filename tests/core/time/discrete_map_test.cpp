// Integrators on linear systems, 10^5 steps long, compared with the exact maps of their methods: this measures the
// code, not the truncation error.

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <vector>

#include "core/time/integrators.h"
#include "reference/closed_form.h"
#include "tests/support/spring_arrays_for_tests.h"

namespace dartboard::discrete_map_test {
namespace {

using reference::Swing;
using reference::VerletForm;

// Rounding: a position near 2 is rounded by 2^-52 at most in each step, its error turns with the oscillation and the
// errors of 10^5 steps add up like a random walk, 7e-14, and at the very worst to 2e-11.
constexpr int many = 100000;
constexpr double gate = 1e-10;

// A mass on a spring of length 2 at a wall: q = x - 2.
class Oscillator {
 public:
  Oscillator(double omega2, double drag, Swing start) {
    const auto wall = arrays_.add_vertex(1.0, {0, 0, 0}, {0, 0, 0}, true);
    const auto mass = arrays_.add_vertex(1.0, {2.0 + start.q, 0, 0}, {start.v, 0, 0});
    arrays_.add_spring(wall, mass, omega2, 2.0, drag);
  }
  void run(Integrator& integrator, double h, int n) {
    for (int k = 0; k < n; ++k) {
      const StepResult result = integrator.step(arrays_.system(), arrays_.motion(), h);
      ASSERT_TRUE(result.ok()) << to_string(result);
    }
  }
  Swing state() const { return {arrays_.x[1].x() - 2.0, arrays_.v[1].x()}; }

 private:
  SpringArrays arrays_;
};

constexpr double omega2 = 4.0;
constexpr Swing start{0.125, 0.25};

TEST(DiscreteMap, OfVerletIsARotationByTwiceAnArcSine) {
  for (const double h : {0.01, 0.3, 0.75}) {  // h omega = 0.02, 0.6, 1.5
    Oscillator body(omega2, 0.0, start);
    body.run(*make_integrator("verlet"), h, many);
    const Swing exact = verlet_oscillate(VerletForm::drift_kick_drift, omega2, start, h, many);
    EXPECT_NEAR(body.state().q, exact.q, gate) << h;
    EXPECT_NEAR(body.state().v, exact.v, gate) << h;
    EXPECT_NEAR(verlet_invariant(VerletForm::drift_kick_drift, omega2, h, body.state()),
                verlet_invariant(VerletForm::drift_kick_drift, omega2, h, start), gate)
        << h;
  }
}

TEST(DiscreteMap, OfSymplecticEulerIsTheSameRotationOnASkewEllipse) {
  for (const double h : {0.01, 0.3, 0.75}) {
    Oscillator body(omega2, 0.0, start);
    body.run(*make_integrator("symplectic-euler"), h, many);
    const Swing exact = symplectic_euler_oscillate(omega2, start, h, many);
    EXPECT_NEAR(body.state().q, exact.q, gate) << h;
    EXPECT_NEAR(body.state().v, exact.v, gate) << h;
    EXPECT_NEAR(symplectic_euler_invariant(omega2, h, body.state()), symplectic_euler_invariant(omega2, h, start), gate)
        << h;
  }
}

// q + i v / omega turns by R(-i theta) in each step.
void expect_powers(const char* name, const std::vector<long double>& coefficients, int n = many) {
  for (const double h : {0.01, 0.02}) {
    Oscillator body(omega2, 0.0, start);
    body.run(*make_integrator(name), h, n);
    using Complex = std::complex<long double>;
    Complex r = 0.0L, power = 1.0L;
    for (const long double c : coefficients) {
      r += c * power;
      power *= Complex(0.0L, -2.0L * h);
    }
    const Complex end = Complex(start.q, start.v / 2.0) * std::exp(static_cast<long double>(n) * std::log(r));
    EXPECT_NEAR(body.state().q, static_cast<double>(end.real()), gate) << name << ", h = " << h;
    EXPECT_NEAR(body.state().v, static_cast<double>(2.0L * end.imag()), gate) << name << ", h = " << h;
  }
}

TEST(DiscreteMap, OfRungeKuttaIsItsPolynomialToThePowerOfSteps) {
  expect_powers("rk4", {1.0L, 1.0L, 1.0L / 2, 1.0L / 6, 1.0L / 24});
}

TEST(DiscreteMap, OfDormandPrinceIsItsPolynomialToThePowerOfSteps) {
  expect_powers("dormand-prince-54", {1.0L, 1.0L, 1.0L / 2, 1.0L / 6, 1.0L / 24, 1.0L / 120, 1.0L / 600});
}

// 2000 steps grow by (1 + theta^2)^1000 = 5 at most.
TEST(DiscreteMap, OfExplicitEulerGrowsAsItMust) { expect_powers("explicit-euler", {1.0L, 1.0L}, 2000); }

// Every method, damped and undamped, against the power of the matrix its scheme declares. Entries are rounded to 1e-16,
// which is 1e-11 after 10^5 products.
TEST(DiscreteMap, IsThePowerOfTheSchemesAmplification) {
  for (const char* name : {"symplectic-euler", "verlet", "verlet-compensated", "blanes-moan-4",
                           "blanes-moan-4-compensated", "rk4", "dormand-prince-54"})
    for (const double zeta : {0.0, 1e-5, 0.2}) {
      const double h = 0.125;  // h omega = 1/4
      const int n = zeta == 0.2 ? 50 : many;
      const auto integrator = make_integrator(name);
      Oscillator body(omega2, 4.0 * zeta, start);
      body.run(*integrator, h, n);
      Eigen::Matrix<long double, 2, 2> power = Eigen::Matrix<long double, 2, 2>::Identity();
      auto square = integrator->scheme().amplification(0.25, zeta).cast<long double>().eval();
      for (int k = n; k > 0; k /= 2) {
        if (k % 2 == 1) power = square * power;
        square = square * square;
      }
      const Eigen::Matrix<long double, 2, 1> end = power * Eigen::Matrix<long double, 2, 1>(2.0 * start.q, start.v);
      EXPECT_NEAR(2.0 * body.state().q, static_cast<double>(end[0]), gate) << name << ", zeta = " << zeta;
      EXPECT_NEAR(body.state().v, static_cast<double>(end[1]), gate) << name << ", zeta = " << zeta;
    }
}

// A straight chain between walls is linear: every mode is an oscillator of its own and turns by its own angle.
TEST(DiscreteMap, OfVerletHoldsForEveryModeOfAChain) {
  const int masses = 8;
  const double k = 16.0, m = 0.25, h = 0.1;  // h omega_max = 1.58
  SpringArrays arrays;
  arrays.add_vertex(1.0, {0, 0, 0}, {0, 0, 0}, true);
  for (int i = 1; i <= masses; ++i)
    arrays.add_vertex(m, {1.0 * i + 0x1p-6 * ((i * 5) % 7), 0, 0}, {0x1p-4 * ((i * 3) % 5), 0, 0});
  arrays.add_vertex(1.0, {1.0 * masses + 1, 0, 0}, {0, 0, 0}, true);
  for (std::uint32_t i = 0; i <= masses; ++i) arrays.add_spring(i, i + 1, k, 1.0);
  const auto mode = [&](int j) {
    Swing sum{0, 0};
    for (int i = 1; i <= masses; ++i) {
      const auto at = static_cast<std::size_t>(i);
      sum.q += reference::chain_shape_fixed(masses, j, i) * (arrays.x[at].x() - i);
      sum.v += reference::chain_shape_fixed(masses, j, i) * arrays.v[at].x();
    }
    return sum;
  };
  std::vector<Swing> before;
  for (int j = 1; j <= masses; ++j) before.push_back(mode(j));
  const auto integrator = make_integrator("verlet");
  const int n = 10000;
  for (int s = 0; s < n; ++s) ASSERT_TRUE(integrator->step(arrays.system(), arrays.motion(), h).ok());
  for (int j = 1; j <= masses; ++j) {
    const double omega = reference::chain_omega_fixed(masses, k, m, j);
    const Swing exact =
        verlet_oscillate(VerletForm::drift_kick_drift, omega * omega, before[static_cast<std::size_t>(j - 1)], h, n);
    // omega^2 is within some 8 roundings, which is 1e-11 of the phase after 10^4 steps; 8 masses add up
    EXPECT_NEAR(mode(j).q, exact.q, gate) << j;
    EXPECT_NEAR(mode(j).v, exact.v, 10 * gate) << j;  // velocities are 16 times larger
  }
}

// 300 steps, each a few roundings of positions below 2^5 and velocities below 2^5.
TEST(DiscreteMap, OfAFallIsAParabolaFromOrderTwoOn) {
  for (const IntegratorEntry& entry : integrators()) {
    SpringArrays arrays;
    arrays.gravity = {0, 0.5, -9.75};
    arrays.add_vertex(2.0, {1, 2, 3}, {1, -2, 3});
    const reference::Flight at{arrays.x[0], arrays.v[0]};
    const auto integrator = entry.make();
    if (integrator->scheme().implicit) continue;
    const double h = 0.01;
    const int n = 300;
    for (int k = 0; k < n; ++k) ASSERT_TRUE(integrator->step(arrays.system(), arrays.motion(), h).ok());
    reference::Flight end = reference::free_fall(at, arrays.gravity, 0.0, n * h);
    if (entry.name == "explicit-euler")
      end = euler_fall(reference::EulerForm::start_velocity, at, arrays.gravity, h, n);
    if (entry.name == "symplectic-euler")
      end = euler_fall(reference::EulerForm::end_velocity, at, arrays.gravity, h, n);
    const double tolerance = n * 10 * 0x1p-53 * 32;
    EXPECT_LT((arrays.x[0] - end.x).norm(), tolerance * 2) << entry.name;
    EXPECT_LT((arrays.v[0] - end.v).norm(), tolerance) << entry.name;
  }
}

}  // namespace
}  // namespace dartboard::discrete_map_test
