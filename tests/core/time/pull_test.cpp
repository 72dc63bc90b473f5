// Forces from outside in the time loop: one acceleration for all vertices is gravity, for all integrators and watchers.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "core/time/integrators.h"
#include "core/time/system/energy.h"
#include "core/time/watch/divergence.h"
#include "core/time/watch/preflight.h"
#include "core/time/watch/stable_step.h"
#include "tests/support/spring_bodies_for_tests.h"

namespace dartboard::pull_test {
namespace {

using Eigen::Vector3d;

/// A body that hangs and swings, and the same with all its weight as forces from outside.
struct Hanging {
  SpringArrays body = spring_grid(2, 1, 1);
  std::vector<Vector3d> pull;
  explicit Hanging(bool pulled) {
    body.fixed[0] = body.fixed[3] = 1;
    disturb(body, 0.004, 0.2);
    body.v[0] = body.v[3] = {0, 0, 0};
    const Vector3d down(1, 2, -9.81);
    if (pulled)
      pull.assign(body.x.size(), down);
    else
      body.gravity = down;
  }
  SpringSystem system() const {
    SpringSystem system = body.system();
    system.pull = pull;
    return system;
  }
};

TEST(Pull, OfTheSameAccelerationEverywhereIsGravityForEveryIntegrator) {
  for (const IntegratorEntry& entry : integrators()) {
    Hanging heavy(false), pulled(true);
    for (Hanging* one : {&heavy, &pulled}) {
      const auto integrator = make_integrator(entry.name);
      for (int k = 0; k < 20; ++k)
        ASSERT_TRUE(integrator->step(one->system(), one->body.motion(), 1e-3).ok()) << entry.name;
    }
    // sums in another order: a few roundings a step; implicit methods solve to 1e-10 of what a step changes
    constexpr double off = 1e-10;
    for (std::size_t i = 0; i < heavy.body.x.size(); ++i) {
      EXPECT_LE((heavy.body.x[i] - pulled.body.x[i]).norm(), off * 0.02) << entry.name << ", vertex " << i;
      EXPECT_LE((heavy.body.v[i] - pulled.body.v[i]).norm(), off) << entry.name << ", vertex " << i;
    }
  }
}

TEST(Pull, HasThePotentialThatTheSameWeightHas) {
  const Hanging heavy(false), pulled(true);
  const double weight = gravity_energy(heavy.system(), heavy.body.x);
  EXPECT_GT(std::abs(weight), 1e-3);
  EXPECT_NEAR(pull_energy(pulled.system(), pulled.body.x), weight, 1e-14);
  EXPECT_EQ(gravity_energy(pulled.system(), pulled.body.x), 0.0);
  EXPECT_NEAR(total_energy(pulled.system(), pulled.body.x, pulled.body.v),
              total_energy(heavy.system(), heavy.body.x, heavy.body.v), 1e-14);
}

// It falls for 2 s, and has then 10^4 times the energy that it began with.
TEST(Pull, DoesWorkThatIsNoDivergence) {
  Hanging one(true);
  for (auto& fixed : one.body.fixed) fixed = 0;
  DivergenceDetector detector;
  const auto integrator = make_integrator("verlet");
  ASSERT_TRUE(detector.start(one.system(), one.body.motion(), 1e-3).ok());
  for (int k = 0; k < 2000; ++k) {
    ASSERT_TRUE(integrator->step(one.system(), one.body.motion(), 1e-3).ok());
    ASSERT_TRUE(detector.after_step(one.system(), one.body.motion()).ok()) << k;
  }
  EXPECT_TRUE(detector.check_all(one.system(), one.body.motion()).ok());
}

/// A vertex that is held, and one on a spring to it that weighs nothing else.
SpringArrays one_on_a_spring(const Vector3d& velocity_of_held) {
  SpringArrays body;
  body.add_vertex(1.0, {0, 0, 0}, velocity_of_held, true);
  body.add_vertex(1.0, {1, 0, 0});
  body.add_spring(0, 1, 1.0, 1.0);
  return body;
}

// Lifting a driven vertex against 10 N for a metre does work of 10 J, which may become energy of the body.
TEST(Pull, IsWhatADrivenVertexWorksAgainst) {
  for (const bool pulled : {false, true}) {
    SpringArrays body = one_on_a_spring({1e-2, 0, 0});
    const std::vector<Vector3d> pull(2, Vector3d(pulled ? -10.0 : 0.0, 0, 0));
    const auto system = [&] {
      SpringSystem s = body.system();
      s.pull = pull;
      return s;
    };
    DivergenceDetector detector;
    ASSERT_TRUE(detector.start(system(), body.motion(), 0.1).ok());
    for (int k = 0; k < 2000; ++k) {
      body.v[0].x() = k < 1000 ? 1e-2 : -1e-2;
      for (Vector3d& x : body.x) x += 0.1 * body.v[0];  // lifted and lowered as a whole: no spring is stretched
      body.v[1].setZero();
      ASSERT_TRUE(detector.after_step(system(), body.motion()).ok()) << k;
    }
    // a hundred times the available energy is a divergence: these 10 J, and 4 J that a first step may be off by
    body.v[1] = {40, 0, 0};  // 800 J
    EXPECT_EQ(detector.check_all(system(), body.motion()).ok(), pulled);
  }
}

TEST(Pull, ThatIsNoNumberIsNamedBeforeARun) {
  Hanging one(true);
  one.pull[2].y() = std::numeric_limits<double>::quiet_NaN();
  const StableStep limits = StableStepEstimate().refresh(one.system(), one.body.x);
  const Preflight found = check_before_run(one.system(), one.body.motion(), scheme_of("rk4"), 1e-3, limits);
  EXPECT_EQ(found.refused.code, StepCode::nonfinite);
  EXPECT_EQ(found.refused.number, 2u);
  EXPECT_EQ(found.refused.quantity, "force");
}

}  // namespace
}  // namespace dartboard::pull_test
