// Unstable runs are distinguished from stable ones, early, with every explicit method; and NaN is found.

#include "core/time/watch/divergence.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/time/integrators.h"
#include "core/time/method/trial_state.h"
#include "core/time/system/energy.h"
#include "core/time/watch/stable_step.h"
#include "tests/support/spring_bodies_for_tests.h"

namespace dartboard::divergence_test {
namespace {

constexpr const char* explicit_methods[]{"symplectic-euler", "verlet", "blanes-moan-4", "rk4", "dormand-prince-54"};

struct Watched {
  StepResult result;
  std::uint64_t steps = 0;
};
/// Steps of h until the detector, or the step itself, objects.
Watched run(SpringArrays& body, Integrator& integrator, double h, std::uint64_t steps, DivergenceDetector& detector) {
  Watched w;
  w.result = detector.start(body.system(), body.motion(), h);
  for (; w.result.ok() && w.steps < steps; ++w.steps) {
    w.result = integrator.step(body.system(), body.motion(), h);
    w.result = w.result.ok() ? detector.after_step(body.system(), body.motion())
                             : detector.with_witness(w.result, body.system(), body.motion());
  }
  return w;
}

SpringArrays moving_grid(unsigned seed = 1) {
  SpringArrays body = spring_grid(2, 2, 2);
  disturb(body, 0.002, 0.05, seed);
  return body;
}

double limit(const SpringArrays& body, const char* name) {
  StableStepEstimate estimate;
  const StableStep& step = estimate.refresh(body.system(), body.x);
  return scheme_of(name).imaginary_limit / step.lower;
}

TEST(Divergence, IsFoundWithin64StepsOfAnyUnstableRun) {
  for (const char* name : explicit_methods)
    for (const double factor : {1.2, 2.0, 10.0, 1e3, 1e6, 1e8}) {
      // closer to the limit growth is slow, and may saturate as large motions soften the body;
      // weak growth, or a gap of stability above the first limit: nothing to find within 64 steps
      const std::string_view method = name;
      if (factor < 4.0 && (method == "dormand-prince-54" || method == "blanes-moan-4")) continue;
      SpringArrays body = moving_grid();
      DivergenceDetector detector;
      const auto integrator = make_integrator(name);
      const Watched w = run(body, *integrator, factor * limit(body, name), 1000, detector);
      EXPECT_FALSE(w.result.ok()) << name << " " << factor;
      EXPECT_LE(w.steps, 64u) << name << " " << factor << ": " << to_string(w.result);
      EXPECT_NE(w.result.witness, Witness::none) << name << " " << factor;
      EXPECT_TRUE(w.result.code == StepCode::unstable_step || w.result.code == StepCode::nonfinite);
    }
}

TEST(Divergence, IsNotFoundInAStableRunCloseToTheLimit) {
  for (const char* name : explicit_methods) {
    SpringArrays body = moving_grid();
    DivergenceDetector detector;
    const auto integrator = make_integrator(name);
    EXPECT_TRUE(run(body, *integrator, 0.95 * limit(body, name), 3000, detector).result.ok()) << name;
  }
}

TEST(Divergence, LeavesTheLastGoodStateToGoBackTo) {
  SpringArrays body = moving_grid();
  const double energy = total_energy(body.system(), body.x, body.v);
  DivergenceDetector detector;
  const auto integrator = make_integrator("verlet");
  const Watched w = run(body, *integrator, 1.1 * limit(body, "verlet"), 1000, detector);
  ASSERT_EQ(w.result.code, StepCode::unstable_step);
  EXPECT_GT(kinetic_energy(body.system(), body.v), 50 * energy);
  EXPECT_LE(detector.restore(body.motion()), w.steps);
  EXPECT_LE(kinetic_energy(body.system(), body.v), 2 * energy * (1 + 1e-12));
}

TEST(Divergence, LeavesAGoodStateHoweverSlowlyItGrows) {
  // A pair that grows by sqrt(8 excess) a step next to one that has the energy: from 2 to 100 times as much takes 125
  // and 220 steps, and a state is kept after 64.
  for (const double excess : {1e-5, 3e-5}) {
    SpringArrays body = two_masses(1.0, 1.0, 100.0, 1e-4);
    body.add_vertex(1.0, {0, 9, 0});
    body.add_vertex(1.0, {3, 9, 0});
    body.add_spring(2, 3, 1.0, 2.0);
    const double energy = total_energy(body.system(), body.x, body.v);
    DivergenceDetector detector;
    const auto integrator = make_integrator("verlet");
    const Watched w = run(body, *integrator, (1.0 + excess) * limit(body, "verlet"), 1000, detector);
    ASSERT_EQ(w.result.code, StepCode::unstable_step) << excess;
    detector.restore(body.motion());
    EXPECT_LE(kinetic_energy(body.system(), body.v), 2 * energy * (1 + 1e-12)) << excess;
  }
}

TEST(Divergence, HappensBeforeAnythingOverflows) {
  for (const double factor : {1.2, 5.0, 1e4, 1e8}) {
    SpringArrays body = moving_grid();
    DivergenceDetector detector;
    const auto integrator = make_integrator("rk4");
    run(body, *integrator, factor * limit(body, "rk4"), 1000, detector);
    EXPECT_TRUE(std::isfinite(kinetic_energy(body.system(), body.v))) << factor;
  }
}

TEST(Divergence, IsNotWhatGravityAndDrivenVerticesDo) {
  for (const char* name : {"explicit-euler", "symplectic-euler", "verlet", "rk4"}) {
    SpringArrays falling = spring_grid(1, 1, 1);
    falling.gravity = {0, 0, -9.81};
    DivergenceDetector detector;
    const auto integrator = make_integrator(name);
    EXPECT_TRUE(run(falling, *integrator, 1e-3, 200, detector).result.ok()) << name;

    SpringArrays driven = spring_grid(2, 1, 1);
    driven.fixed[0] = 1;
    driven.v[0] = {3, 0, 0};
    integrator->restart();
    EXPECT_TRUE(run(driven, *integrator, 1e-3, 200, detector).result.ok()) << name;
  }
}

/// A grid held at one end, its other end moved away.
SpringArrays pulled_grid(double speed, double damping) {
  SpringArrays body = spring_grid(3, 2, 2, 50.0, damping, 0.0);
  for (std::size_t i = 0; i < body.x.size(); ++i) {
    body.fixed[i] = body.x[i].x() < 0.01 || body.x[i].x() > 0.29;
    if (body.x[i].x() > 0.29) body.v[i] = {speed, 0, 0};
  }
  return body;
}

TEST(Divergence, IsNotTheWorkOfDrivenVertices) {
  // From 0.3 m to 0.9 m: if the plate is slow, the springs hold far more than 100 times the kinetic energy. Through
  // strong dampers the work goes into springs far from the plate.
  struct Pull {
    double speed, damping;
    const char* integrator;
  };
  for (const Pull& pull : {Pull{0.05, 0.0, "rk4"}, Pull{1.0, 0.0, "rk4"}, Pull{20.0, 0.0, "rk4"},
                           Pull{1.0, 20.0, "backward-euler"}, Pull{20.0, 20.0, "backward-euler"}}) {
    SpringArrays body = pulled_grid(pull.speed, pull.damping);
    DivergenceDetector detector;
    const auto integrator = make_integrator(pull.integrator);
    const double h = std::min(1e-3, 0.006 / pull.speed);
    const auto steps = static_cast<std::uint64_t>(std::round(0.6 / pull.speed / h));
    const Watched w = run(body, *integrator, h, steps, detector);
    EXPECT_TRUE(w.result.ok()) << pull.speed << " m/s, " << pull.integrator << ": " << to_string(w.result);
    EXPECT_TRUE(detector.check_all(body.system(), body.motion()).ok()) << pull.speed << " m/s, " << pull.integrator;
    EXPECT_GT(elastic_energy(body.system(), body.x), 20.0) << pull.speed << " m/s, " << pull.integrator;
  }
}

TEST(Divergence, IsFoundWhileVerticesAreDriven) {
  for (const char* name : {"symplectic-euler", "verlet", "rk4"})
    for (const double speed : {0.05, 1.0, 20.0})
      for (const double factor : {1.2, 2.0, 10.0}) {
        SpringArrays body = pulled_grid(speed, 0.0);
        disturb(body, 0.002, 0.05);
        DivergenceDetector detector;
        const auto integrator = make_integrator(name);
        const Watched w = run(body, *integrator, factor * limit(body, name), 1000, detector);
        EXPECT_FALSE(w.result.ok()) << name << " " << speed << " " << factor;
        EXPECT_LE(w.steps, 64u) << name << " " << speed << " " << factor << ": " << to_string(w.result);
      }
}

TEST(Divergence, IsNotTheRoundingOfABodyAtRestFarAway) {
  for (const double offset : {0.0, 1e3, 1e9}) {
    SpringArrays body = spring_grid(2, 2, 2);
    for (Eigen::Vector3d& p : body.x) p.array() += offset;
    DivergenceDetector detector;
    const auto integrator = make_integrator("verlet");
    EXPECT_TRUE(run(body, *integrator, 1e-3, 500, detector).result.ok()) << offset;
  }
}

// At a height of 5e6 m a body that has fallen by less than an ulp has lost no computed gravitational energy yet.
TEST(Divergence, IsNotTheFallOfABodyWhoseHeightIsKnownToNoMoreThanThat) {
  for (const double offset : {5e6, 1e9, 1e12}) {
    SpringArrays body = spring_grid(2, 2, 2);
    for (Eigen::Vector3d& p : body.x) p.z() += offset;
    body.gravity = {0, 0, -9.81};
    DivergenceDetector detector;
    const auto integrator = make_integrator("verlet");
    EXPECT_TRUE(run(body, *integrator, 1e-6, 500, detector).result.ok()) << offset;
  }
}

TEST(Divergence, IsFoundWhenTheSystemChangesAfterEveryStep) {
  SpringArrays body = moving_grid();
  DivergenceDetector detector;
  const auto integrator = make_integrator("verlet");
  const double h = 1.1 * limit(body, "verlet");
  StepResult result = detector.start(body.system(), body.motion(), h);
  int steps = 0;
  for (; result.ok() && steps < 1000; ++steps) {
    result = integrator->step(body.system(), body.motion(), h);
    if (result.ok()) result = detector.after_step(body.system(), body.motion());
    if (result.ok()) result = detector.system_changed(body.system(), body.motion());
  }
  EXPECT_EQ(result.code, StepCode::unstable_step);
  EXPECT_LE(steps, 64);
}

TEST(Divergence, NamesANumberThatIsNoneInjectedInMidRun) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, infinity, -infinity})
    for (const bool position : {true, false})
      for (const IntegratorEntry& entry : integrators()) {
        SpringArrays body = moving_grid();
        const auto integrator = entry.make();
        DivergenceDetector detector;
        ASSERT_TRUE(run(body, *integrator, 1e-4, 20, detector).result.ok()) << entry.name;
        (position ? body.x : body.v)[5][1] = bad;
        StepResult result;
        for (int k = 0; k < 17 && result.ok(); ++k) {
          result = integrator->step(body.system(), body.motion(), 1e-4);
          result = result.ok() ? detector.after_step(body.system(), body.motion())
                               : detector.with_witness(result, body.system(), body.motion());
        }
        EXPECT_FALSE(result.ok()) << entry.name << " " << bad;
        EXPECT_NE(result.witness, Witness::none) << entry.name << " " << bad << " " << to_string(result);
        detector.restore(body.motion());
        EXPECT_TRUE(check_finite(body.x, body.v).ok()) << entry.name;
      }
}

/// A careless method: it keeps the larger of two numbers, which a NaN passes, and reports success.
class Launderer : public Integrator {
 public:
  const Scheme& scheme() const override { return scheme_of("verlet"); }
  StepResult step(const SpringSystem&, Motion motion, double) override {
    double residual = 0.0;
    motion.v[3][2] = std::numeric_limits<double>::quiet_NaN();
    for (const Eigen::Vector3d& v : motion.v) residual = std::max(residual, std::abs(v[2]));
    return residual < 1e3 ? StepResult{} : StepResult{StepCode::newton_stalled, Witness::none, 0, "residual", residual};
  }
};

TEST(Divergence, FindsANaNThatAMaximumHasLaundered) {
  SpringArrays body = moving_grid();
  DivergenceDetector detector;
  ASSERT_TRUE(detector.start(body.system(), body.motion(), 1e-3).ok());
  Launderer launderer;
  ASSERT_TRUE(launderer.step(body.system(), body.motion(), 1e-3).ok());
  const StepResult result = detector.after_step(body.system(), body.motion());
  EXPECT_EQ(result.code, StepCode::nonfinite);
  EXPECT_EQ(result.number, 3u);
  EXPECT_EQ(result.quantity, "velocity");
}

TEST(Divergence, RefusesToStartFromWhatIsNotFinite) {
  SpringArrays body = moving_grid();
  DivergenceDetector detector;
  body.springs[4].stiffness = std::numeric_limits<double>::infinity();
  const StepResult result = detector.start(body.system(), body.motion(), 1e-3);
  EXPECT_EQ(result.code, StepCode::nonfinite);
  EXPECT_EQ(result.witness, Witness::edge);
  EXPECT_EQ(result.number, 4u);
}

TEST(Divergence, IsFoundInWhatIsOverdamped) {
  // strong dampers prevent fast motion: the energy is that of the springs
  SpringArrays body = spring_grid(2, 2, 2);
  for (Spring& s : body.springs) s.damping = 1e3 * s.stiffness;
  DivergenceDetector detector;
  ASSERT_TRUE(detector.start(body.system(), body.motion(), 1e-3).ok());
  for (Eigen::Vector3d& p : body.x) p *= 3.0;
  EXPECT_EQ(detector.after_step(body.system(), body.motion()).code, StepCode::unstable_step);
  EXPECT_EQ(detector.check_all(body.system(), body.motion()).code, StepCode::unstable_step);
}

TEST(Divergence, IsNotFoundWhereOneSpringHoldsAllEnergyCloseToTheLimit) {
  SpringArrays body = spring_grid(4, 4, 4);
  body.springs[100].stiffness *= 1e4;
  const double h = 0.95 * limit(body, "verlet");
  body.x[body.ends[100][0]] += 0.001 * (body.x[body.ends[100][1]] - body.x[body.ends[100][0]]);
  DivergenceDetector detector;
  const auto integrator = make_integrator("verlet");
  EXPECT_TRUE(run(body, *integrator, h, 2000, detector).result.ok());
}

/// Two masses without a spring: 1 kg and 100 kg, at 1 m/s and at rest.
SpringArrays two_strangers() {
  SpringArrays body;
  body.add_vertex(1.0, {0, 0, 0}, {1, 0, 0});
  body.add_vertex(100.0, {5, 0, 0});
  return body;
}

// Ten times in amplitude, and there is a check after the first step.
TEST(Divergence, IsAHundredTimesTheEnergyThatThereWas) {
  for (const auto& [speed, fine] : {std::pair{9.99, true}, {10.01, false}}) {
    SpringArrays body = two_strangers();
    DivergenceDetector detector;
    ASSERT_TRUE(detector.start(body.system(), body.motion(), 1e-3).ok());
    body.v[0] = {0, speed, 0};
    EXPECT_EQ(detector.after_step(body.system(), body.motion()).ok(), fine) << speed;
    EXPECT_EQ(detector.check_all(body.system(), body.motion()).ok(), fine) << speed;
  }
}

TEST(Divergence, NamesTheVertexWithMostOfTheEnergyAndItsSpeed) {
  SpringArrays body = two_strangers();
  DivergenceDetector detector;
  ASSERT_TRUE(detector.start(body.system(), body.motion(), 1e-3).ok());
  body.v[0] = {0, 12, 0};
  body.v[1] = {0, 0, 3};  // a quarter of the speed, 6.25 times the energy
  EXPECT_EQ(to_string(detector.after_step(body.system(), body.motion())), "UNSTABLE_DT at vertex 1: speed = 3");
}

TEST(Divergence, TellsHowManyStepsItGoesBack) {
  SpringArrays body = two_strangers();
  DivergenceDetector detector;
  ASSERT_TRUE(detector.start(body.system(), body.motion(), 1e-3).ok());
  for (int k = 0; k < 7; ++k) {
    body.x[0].x() += 1e-3;
    ASSERT_TRUE(detector.after_step(body.system(), body.motion()).ok());
  }
  EXPECT_EQ(detector.restore(body.motion()), 7u);
  EXPECT_EQ(body.x[0], Eigen::Vector3d(0, 0, 0));
}

TEST(Divergence, KeepsAStateEverySixtyFourSteps) {
  SpringArrays body = two_strangers();
  DivergenceDetector detector;
  ASSERT_TRUE(detector.start(body.system(), body.motion(), 1e-3).ok());
  for (int k = 1; k <= 70; ++k) {
    body.x[0].x() = k;
    ASSERT_TRUE(detector.after_step(body.system(), body.motion()).ok());
  }
  EXPECT_EQ(detector.restore(body.motion()), 6u);
  EXPECT_EQ(body.x[0].x(), 64.0);
}

// However often the system changed, the work of a driver counts once: it has put 0.5 J into its spring.
TEST(Divergence, CountsTheWorkOfADriverOnce) {
  SpringArrays body;
  body.add_vertex(1.0, {0, 0, 0});
  body.add_vertex(1.0, {1, 0, 0}, {1e-3, 0, 0}, true);
  body.add_spring(0, 1, 1.0, 1.0);
  DivergenceDetector detector;
  ASSERT_TRUE(detector.start(body.system(), body.motion(), 1.0).ok());
  for (int k = 0; k < 100; ++k) ASSERT_TRUE(detector.system_changed(body.system(), body.motion()).ok());
  for (int k = 0; k < 1000; ++k) {
    body.x[1].x() += 1e-3;
    ASSERT_TRUE(detector.after_step(body.system(), body.motion()).ok()) << k;
  }
  body.v[0] = {15, 0, 0};  // 112 J
  EXPECT_FALSE(detector.check_all(body.system(), body.motion()).ok());
}

// A body that moves far faster than it is driven: the work done is added to the initial energy.
TEST(Divergence, IsNotWhatABodyHasAboveTheWorkOfItsDriver) {
  SpringArrays body = two_strangers();
  body.v[0] = {100, 0, 0};
  body.add_vertex(1.0, {0, 9, 0}, {1e-3, 0, 0}, true);
  body.add_vertex(1.0, {1, 9, 0});
  body.add_spring(2, 3, 1.0, 1.0);
  body.springs[0].damping = 1.0;  // so that the driver works
  DivergenceDetector detector;
  const auto integrator = make_integrator("rk4");
  const Watched w = run(body, *integrator, 1e-3, 200, detector);
  EXPECT_TRUE(w.result.ok()) << to_string(w.result);
}

TEST(Divergence, CountsItsChecks) {
  SpringArrays body = two_strangers();
  DivergenceDetector detector;
  ASSERT_TRUE(detector.start(body.system(), body.motion(), 1e-3).ok());
  for (int k = 0; k < 8; ++k) ASSERT_TRUE(detector.after_step(body.system(), body.motion()).ok());
  EXPECT_EQ(detector.checks(), 4u);  // after steps 1, 2, 4, 8
  ASSERT_TRUE(detector.check_all(body.system(), body.motion()).ok());
  EXPECT_EQ(detector.checks(), 5u);
}

TEST(Divergence, IsFollowedToWhatIsNotANumber) {
  SpringArrays body = two_strangers();
  body.add_spring(0, 1, 1.0, 5.0);
  DivergenceDetector detector;
  ASSERT_TRUE(detector.start(body.system(), body.motion(), 1e-3).ok());
  const StepResult nowhere{StepCode::nonfinite, Witness::none, 0, "solution", NAN};
  EXPECT_EQ(to_string(detector.with_witness(nowhere, body.system(), body.motion())), to_string(nowhere));
  body.springs[0].damping = INFINITY;
  EXPECT_EQ(to_string(detector.with_witness(nowhere, body.system(), body.motion())),
            "NONFINITE at edge 0: spring = inf");
  body.viscosity[1] = INFINITY;
  EXPECT_EQ(to_string(detector.with_witness(nowhere, body.system(), body.motion())),
            "NONFINITE at vertex 1: viscosity = inf");
}

TEST(Divergence, LooksAtOneStepInSixteen) {
  SpringArrays body = moving_grid();
  DivergenceDetector detector;
  const auto integrator = make_integrator("verlet");
  run(body, *integrator, 1e-4, 1600, detector);
  EXPECT_LE(detector.checks(), 1600u / 16 + 5);
  EXPECT_GE(detector.checks(), 1600u / 16);
}

// Without forces and at rest there is no energy but that of rounding: the energy of a moving kilogram needs a
// source.
TEST(Divergence, IsNotFoundInMotionThatWorkFromOutsideExplains) {
  for (const double share : {0.0, 0.02, 1.0}) {
    SpringArrays body = spring_grid(2, 2, 2);
    DivergenceDetector detector;
    ASSERT_TRUE(detector.start(body.system(), body.motion(), 1e-6).ok());
    for (Eigen::Vector3d& v : body.motion().v) v = {0, 0, 100};
    const double energy = kinetic_energy(body.system(), body.motion().v);
    detector.add_work(share * energy);
    detector.add_work(-0.5 * share * energy);  // the largest value so far counts
    EXPECT_EQ(detector.after_step(body.system(), body.motion()).ok(), share > 0.0) << share;
  }
}

TEST(Divergence, OfNothingIsNone) {
  SpringArrays nothing;
  DivergenceDetector detector;
  EXPECT_TRUE(detector.start(nothing.system(), nothing.motion(), 1e-3).ok());
  EXPECT_TRUE(detector.after_step(nothing.system(), nothing.motion()).ok());
}

}  // namespace
}  // namespace dartboard::divergence_test
