#include "validation/extremes/step_evidence.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/plain/random.h"
#include "core/time/implicit/baraff_witkin.h"
#include "core/time/implicit/ros2.h"
#include "core/time/integrators.h"
#include "validation/extremes/extreme_run.h"
#include "validation/judges/wrong_integrators.h"

namespace dartboard {
namespace {

struct Trial {
  SpringColumns body;
  double h;
};

/// A body of the matrix in a state, with stiffnesses, masses and damping, and at a step that are drawn at random.
Trial draw(SplitMix64& random) {
  const auto power = [&random](double low, double high) {
    return std::pow(10.0, low + (high - low) * 0.5 * (1 + random.next_signed()));
  };
  SpringColumns body = extreme_body(extreme_bodies[random.below(4)]);
  const double stiff = power(0, 8), heavy = power(0, 4);
  for (Spring& s : body.springs) s.stiffness *= std::pow(stiff, 0.5 * random.next_signed());
  for (std::size_t i = 0; i < body.mass.size(); ++i) body.set_mass(i, std::pow(heavy, 0.5 * random.next_signed()));
  const double omega = highest_frequency(body), zeta = random.below(2) == 0 ? 0.0 : power(-3, 1);
  for (Spring& s : body.springs) s.damping = 2 * zeta / omega * s.stiffness;
  if (random.below(3) == 0) body.gravity = {0, 0, -power(-2, 1)};
  const double size = power(-4, -0.5), fast = power(-3, 0);
  for (std::size_t i = 0; i < body.x.size(); ++i)
    if (!body.fixed[i]) {
      body.x[i] += size * random.next_in_ball();
      body.v[i] += size * omega * fast * random.next_in_ball();
    }
  return {body, power(-5, 4) / omega};
}

StepEvidence judged(std::string_view name, Integrator& integrator, Trial trial, std::uint64_t steps) {
  StepEvidence evidence(name, steps);
  for (std::uint64_t k = 0; k < steps; ++k) {
    evidence.before(trial.body.system(), trial.body.motion(), trial.h);
    // an unstable step leaves the range of doubles sooner or later; what comes before is judged
    if (!integrator.step(trial.body.system(), trial.body.motion(), trial.h).ok()) break;
    evidence.after(trial.body.motion());
  }
  return evidence;
}

// None of these runs was looked at when the bounds were made: they are drawn here.
TEST(StepEvidence, CallsEveryStepOfASoundIntegratorRight) {
  SplitMix64 random(2026);
  std::uint64_t steps = 0;
  for (int k = 0; k < 40; ++k) {
    const Trial trial = draw(random);
    for (const IntegratorEntry& entry : integrators()) {
      const StepEvidence evidence = judged(entry.name, *entry.make(), trial, 12);
      EXPECT_LE(evidence.worst(), 1.0) << entry.name << ", body " << k << ", step " << evidence.worst_step();
      steps += evidence.judged();
    }
  }
  EXPECT_GT(steps, 3000u);
}

TEST(StepEvidence, SeesEveryWrongIntegratorInEveryMethod) {
  const SpringColumns damped = [] {
    SpringColumns body = moving_body("box");
    for (Spring& s : body.springs) s.damping = 1e-3 * s.stiffness;
    return body;
  }();
  const double h = 0.3 / highest_frequency(damped);
  for (const WrongIntegrator& wrong : wrong_integrators())
    for (const IntegratorEntry& entry : integrators()) {
      const StepEvidence evidence = judged(entry.name, *make_wrong(wrong.kind, entry.name), {damped, h}, 4);
      // energy-momentum finds no solution where springs push
      EXPECT_TRUE(evidence.worst() > 1.0 || evidence.judged() == 0) << entry.name << " " << wrong.name;
      EXPECT_TRUE(evidence.judged() > 0 || wrong.kind == Wrong::wrong_sign) << entry.name << " " << wrong.name;
    }
}

// Compressed springs, in steps so short that the exact matrix is positive definite: there is no reason to project.
TEST(StepEvidence, TellsProjectedTangentsFromExactOnes) {
  SpringColumns body = moving_body("box");
  for (auto& p : body.x) p *= 0.9;
  const Trial trial{body, 0.5 / highest_frequency(body)};
  const ImplicitOptions projected{.tangent = TangentPolicy::projected};
  BaraffWitkin exact_steps, projected_steps(projected);
  Ros2 exact_stages, projected_stages(projected);
  EXPECT_LE(judged("baraff-witkin", exact_steps, trial, 5).worst(), 1.0);
  EXPECT_GT(judged("baraff-witkin", projected_steps, trial, 5).worst(), 1.0);
  EXPECT_LE(judged("ros2", exact_stages, trial, 5).worst(), 1.0);
  EXPECT_GT(judged("ros2", projected_stages, trial, 5).worst(), 1.0);
}

TEST(StepEvidence, JudgesTheFirstStepsAndASampleOfTheOthers) {
  const Trial trial{moving_body("oscillator"), 1e-3};
  EXPECT_EQ(judged("rk4", *make_integrator("rk4"), trial, 60).judged(), 60u);
  EXPECT_EQ(judged("rk4", *make_integrator("rk4"), trial, 4000).judged(), 7u + 4000 / 20);
  EXPECT_EQ(judged("ros2", *make_integrator("ros2"), trial, 60).judged(), 8u + 10);
}

// What a method kept from before an event is of no use behind it, to the judge as to the method.
TEST(StepEvidence, StartsAnewWhereTheIntegratorDoes) {
  SpringColumns body = moving_body("chain");
  const double h = 0.3 / highest_frequency(body);
  const auto worst = [&](bool told) {
    SpringColumns b = body;
    const auto bdf2 = make_integrator("bdf2");
    StepEvidence evidence("bdf2", 6);
    for (int k = 0; k < 6; ++k) {
      if (k == 3) {
        bdf2->restart();
        b.springs[0].stiffness *= 2;
        if (told) evidence.restarted();
      }
      evidence.before(b.system(), b.motion(), h);
      EXPECT_TRUE(bdf2->step(b.system(), b.motion(), h).ok());
      evidence.after(b.motion());
    }
    return evidence.worst();
  };
  EXPECT_LE(worst(true), 1.0);
  EXPECT_GT(worst(false), 1.0);
}

TEST(NetworkOf, KnowsNoBodiesThatTheWitnessesCannotMove) {
  SpringColumns body = moving_body("box");
  EXPECT_TRUE(network_of(body.system()).has_value());
  SpringColumns massless = body;
  massless.set_mass(1, 0.0);
  EXPECT_FALSE(network_of(massless.system()).has_value());
  massless.fixed[1] = 1;
  EXPECT_TRUE(network_of(massless.system()).has_value());
  SpringColumns viscous = body;
  for (std::size_t i = 0; i < viscous.mass.size(); ++i) viscous.viscosity[i] = 0.5 * viscous.mass[i];
  ASSERT_TRUE(network_of(viscous.system()).has_value());
  EXPECT_EQ(network_of(viscous.system())->viscosity, 0.5);
  viscous.viscosity[3] *= 2;
  EXPECT_FALSE(network_of(viscous.system()).has_value());
  body.springs[2].stiffness = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(network_of(body.system()).has_value());
}

}  // namespace
}  // namespace dartboard
