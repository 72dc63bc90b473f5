// Steps that change only the last digits of a motion: lost by a plain state and kept by a compensated one.

#include "core/time/explicit/compensated_splitting.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "core/time/integrators.h"
#include "core/time/watch/preflight.h"
#include "reference/closed_form.h"
#include "tests/support/spring_bodies_for_tests.h"

namespace dartboard::compensated_state_test {
namespace {

constexpr const char* compensated[]{"verlet-compensated", "blanes-moan-4-compensated"};

// A mass of 1 kg on a spring of length 2 and stiffness 4 at a wall, at q = 1/8 with velocity 1/4.
SpringArrays oscillator(double damping = 0.0) {
  SpringArrays body;
  body.add_vertex(1.0, {0, 0, 0}, {0, 0, 0}, true);
  body.add_vertex(1.0, {2.125, 0, 0}, {0.25, 0, 0});
  body.add_spring(0, 1, 4.0, 2.0, damping);
  return body;
}

void run(Integrator& integrator, SpringArrays& body, double h, int steps) {
  for (int k = 0; k < steps; ++k) ASSERT_TRUE(integrator.step(body.system(), body.motion(), h).ok());
}

double travelled(const char* name, double h, int steps) {
  SpringArrays body = oscillator();
  run(*make_integrator(name), body, h, steps);
  return body.x[1].x() - 2.125;
}

TEST(CompensatedState, MovesInStepsThatAreAllLostPlainly) {
  // a unit in the last place of x is 4.4e-16; steps of 1e-16 s move by 2.5e-17
  for (const char* plain : {"verlet", "blanes-moan-4"}) EXPECT_EQ(travelled(plain, 1e-16, 100000), 0.0) << plain;
  for (const double h : {1e-18, 1e-17, 1e-16, 1e-15, 1e-13}) {
    const int steps = 1000000;
    const double exact = static_cast<double>(0.25L * h * steps - 0.25L * (h * steps) * (h * steps));  // q'' = -1/2
    // half a unit in the last place of what is seen; each of two additions per step rounds its increment, and the sum
    // of an increment and lost digits of 2.2e-16 at most, to 2^-53
    const double bound = 0x1p-52 + 2 * steps * 0x1p-53 * (0.25 * h + 0x1p-52);
    EXPECT_NEAR(travelled("verlet-compensated", h, steps), exact, bound) << h;
  }
}

TEST(CompensatedState, KeepsWhatAnIncrementCoversUp) {
  // 2^-60 and an increment of 1: here it is the sum that does not fit into the result
  std::vector<Eigen::Vector3d> x{{0x1p-60, 0, 0}}, v{{1, 0, 0}};
  CompensatedState state;
  WorkCounters work;
  state.begin({x, v});
  state.drift(1.0);
  ASSERT_TRUE(state.commit({x, v}, work).ok());
  EXPECT_EQ(x[0].x(), 1.0);
  EXPECT_EQ(state.lost().x[0].x(), 0x1p-60);
}

TEST(CompensatedState, KeepsWhatDampingTakesInTinySteps) {
  SpringArrays body = oscillator(8.0), plain = body;
  run(*make_integrator("verlet"), plain, 1e-17, 10000);
  run(*make_integrator("blanes-moan-4-compensated"), body, 1e-17, 10000);
  EXPECT_EQ(plain.v[1].x(), 0.25);
  // v' = -1/2 - 8/4; the end is rounded to half a unit in the last place, 2.8e-17, and so is every increment to less
  EXPECT_NEAR(body.v[1].x() - 0.25, -2.5e-13, 0x1p-55 + 1e-13 * 1e-12);
}

TEST(CompensatedState, IsForgottenWhereSomebodyHasChangedTheMotion) {
  for (const char* name : compensated) {
    SpringArrays body = spring_grid(2, 1, 1);
    disturb(body, 0.004, 0.1);
    const auto used = make_integrator(name);
    run(*used, body, 0.001, 50);
    disturb(body, 0.004, 0.1, 2);
    SpringArrays other = body;
    run(*used, body, 0.001, 1);
    run(*make_integrator(name), other, 0.001, 1);
    EXPECT_EQ(std::memcmp(body.x.data(), other.x.data(), body.x.size() * sizeof(Eigen::Vector3d)), 0) << name;
    EXPECT_EQ(std::memcmp(body.v.data(), other.v.data(), body.v.size() * sizeof(Eigen::Vector3d)), 0) << name;
  }
}

TEST(CompensatedState, OutlivesRestartsAndStepsThatFail) {
  for (const char* name : compensated) {
    SpringArrays body = oscillator(), same = body;
    const auto integrator = make_integrator(name);
    run(*make_integrator(name), same, 1e-16, 1000);
    for (int k = 0; k < 1000; ++k) {
      if (k % 10 == 0) integrator->restart();
      if (k % 100 == 0) {
        EXPECT_FALSE(integrator->step(body.system(), body.motion(), 1e300).ok());
      }
      ASSERT_TRUE(integrator->step(body.system(), body.motion(), 1e-16).ok());
    }
    EXPECT_EQ(body.x[1].x(), same.x[1].x()) << name;
    EXPECT_NE(body.x[1].x(), 2.125) << name;
  }
}

TEST(CompensatedState, IsThePlainMethodToTheLastDigits) {
  for (const auto& [name, plain] :
       {std::pair{"verlet-compensated", "verlet"}, {"blanes-moan-4-compensated", "blanes-moan-4"}}) {
    SpringArrays body = spring_grid(2, 2, 1), other = body;
    disturb(body, 0.004, 0.1);
    disturb(other, 0.004, 0.1);
    run(*make_integrator(name), body, 0.001, 20);
    run(*make_integrator(plain), other, 0.001, 20);
    // 20 steps of at most 7 roundings of coordinates below 0.3, which forces carry to neighbours
    for (std::size_t i = 0; i < body.x.size(); ++i) EXPECT_LT((body.x[i] - other.x[i]).norm(), 20 * 7 * 0x1p-53) << i;
  }
}

TEST(CompensatedState, LeavesNothingToWarnOfInTinySteps) {
  SpringArrays body = oscillator();
  StableStepEstimate estimate;
  const StableStep limits = estimate.refresh(body.system(), body.x);
  for (const auto& [name, warned] : {std::pair{"verlet", true}, {"verlet-compensated", false}})
    EXPECT_EQ(check_before_run(body.system(), body.motion(), scheme_of(name), 1e-16, limits)
                  .warns_of(StepCode::step_underflow),
              warned)
        << name;
}

}  // namespace
}  // namespace dartboard::compensated_state_test
