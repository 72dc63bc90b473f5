// Bodies of elements in time: every integrator, the solvers, the watchers.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/eigenvalues.h"
#include "core/time/integrators.h"
#include "core/time/system/energy.h"
#include "core/time/watch/divergence.h"
#include "core/time/watch/stable_step.h"
#include "tests/support/bodies/bar_of_elements_for_tests.h"

namespace dartboard::element_motion_test {
namespace {

using Eigen::Vector3d;

// Halving a step that resolves the fastest motion divides the error by 2^p, to the next term of its series.
TEST(ElementMotion, HasTheOrderOfEveryIntegrator) {
  const double duration = 0.02;
  for (const Model model : {Model::neo_hookean, Model::corotational}) {
    const ElementBody truth = run(bar(model, 0.0, true), "rk4", duration, 8192).body;
    for (const IntegratorEntry& entry : integrators()) {
      const auto method = make_integrator(entry.name);
      const Scheme& scheme = method->scheme();
      // it chooses its own steps, or its errors are rounding here
      if (scheme.compensated || std::string(entry.name) == "local-global") continue;
      const int coarse = scheme.order == 4 ? 64 : scheme.order == 5 ? 32 : 512;
      const BarOutcome first = run(bar(model, 0.0, true), entry.name, duration, coarse),
                       second = run(bar(model, 0.0, true), entry.name, duration, 2 * coarse);
      ASSERT_TRUE(first.result.ok() && second.result.ok()) << entry.name << ": " << to_string(first.result);
      const double order = std::log2(distance(first.body, truth) / distance(second.body, truth));
      EXPECT_NEAR(order, scheme.order, scheme.order >= 4 ? 0.35 : 0.15)
          << entry.name << ", " << name(model) << ": " << distance(first.body, truth) << ", "
          << distance(second.body, truth);
    }
  }
}

TEST(ElementMotion, KeepsLinearAndAngularMomentum) {
  for (const Model model : element_models)
    for (const char* integrator : {"verlet", "blanes-moan-4", "implicit-midpoint", "energy-momentum"}) {
      const ElementBody start = bar(model);
      const BarOutcome end = run(bar(model), integrator, 0.1, 400);
      ASSERT_TRUE(end.result.ok()) << integrator << ": " << to_string(end.result);
      const SpringSystem system = end.body.system();
      const Vector3d p = linear_momentum(system, start.v), l = angular_momentum(system, start.x, start.v);
      // explicit: roundings of 400 steps; implicit: Newton's residual, too, 1e-10 of an acceleration a step
      const double bound = std::string(integrator) == "implicit-midpoint" ? 1e-8 : 1e-12;
      EXPECT_LT((linear_momentum(system, end.body.v) - p).norm(), bound * p.norm()) << integrator << name(model);
      EXPECT_LT((angular_momentum(system, end.body.x, end.body.v) - l).norm(), bound * l.norm())
          << integrator << name(model);
    }
}

TEST(ElementMotion, KeepsItsEnergyWithEnergyMomentum) {
  for (const Model model : element_models) {
    const ElementBody start = bar(model);
    const double before = total_energy(start.system(), start.x, start.v);
    const BarOutcome end = run(bar(model), "energy-momentum", 0.2, 100);
    ASSERT_TRUE(end.result.ok()) << to_string(end.result);
    EXPECT_NEAR(total_energy(end.body.system(), end.body.x, end.body.v) / before, 1.0, 1e-11) << name(model);
  }
}

// Backward Euler dissipates energy in steps of any length; from a random shape, the body comes to rest.
TEST(ElementMotion, ComesToRestFromAnyShapeByImplicitSteps) {
  for (const Model model : {Model::neo_hookean, Model::corotational})
    for (const char* integrator : {"backward-euler", "local-global"}) {
      ElementBody body = bar(model, 0.0, true);
      body.shake(0.06, 3);  // inverts some
      for (std::size_t i = 0; i < body.x.size(); ++i)
        if (body.fixed[i]) body.x[i] = body.rest[i];
      double energy = total_energy(body.system(), body.x, body.v);
      const auto method = make_integrator(integrator);
      for (int k = 0; k < 300; ++k) {
        const StepResult result = method->step(body.system(), body.motion(), 0.05);
        ASSERT_TRUE(result.ok()) << integrator << ": " << to_string(result) << " in step " << k;
        const double now = total_energy(body.system(), body.x, body.v);
        EXPECT_LE(now, energy * (1.0 + 1e-9) + 1e-18) << integrator << ", step " << k;
        energy = now;
      }
      EXPECT_LT(distance(body, ElementBody(kuhn_box(3, 1, 2, 0.1, 0.15, 5), model, 2e4, 0.3)), 1e-4) << integrator;
    }
}

// The exact highest frequency, from the matrix entry by entry.
double highest_frequency(const ElementBody& body) {
  const SpringSystem system = body.system();
  BlockMatrix stiffness;
  stiffness.pattern = node_pattern_of(system);
  stiffness_of_terms(system, {{body.x}, TermTangents::Kind::projected}, stiffness);
  const auto n = static_cast<Eigen::Index>(3 * body.x.size());
  Eigen::MatrixXd dense(n, n);
  std::vector<Vector3d> unit(body.x.size(), Vector3d(0, 0, 0)), column(body.x.size());
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k / 3);
    unit[i][k % 3] = body.fixed[i] ? 0.0 : std::sqrt(body.inverse_mass[i]);
    stiffness.multiply(unit, column);
    unit[i][k % 3] = 0.0;
    for (std::size_t j = 0; j < column.size(); ++j)
      dense.block<3, 1>(3 * static_cast<Eigen::Index>(j), k) =
          body.fixed[j] ? Vector3d(0, 0, 0) : Vector3d(std::sqrt(body.inverse_mass[j]) * column[j]);
  }
  return std::sqrt(
      Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(dense, Eigen::EigenvaluesOnly).eigenvalues().maxCoeff());
}

TEST(ElementMotion, HasItsHighestFrequencyBracketed) {
  for (const Model model : element_models)
    for (const bool held : {false, true}) {
      const ElementBody body = bar(model, 0.0, held);
      const double omega = highest_frequency(body);
      StableStepEstimate estimate;
      StableStep limits = estimate.refresh(body.system(), body.x);
      EXPECT_GE(limits.upper, omega * (1.0 - 1e-12)) << name(model);
      EXPECT_LE(limits.upper, omega * 1.06) << name(model);
      for (int k = 0; k < 300; ++k) limits = estimate.follow(body.system(), body.x);
      EXPECT_NEAR(limits.lower / omega, 1.0, 0.002) << name(model);
      EXPECT_LE(limits.lower, omega * (1.0 + 1e-12)) << name(model);
      EXPECT_TRUE(std::isinf(quick_stable_step(body.system()).upper));
    }
}

TEST(ElementMotion, IsStableBelowItsLimitAndFoundOutAbove) {
  for (const Model model : {Model::neo_hookean, Model::corotational}) {
    ElementBody body(kuhn_box(3, 1, 2, 0.1, 0.15, 5), model, 2e4, 0.3);
    for (Vector3d& v : body.v) v = Vector3d(1e-6, 0, 0);
    body.shake(1e-7, 2);
    const double limit = StableStepEstimate().refresh(body.system(), body.x).limit(scheme_of("verlet")).stable;
    for (const double factor : {0.98, 1.08}) {
      ElementBody moving(kuhn_box(3, 1, 2, 0.1, 0.15, 5), model, 2e4, 0.3);
      moving.x = body.x;
      moving.v = body.v;
      const auto verlet = make_integrator("verlet");
      DivergenceDetector detector;
      ASSERT_TRUE(detector.start(moving.system(), moving.motion(), factor * limit).ok());
      StepResult result;
      for (int k = 0; k < 3000 && result.ok(); ++k) {
        result = verlet->step(moving.system(), moving.motion(), factor * limit);
        if (result.ok()) result = detector.after_step(moving.system(), moving.motion());
      }
      EXPECT_EQ(result.ok(), factor < 1.0) << name(model) << ": " << to_string(result);
    }
  }
}

// Drawn out slowly, a bar stores hundreds of times the energy at the beginning of the pull: without the work of the
// driven end the run would be called unstable.
TEST(ElementMotion, KnowsTheWorkOfDrivenVertices) {
  ElementBody body(kuhn_box(3, 1, 2, 0.1, 0.15, 5), Model::neo_hookean, 2e4, 0.3);
  const double speed = 0.05;
  double mass = 0.0;
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    body.fixed[i] = body.rest[i][0] < 1e-9 || body.rest[i][0] > 0.3 - 1e-9;
    if (body.rest[i][0] > 0.3 - 1e-9) body.v[i] = Vector3d(speed, 0, 0);
    mass += body.mass[i];
  }
  const auto verlet = make_integrator("verlet");
  DivergenceDetector detector;
  const double h = 5e-4;
  ASSERT_TRUE(detector.start(body.system(), body.motion(), h).ok());
  for (int k = 0; k < 8000; ++k) {
    ASSERT_TRUE(verlet->step(body.system(), body.motion(), h).ok());
    ASSERT_TRUE(detector.after_step(body.system(), body.motion()).ok()) << k;
  }
  // four times the kinetic energy of the whole at that speed, which is more than the detector starts from
  EXPECT_GT(elastic_energy(body.system(), body.x), 2.0 * DivergenceDetector::gain * 2.0 * mass * speed * speed);
}

}  // namespace
}  // namespace dartboard::element_motion_test
