// Masses, stiffness, damping and viscosity times one number are the same motion; times a power of two, to the bit. So
// nothing may compare forces or energies with numbers of its own, and no square of them may under- or overflow.

#include <gtest/gtest.h>

#include <cmath>

#include "core/time/implicit/one_stage.h"
#include "core/time/integrators.h"
#include "core/time/watch/preflight.h"
#include "core/time/watch/stable_step.h"
#include "tests/support/spring_bodies_for_tests.h"

namespace dartboard::mass_scaling_test {
namespace {

constexpr int exponents[] = {-600, 300, 600};  // squares of numbers scaled by 2^600 are beyond the doubles

/// A body that has everything: dampers, viscosity, gravity, vertices held and driven; some springs are compressed.
SpringArrays swinging_grid(int exponent) {
  SpringArrays body = spring_grid(2, 2, 2, 50.0, 0.05);
  body.gravity = {0, 0, -9.81};
  body.fixed[0] = body.fixed[1] = 1;
  disturb(body, 0.02, 0.5);
  body.v[1] = {0.1, 0, 0.2};
  const double scale = std::ldexp(1.0, exponent);
  for (Spring& s : body.springs) {
    s.stiffness *= scale;
    s.damping *= scale;
  }
  for (std::size_t i = 0; i < body.mass.size(); ++i) {
    body.viscosity[i] = 0.5 * body.mass[i] * scale;
    body.mass[i] *= scale;
    body.inverse_mass[i] /= scale;
  }
  return body;
}

/// Eight steps; those that fail are counted.
int run(Integrator& integrator, SpringArrays& body, double h) {
  int failed = 0;
  for (int k = 0; k < 8; ++k) failed += integrator.step(body.system(), body.motion(), h).ok() ? 0 : 1;
  return failed;
}

void expect_same_bits(const SpringArrays& a, const SpringArrays& b, const std::string& what) {
  for (std::size_t i = 0; i < a.x.size(); ++i) {
    ASSERT_EQ(a.x[i], b.x[i]) << what << ", vertex " << i;
    ASSERT_EQ(a.v[i], b.v[i]) << what << ", vertex " << i;
  }
}

TEST(MassScaling, ChangesNoBitOfAnyTrajectory) {
  for (const IntegratorEntry& entry : integrators()) {
    const auto plain = entry.make();
    // beyond the stability of explicit methods implicit ones have to work; those are run there too
    const double h = plain->scheme().implicit ? 0.05 : 0.004;
    SpringArrays expected = swinging_grid(0);
    EXPECT_EQ(run(*plain, expected, h), 0) << entry.name;
    for (const int exponent : exponents) {
      SpringArrays body = swinging_grid(exponent);
      const auto integrator = entry.make();
      EXPECT_EQ(run(*integrator, body, h), 0) << entry.name << " 2^" << exponent;
      expect_same_bits(body, expected, std::string(entry.name) + " 2^" + std::to_string(exponent));
    }
  }
}

TEST(MassScaling, ChangesNoBitWithAnySolver) {
  for (const LinearSolver solver :
       {LinearSolver::fresh_factor, LinearSolver::conjugate_gradients, LinearSolver::laplacian}) {
    ImplicitOptions options;
    options.solver = solver;
    options.max_iterations = 3000;
    BackwardEuler plain(options);
    SpringArrays expected = swinging_grid(0);
    EXPECT_EQ(run(plain, expected, 0.02), 0);
    for (const int exponent : exponents) {
      SpringArrays body = swinging_grid(exponent);
      BackwardEuler integrator(options);
      EXPECT_EQ(run(integrator, body, 0.02), 0);
      expect_same_bits(body, expected, std::to_string(static_cast<int>(solver)) + " 2^" + std::to_string(exponent));
    }
  }
}

TEST(MassScaling, ChangesNoBitOfTheLongestStableStep) {
  const auto integrator = make_integrator("verlet");
  StableStepEstimate plain;
  const SpringArrays original = swinging_grid(0);
  const StableStep expected = plain.refresh(original.system(), original.x);
  for (const int exponent : exponents) {
    SpringArrays body = swinging_grid(exponent);
    StableStepEstimate estimate;
    const StableStep limits = estimate.refresh(body.system(), body.x);
    EXPECT_EQ(limits.lower, expected.lower);
    EXPECT_EQ(limits.upper, expected.upper);
    EXPECT_TRUE(check_before_run(body.system(), body.motion(), integrator->scheme(), 1e-3, limits, {}).refused.ok());
  }
}

}  // namespace
}  // namespace dartboard::mass_scaling_test
