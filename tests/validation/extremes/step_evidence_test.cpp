#include "validation/extremes/step_evidence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/plain/random.h"
#include "core/time/implicit/baraff_witkin.h"
#include "core/time/implicit/ros2.h"
#include "core/time/integrators.h"
#include "validation/extremes/extreme_run.h"
#include "validation/judges/wrong_integrators.h"
#include "validation/scenes/elastic_solid.h"

namespace dartboard::step_evidence_test {
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
  StepEvidence evidence(name, steps, elements_of(trial.body));
  for (std::uint64_t k = 0; k < steps; ++k) {
    evidence.before(trial.body.system(), trial.body.motion(), trial.h);
    // an unstable step leaves the range of doubles sooner or later; the steps before are judged
    if (!integrator.step(trial.body.system(), trial.body.motion(), trial.h).ok()) break;
    evidence.after(trial.body.motion());
  }
  return evidence;
}

// None of these runs was used when the bounds were made: they are drawn here.
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

constexpr Model laws[] = {Model::neo_hookean, Model::corotational, Model::stvk};

/// A solid of one law in a state and at a step that are drawn at random, its halves of different stiffness.
Trial draw_solid(SplitMix64& random, Model model, bool damped = false) {
  const auto power = [&random](double low, double high) {
    return std::pow(10.0, low + (high - low) * 0.5 * (1 + random.next_signed()));
  };
  const double nus[] = {0.0, 0.25, 0.4, 0.49};
  Material one{.density = 1.0, .young = 100.0, .poisson = nus[random.below(4)], .model = model};
  Material other = one;
  other.young *= power(0, 6);
  const std::string_view kind = elastic_bodies[random.below(2)];
  SpringColumns body = elastic_body(kind, one, other);
  const double omega = highest_frequency(body), size = power(-4, -0.5), fast = power(-3, 0);
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    body.x[i] += size * random.next_in_ball();
    body.v[i] += size * omega * fast * random.next_in_ball();
  }
  // e-folding in a step at most: of stronger decay only a difference of nearly equal numbers would remain
  const double h = power(-4, 3) / omega, rate = std::min(0.1 * omega, 1 / h);
  if (random.below(2) == 0)
    for (std::size_t i = 0; i < body.x.size(); ++i) body.viscosity[i] = rate * body.mass[i];
  if (random.below(3) == 0) body.fixed[0] = body.fixed[1] = body.fixed[5] = 1;
  for (std::size_t i = 0; i < body.x.size(); ++i)
    if (body.fixed[i]) body.v[i].setZero();
  if (damped) {
    // one half may have none; the fastest motion loses e^-3 in a step at most
    one.damping_time = std::min(power(-3, 1) / omega, 3 / (h * omega * omega));
    other.damping_time = random.below(3) == 0 ? 0.0 : power(-2, 0) * one.damping_time;
    const SpringColumns of_this = elastic_body(kind, one, other);
    body.solid = of_this.solid;
    body.terms = of_this.terms;
  }
  return {body, h};
}

TEST(LongStepEvidence, CallsEveryStepOfASoundIntegratorRightOverElements) {
  SplitMix64 random(2027);
  std::uint64_t steps = 0, seeing = 0;
  for (int k = 0; k < 48; ++k) {
    const Trial trial = draw_solid(random, laws[k % 3], k >= 24);
    for (const IntegratorEntry& entry : integrators()) {
      const StepEvidence evidence = judged(entry.name, *entry.make(), trial, 8);
      EXPECT_LE(evidence.worst(), 1.0) << entry.name << ", body " << k << ", step " << evidence.worst_step();
      steps += evidence.judged();
      seeing += evidence.seeing();
    }
  }
  EXPECT_GT(steps, 2000u);
  EXPECT_GT(seeing, 2000u);
}

// The body is damped by a time, and is judged with one of a millionth more, or with none. Eight steps, as local-global
// ends its iterations early: four of them may not show a millionth.
TEST(StepEvidence, TellsOneDampingOfElementsFromAnother) {
  for (const std::string_view kind : elastic_bodies) {
    Material right{.density = 1.0, .young = 100.0, .poisson = 0.3, .model = Model::neo_hookean};
    const double omega = highest_frequency(elastic_body(kind, right));
    right.damping_time = 0.2 / omega;
    Material more = right, none = right;
    more.damping_time *= 1 + 1e-6;
    none.damping_time = 0;
    SpringColumns body = elastic_body(kind, right);
    set_moving(body, 0.01, omega / 4);
    for (const IntegratorEntry& entry : integrators()) {
      EXPECT_LE(judged(entry.name, *entry.make(), {body, 0.3 / omega}, 4).worst(), 1.0) << entry.name << kind;
      for (const Material& other : {more, none}) {
        SpringColumns wrong = body;
        const SpringColumns keeps = elastic_body(kind, other);
        wrong.terms = {&keeps.solid->term()};
        EXPECT_GT(judged(entry.name, *entry.make(), {wrong, 0.3 / omega}, 8).worst(), 1.0) << entry.name << kind;
      }
    }
  }
}

TEST(StepEvidence, SeesEveryWrongIntegratorOverElements) {
  for (const Model model : laws) {
    SpringColumns body = elastic_body("tetrahedra", {.density = 1.0, .young = 100.0, .poisson = 0.3, .model = model});
    set_moving(body, 0.01, highest_frequency(body) / 4);
    const double h = 0.3 / highest_frequency(body);
    for (const WrongIntegrator& wrong : wrong_integrators())
      for (const IntegratorEntry& entry : integrators()) {
        // the others change springs and dampers
        if (wrong.kind != Wrong::does_nothing && wrong.kind != Wrong::one_order_less && wrong.kind != Wrong::drifts)
          continue;
        const StepEvidence evidence = judged(entry.name, *make_wrong(wrong.kind, entry.name), {body, h}, 4);
        EXPECT_GT(evidence.worst(), 1.0) << entry.name << " " << wrong.name << " " << name(model);
      }
  }
}

// The body moves by one law and is judged by another, or with a modulus of a millionth more.
TEST(StepEvidence, TellsOneElasticLawFromAnother) {
  const Material right{.density = 1.0, .young = 100.0, .poisson = 0.3, .model = Model::neo_hookean};
  Material stiffer = right, law = right;
  stiffer.young *= 1 + 1e-6;
  law.model = Model::corotational;
  SpringColumns body = elastic_body("tetrahedra", right);
  set_moving(body, 0.01, highest_frequency(body) / 4);
  const double h = 0.3 / highest_frequency(body);
  for (const IntegratorEntry& entry : integrators())
    for (const Material& other : {stiffer, law}) {
      SpringColumns wrong = body;
      const SpringColumns keeps = elastic_body("tetrahedra", other);
      wrong.terms = {&keeps.solid->term()};
      EXPECT_GT(judged(entry.name, *entry.make(), {wrong, h}, 4).worst(), 1.0) << entry.name << name(other.model);
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

TEST(StepEvidence, SupportsNoForceTermWithoutItsElements) {
  const SpringColumns body = elastic_body("tetrahedra", {.young = 100.0, .poisson = 0.3, .model = Model::stvk});
  EXPECT_TRUE(network_of(body.system(), elements_of(body)).has_value());
  EXPECT_FALSE(network_of(body.system()).has_value());
  SpringColumns held = moving_body("box");
  held.held_axes.assign(held.x.size(), HeldAxes{1});
  EXPECT_FALSE(network_of(held.system()).has_value());
}

// Every witness includes what pulls at vertices, and notices a pull that is a millionth off.
TEST(StepEvidence, IncludesForcesFromOutside) {
  const SpringColumns body = moving_body("box");
  const double omega = highest_frequency(body), h = 0.3 / omega;
  std::vector<Eigen::Vector3d> pull(body.x.size(), Eigen::Vector3d(0, 0, 0));
  for (std::size_t i = 0; i < pull.size(); i += 3) pull[i] = {0.02 * omega * omega, 0, -0.01 * omega * omega};
  for (const IntegratorEntry& entry : integrators())
    for (const bool is_right : {true, false}) {
      std::vector<Eigen::Vector3d> acting = pull;
      if (!is_right)
        for (Eigen::Vector3d& p : acting) p *= 1 + 1e-6;
      SpringColumns moved = body;
      const auto integrator = entry.make();
      StepEvidence evidence(entry.name, 4);
      for (int k = 0; k < 4; ++k) {
        SpringSystem system = moved.system(), in_truth = system;
        system.pull = acting;
        in_truth.pull = pull;
        evidence.before(in_truth, moved.motion(), h);
        ASSERT_TRUE(integrator->step(system, moved.motion(), h).ok()) << entry.name;
        evidence.after(moved.motion());
      }
      EXPECT_GT(evidence.judged(), 0u) << entry.name;
      EXPECT_EQ(evidence.worst() <= 1.0, is_right) << entry.name << " " << evidence.worst();
    }
}

// Damping leaves next to nothing of a velocity in one step: its digits are those of what there was.
TEST(StepEvidence, CallsAStepRightThatDecaysToNothing) {
  SpringColumns body = moving_body("box");
  const double h = 1e3 / highest_frequency(body);
  for (std::size_t i = 0; i < body.mass.size(); ++i) body.viscosity[i] = 250 / h * body.mass[i];
  body.gravity = {0, 0, -9.81};
  const Trial trial{body, h};
  EXPECT_LE(judged("symplectic-euler", *make_integrator("symplectic-euler"), trial, 1).worst(), 1.0);
}

// After an event the memory of a method is of no use, to the judge as to the method.
TEST(StepEvidence, StartsAnewWhereTheIntegratorDoes) {
  SpringColumns body = moving_body("chain");
  const double h = 0.3 / highest_frequency(body);
  const auto worst = [&](bool restarts) {
    SpringColumns b = body;
    const auto bdf2 = make_integrator("bdf2");
    StepEvidence evidence("bdf2", 6);
    for (int k = 0; k < 6; ++k) {
      if (k == 3) {
        bdf2->restart();
        b.springs[0].stiffness *= 2;
        if (restarts) evidence.restarted();
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
}  // namespace dartboard::step_evidence_test
