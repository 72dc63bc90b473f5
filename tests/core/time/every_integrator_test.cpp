// Requirements on all sixteen integrators: a restart clears all memory, motion is the same in a moving frame, and work
// is counted as core/time/method/integrator.h says.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "core/time/implicit/bdf2.h"
#include "core/time/implicit/one_stage.h"
#include "core/time/integrators.h"
#include "tests/support/integrator_memory.h"
#include "tests/support/spring_bodies_for_tests.h"

namespace dartboard::every_integrator_test {
namespace {

using Eigen::Vector3d;

void run(Integrator& integrator, SpringArrays& body, double h, int steps) {
  for (int k = 0; k < steps; ++k) {
    const StepResult result = integrator.step(body.system(), body.motion(), h);
    ASSERT_TRUE(result.ok()) << integrator.scheme().name << ": " << to_string(result);
  }
}

double distance(const SpringArrays& a, const SpringArrays& b) {
  double largest = 0.0;
  for (std::size_t i = 0; i < a.x.size(); ++i)
    largest = std::max({largest, (a.x[i] - b.x[i]).norm() / 0.01, (a.v[i] - b.v[i]).norm()});
  return largest;
}

struct EveryIntegrator : testing::TestWithParam<std::string_view> {
  std::unique_ptr<Integrator> integrator = make_integrator(GetParam());
};

// ---- restarts

SpringArrays falling_grid() {
  SpringArrays body = spring_grid(2, 2, 1);
  body.gravity = {0, 0, -9.81};
  disturb(body, 0.004, 0.2);
  return body;
}

enum class Change { dampers, viscosity, holds, masses, stiffness };

// Changes only the last spring or vertex, so that a check of the first few does not see it.
void change(SpringArrays& body, Change what) {
  switch (what) {
    case Change::dampers: body.springs.back().damping += 0.5; break;
    case Change::viscosity: body.viscosity.back() += 0.1; break;
    case Change::holds: body.fixed.back() = 1; break;
    case Change::masses: body.set_mass(body.mass.size() - 1, 0.04); break;
    case Change::stiffness: body.springs.back().stiffness *= 2.0; break;
  }
}

// Explicit methods to the bit, except for the digits that compensated ones keep, below 2^-53; implicit ones to the
// residual of their tolerance of 1e-10 for velocities below 10 m/s, with a factor that was kept and updated. A step is
// 1e-3 s and the change shows: 4 % of one vertex's speed at least.
TEST_P(EveryIntegrator, IsAsNewAfterARestart) {
  for (const bool damped : {false, true})
    for (const Change what : {Change::dampers, Change::viscosity, Change::holds, Change::masses, Change::stiffness}) {
      SpringArrays used = falling_grid();
      if (damped) {
        for (Spring& s : used.springs) s.damping = 0.02;
        for (std::size_t i = 0; i < used.x.size(); ++i) used.viscosity[i] = 0.5 * used.mass[i];
      }
      integrator->restart();
      run(*integrator, used, 1e-3, 3);
      change(used, what);
      SpringArrays fresh = used;
      integrator->restart();
      run(*integrator, used, 1e-3, 3);
      run(*make_integrator(GetParam()), fresh, 1e-3, 3);
      const Scheme& scheme = integrator->scheme();
      const double allowed = scheme.implicit ? 1e-7 : scheme.compensated ? 1e-12 : 0.0;
      EXPECT_LE(distance(used, fresh), allowed) << (damped ? "damped, " : "") << static_cast<int>(what);
    }
}

// The same if the motion has changed: only methods of several steps would remember it.
TEST_P(EveryIntegrator, HasForgottenTheMotionBeforeARestart) {
  SpringArrays used = falling_grid();
  run(*integrator, used, 1e-3, 3);
  disturb(used, 0.002, 0.5, 7);
  SpringArrays fresh = used;
  integrator->restart();
  run(*integrator, used, 1e-3, 1);
  run(*make_integrator(GetParam()), fresh, 1e-3, 1);
  EXPECT_LE(distance(used, fresh), integrator->scheme().implicit ? 1e-7 : 0.0);
}

// ---- a frame that moves

// A mass on a spring whose other end is driven, and the same seen from there: the motion along the line is linear, so
// every method commutes with the change of the frame, whatever its error. 20 steps of a few roundings near 2, and for
// implicit methods 1e-10 of the motion, below 1 m/s.
TEST_P(EveryIntegrator, MovesAlikeInAFrameThatMoves) {
  const double speed = 0.5, h = 0.125, damping = 0.75;
  const auto body = [=](double frame) {
    SpringArrays arrays;
    const auto wall = arrays.add_vertex(1.0, {0, 0, 0}, {frame, 0, 0}, true);
    arrays.add_spring(wall, arrays.add_vertex(1.0, {2.125, 0, 0}, {0.25 + frame, 0, 0}), 4.0, 2.0, damping);
    return arrays;
  };
  SpringArrays still = body(0.0), moving = body(speed);
  const auto other = make_integrator(GetParam());
  for (int k = 1; k <= 20; ++k) {
    run(*integrator, still, h, 1);
    run(*other, moving, h, 1);
    EXPECT_NEAR(moving.x[0].x(), speed * h * k, 1e-13);
    EXPECT_EQ(moving.v[0], Vector3d(speed, 0, 0));
    EXPECT_NEAR(moving.x[1].x() - moving.x[0].x(), still.x[1].x(), 1e-8) << k;
    EXPECT_NEAR(moving.v[1].x() - speed, still.v[1].x(), 1e-8) << k;
  }
}

// A driven vertex should not be reversed without a restart, which a method of several steps needs. If it is, the vertex
// still has the velocity that it was given.
TEST(Bdf2, LeavesADrivenVertexTheVelocityThatItWasGiven) {
  SpringArrays body = falling_grid();
  body.fixed[3] = 1;
  body.v[3] = {0.5, 0, 0};
  Bdf2 integrator;
  run(integrator, body, 1e-3, 2);
  body.v[3] = {0, -0.25, 0};
  run(integrator, body, 1e-3, 1);
  EXPECT_EQ(body.v[3], Vector3d(0, -0.25, 0));
}

// A step of another length has no earlier state to continue from: it is one of backward Euler, solved to 1e-10 of the
// motion.
TEST(Bdf2, BeginsAgainWithAStepOfAnotherLength) {
  for (const double factor : {0.5, 1.01, 2.0}) {
    SpringArrays body = falling_grid();
    Bdf2 integrator;
    run(integrator, body, 1e-3, 2);
    SpringArrays other = body;
    run(integrator, body, factor * 1e-3, 1);
    BackwardEuler euler;
    run(euler, other, factor * 1e-3, 1);
    EXPECT_LE(distance(body, other), 1e-7) << factor;
    run(integrator, body, factor * 1e-3, 1);
    run(euler, other, factor * 1e-3, 1);
    EXPECT_GT(distance(body, other), 1e-4) << factor;  // and continues with two
  }
}

// The driven vertex is so fast that a long step takes it beyond the range of doubles, after the stage has been solved.
TEST(Bdf2, RemembersNothingOfAStepThatFails) {
  SpringArrays body;
  body.gravity = {0, 0, -8};
  body.add_vertex(1.0, {0, 0, 0}, {1e200, 0, 0}, true);
  body.add_vertex(1.0, {0, 0, 0}, {0, 0, 1});
  SpringArrays other = body;
  Bdf2 integrator, twin;
  run(integrator, body, 0.125, 2);
  EXPECT_EQ(integrator.step(body.system(), body.motion(), 1e150).code, StepCode::nonfinite);
  run(integrator, body, 0.125, 2);
  run(twin, other, 0.125, 4);
  EXPECT_EQ(body.x, other.x);
  EXPECT_EQ(body.v, other.v);
}

// ---- counts

TEST_P(EveryIntegrator, CountsItsSweepsOfDamping) {
  // one sweep for a flow of order 1, two for a symmetric one; four products for each kick of the others
  const std::map<std::string_view, unsigned> sweeps{{"symplectic-euler", 1},
                                                    {"verlet", 2},
                                                    {"verlet-compensated", 4},
                                                    {"blanes-moan-4", 4 * 6},
                                                    {"blanes-moan-4-compensated", 4 * 6}};
  SpringArrays body = falling_grid();
  for (Spring& s : body.springs) s.damping = 0.02;
  run(*integrator, body, 1e-3, 3);
  const auto known = sweeps.find(GetParam());
  EXPECT_EQ(integrator->work().damping_sweeps, known == sweeps.end() ? 0u : 3u * known->second);
}

TEST_P(EveryIntegrator, CountsItsForceEvaluations) {
  SpringArrays body = falling_grid();
  run(*integrator, body, 1e-3, 3);
  const WorkCounters& work = integrator->work();
  EXPECT_EQ(work.steps, 3u);
  EXPECT_EQ(work.failed_steps, 0u);
  const auto stages = static_cast<unsigned>(integrator->scheme().stages);
  if (!integrator->scheme().implicit || GetParam() == "ros2" || GetParam() == "baraff-witkin") {
    EXPECT_EQ(work.force_evaluations, 3u * stages);
    EXPECT_EQ(work.newton_iterations, GetParam() == "baraff-witkin" ? 3u : 0u);
  } else {  // at the start of each stage, and after each iteration
    EXPECT_GE(work.force_evaluations, 3u * stages + work.newton_iterations);
  }
}

TEST_P(EveryIntegrator, SaysThatAStepHasFailedAndCountsIt) {
  for (const double velocity : {std::nan(""), 1e308}) {
    SpringArrays body = falling_grid();
    body.v[4] = {velocity, velocity, 0};
    integrator->restart();
    integrator->reset_work();
    const SpringArrays before = body;
    StepResult result;
    for (int k = 0; k < 2 && result.ok(); ++k) result = integrator->step(body.system(), body.motion(), 1e3);
    EXPECT_FALSE(result.ok()) << velocity;
    EXPECT_EQ(integrator->work().failed_steps, 1u) << velocity;
  }
}

// Of six springs one is held at both ends, two at one.
TEST(MemoryOracle, TellSpringsBetweenFreeVerticesFromThoseHeldAtOneEnd) {
  SpringArrays body;
  for (int i = 0; i < 6; ++i) body.add_vertex(1.0, {1.0 * i, 0, 0}, {0, 0, 0}, i == 0 || i == 1);
  for (std::uint32_t i = 0; i < 5; ++i) body.add_spring(i, i + 1, 1.0, 1.0);
  body.add_spring(0, 5, 1.0, 5.0);
  const memory::SystemCounts counts = memory::counts_of(body.system());
  EXPECT_EQ(counts.vertices, 6u);
  EXPECT_EQ(counts.springs, 6u);
  EXPECT_EQ(counts.links, 3u);
  EXPECT_EQ(counts.anchors, 2u);
}

// `explain` reports them.
TEST_P(EveryIntegrator, HoldsTheColumnsThatItMust) {
  for (const bool damped : {false, true})
    for (const bool viscous : {false, true}) {
      SpringArrays body = falling_grid();
      if (damped) body.springs.back().damping = 0.02;
      if (viscous) body.viscosity.back() = 0.01;
      const auto own = make_integrator(GetParam());
      EXPECT_EQ(own->bytes(), own->solver_bytes());  // none before the first step
      run(*own, body, 1e-3, 2);
      EXPECT_EQ(own->bytes() - own->solver_bytes(),
                memory::predicted_integrator_bytes(GetParam(), memory::counts_of(body.system())))
          << damped << viscous;
    }
}

std::vector<std::string_view> names() {
  std::vector<std::string_view> all;
  for (const IntegratorEntry& entry : integrators()) all.push_back(entry.name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(All, EveryIntegrator, testing::ValuesIn(names()), [](const auto& tested) {
  std::string name(tested.param);
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace dartboard::every_integrator_test
