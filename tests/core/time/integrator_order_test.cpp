// The observed order of every explicit integrator, undamped, damped and across a cut, compared with that of its scheme.

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "core/mechanics/adapt.h"
#include "core/operations/tear_fan.h"
#include "core/time/integrators.h"
#include "tests/support/meshes_for_tests.h"
#include "tests/support/spring_arrays_for_tests.h"

namespace dartboard::integrator_order_test {
namespace {

using Body = MassSpringBody<TetMap, Held::by_every_dart>;

struct Case {
  const char* name;
  int steps;  // in the second that is simulated, of the coarsest run
};
// Chosen so that the errors of four runs, each with twice the steps, are asymptotic (h omega_max is about 12 / steps)
// and at least 20 times above rounding, which leaves some 2e-14.
constexpr Case cases[]{
    {"explicit-euler", 512}, {"symplectic-euler", 256},         {"verlet", 32}, {"verlet-compensated", 32},
    {"blanes-moan-4", 16},   {"blanes-moan-4-compensated", 16}, {"rk4", 64},    {"dormand-prince-54", 40}};

Body jittered_body(bool damped) {
  Problem problem;
  problem.mesh = kuhn_grid(2, 2, 2, 0.5, 0.1, 2);
  problem.material.damping = damped ? 1.0 : 0.0;  // about an eighth of critical at the highest frequency
  problem.material.viscosity = damped ? 0.3 : 0.0;
  problem.surroundings.gravity = {0, 0.25, -0.5};
  problem.fixed = {0, 1};
  return build_body<TetMap, Held::by_every_dart>(problem);
}

void run(Integrator& integrator, SpringArrays& arrays, double h, int steps) {
  for (int k = 0; k < steps; ++k) {
    const StepResult result = integrator.step(arrays.system(), arrays.motion(), h);
    ASSERT_TRUE(result.ok()) << to_string(result);
  }
}

// A fan is torn off in the interior vertex.
SpringArrays torn(Body& body, const SpringArrays& before) {
  body.vertices.position = before.x;
  body.vertices.velocity = before.v;
  Dart inner = no_dart;
  body.map.for_each_dart([&](Dart d) {
    if (inner == no_dart && body.vertices.point[body.vertex(body.map, d)] == 13) inner = d;
  });
  adapt(body, tear_fan(body.map, inner));
  return arrays_of(body);
}

enum class Event { none, tear_at_half, tear_at_a_third };

// One second; an event happens at the end of the first step that reaches it.
SpringArrays simulate(const char* name, bool damped, int steps, Event event) {
  Body body = jittered_body(damped);
  SpringArrays arrays = arrays_of(body);
  disturb(arrays);
  const auto integrator = make_integrator(name);
  const int before = event == Event::none ? 0 : event == Event::tear_at_half ? steps / 2 : (steps + 2) / 3;
  run(*integrator, arrays, 1.0 / steps, before);
  if (event != Event::none) {
    arrays = torn(body, arrays);
    integrator->restart();
  }
  run(*integrator, arrays, 1.0 / steps, steps - before);
  return arrays;
}

double distance(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum);
}

// The witness has h omega_max = 1.5e-3 and with it an error far below its rounding.
const SpringArrays& witness(bool damped, Event event) {
  static std::map<std::pair<bool, Event>, SpringArrays> known;
  const auto [at, missing] = known.try_emplace({damped, event});
  if (missing) at->second = simulate("rk4", damped, event == Event::tear_at_a_third ? 6144 : 8192, event);
  return at->second;
}

void expect_order(const Case& c, bool damped, Event event) {
  const SpringArrays& exact = witness(damped, event);
  const int order = scheme_of(c.name).order;
  double x = 0, v = 0;
  for (int halving = 0; halving < 4; ++halving) {
    const SpringArrays end = simulate(c.name, damped, c.steps << halving, event);
    ASSERT_EQ(end.x.size(), exact.x.size());
    const double x_before = x, v_before = v;
    x = distance(end.x, exact.x);
    v = distance(end.v, exact.v);
    if (halving == 0) continue;
    EXPECT_NEAR(std::log2(x_before / x), order, 0.1) << c.name << ", " << (c.steps << halving) << " steps";
    EXPECT_NEAR(std::log2(v_before / v), order, 0.1) << c.name << ", " << (c.steps << halving) << " steps";
  }
}

void PrintTo(const Case& c, std::ostream* out) { *out << c.name; }

struct IntegratorOrder : testing::TestWithParam<Case> {};

TEST_P(IntegratorOrder, IsTheSchemesWithoutDamping) { expect_order(GetParam(), false, Event::none); }

// Damping evaluated at an old velocity would make every splitting a method of order 1.
TEST_P(IntegratorOrder, IsTheSchemesWithDamping) { expect_order(GetParam(), true, Event::none); }

TEST_P(IntegratorOrder, IsTheSchemesAcrossACutAtTheEndOfAStep) {
  expect_order(GetParam(), false, Event::tear_at_half);
  expect_order(GetParam(), true, Event::tear_at_half);
}

INSTANTIATE_TEST_SUITE_P(All, IntegratorOrder, testing::ValuesIn(cases), [](const auto& tested) {
  std::string name(tested.param.name);
  std::erase(name, '-');
  return name;
});

// 2^k steps miss a third of a second by 2/3 and 1/3 of a step in turn, so two halvings together show the order.
TEST(IntegratorOrderAtAnUnalignedCut, IsOneWhateverTheMethod) {
  const SpringArrays& exact = witness(false, Event::tear_at_a_third);
  const auto error = [&](int steps) {
    return distance(simulate("blanes-moan-4", false, steps, Event::tear_at_a_third).x, exact.x);
  };
  EXPECT_NEAR(std::log2(error(128) / error(512)) / 2, 1.0, 0.1);
}

// Why every scene here starts with positions and velocities off equilibrium, and why both are measured: of
// kick-then-drift steps from rest, v_n = -omega sin(n phi) / sqrt(1 - theta^2/4) with phi = theta + O(theta^3).
TEST(IntegratorOrderFromRest, FlattersSymplecticEulerInItsVelocities) {
  const double t = 1.0, a = 0.125;
  const auto end = [&](int steps) {
    SpringArrays arrays;
    const auto wall = arrays.add_vertex(1.0, {0, 0, 0}, {0, 0, 0}, true);
    arrays.add_spring(wall, arrays.add_vertex(1.0, {2.0 + a, 0, 0}), 1.0, 2.0);
    const auto integrator = make_integrator("symplectic-euler");
    run(*integrator, arrays, t / steps, steps);
    return arrays;
  };
  const auto position_error = [&](int steps) { return std::abs(end(steps).x[1].x() - (2.0 + a * std::cos(t))); };
  const auto velocity_error = [&](int steps) { return std::abs(end(steps).v[1].x() + a * std::sin(t)); };
  EXPECT_NEAR(std::log2(position_error(128) / position_error(256)), 1.0, 0.1);
  EXPECT_NEAR(std::log2(velocity_error(128) / velocity_error(256)), 2.0, 0.1);
}

}  // namespace
}  // namespace dartboard::integrator_order_test
