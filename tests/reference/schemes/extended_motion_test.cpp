#include "reference/schemes/extended_motion.h"

#include <gtest/gtest.h>

#include "core/meshes/generators/mesh_generators.h"
#include "reference/adjacency_graph.h"
#include "reference/closed_form.h"

namespace dartboard::reference::extended_motion_test {
namespace {

Problem box() {
  Problem problem;
  problem.mesh = kuhn_box(3, 2, 2, 0.1);
  problem.material = {.density = 1000.0, .stiffness = 50.0, .damping = 0.01, .viscosity = 0.5};
  problem.fixed = {0};
  return problem;
}

// One mass on a spring whose other end is held: q'' = -(k / m) q along the line.
SpringNetwork oscillator(double viscosity) {
  SpringNetwork network;
  network.mass = {1.0, 2.0};
  network.fixed = {1, 0};
  network.springs = {{0, 1, 8.0, 0.0, 1.0}};
  network.viscosity = viscosity;
  return network;
}

TEST(ExtendedRun, DoesToAnOscillatorWhatTheMethodDoesExactly) {
  const PointState start{{{0, 0, 0}, {1.5, 0, 0}}, {{0, 0, 0}, {0.25, 0, 0}}};
  const ExtendedState end = extended_run(oscillator(0.125), start, 0.25, 20);
  // omega2 = 8 / 2; the closed form is rounded some 20 times in each step of doubles
  const Swing exact = rk4_oscillate(4.0, 0.125, {0.5, 0.25}, 0.25, 20);
  EXPECT_NEAR(static_cast<double>(end.x[3]), 1.0 + exact.q, 400 * 0x1p-53);
  EXPECT_NEAR(static_cast<double>(end.v[3]), exact.v, 400 * 0x1p-53);
  EXPECT_EQ(end.x[0], 0.0L);
}

TEST(ExtendedRun, HoldsFixedPointsStillWhateverTheirVelocity) {
  const PointState start{{{0, 0, 0}, {1, 0, 0}}, {{3, 3, 3}, {0, 0, 0}}};
  const ExtendedState end = extended_run(oscillator(0.0), start, 0.1, 5, 1);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(end.x[k], 0.0L);
    EXPECT_EQ(end.v[k], 0.0L);
  }
}

TEST(WitnessedMotion, IsNearerToADoubleRunThanTenSpreads) {
  const Problem problem = box();
  AdjacencyGraph graph(problem);
  const PointState start = graph.state();
  const auto [end, spread] = witnessed_motion(spring_network(problem), start, problem.h, 200);
  graph.step(200);
  const StateBound off = distance(extended(graph.state()), end);
  EXPECT_GT(spread.position, 0.0);
  EXPECT_LE(off.position, 10.0 * spread.position);
  EXPECT_LE(off.velocity, 10.0 * spread.velocity);
}

// A force that is off by 1e-12, or a step of another method, is seen.
TEST(WitnessedMotion, IsFarFromWhatIsAlmostTheSame) {
  Problem problem = box();
  const PointState start = AdjacencyGraph(problem).state();
  const auto [end, spread] = witnessed_motion(spring_network(problem), start, problem.h, 200);
  problem.material.stiffness *= 1.0 + 1e-12;
  const StateBound stiffer = distance(extended_run(spring_network(problem), start, problem.h, 200), end);
  EXPECT_GT(stiffer.position, 10.0 * spread.position);
  const StateBound later = distance(extended_run(spring_network(box()), start, problem.h * (1.0 + 1e-12), 200), end);
  EXPECT_GT(later.position, 10.0 * spread.position);
}

TEST(WitnessedMotion, HasASpreadThatGrowsWithTheRuns) {
  const Problem problem = box();
  const PointState start = AdjacencyGraph(problem).state();
  const SpringNetwork network = spring_network(problem);
  const auto one = witnessed_motion(network, start, problem.h, 50, 1),
             four = witnessed_motion(network, start, problem.h, 50, 4);
  EXPECT_EQ(one.end.x, four.end.x);
  EXPECT_GE(four.spread.position, one.spread.position);
  EXPECT_GE(four.spread.velocity, one.spread.velocity);
  EXPECT_EQ(witnessed_motion(network, start, problem.h, 50, 0).spread.position, 0.0);
}

TEST(Distance, OfStatesThatAreNoneIsNotANumber) {
  const ExtendedState a{{1.0L}, {2.0L}}, shorter{{}, {2.0L}}, nan{{std::nanl("")}, {2.0L}};
  EXPECT_TRUE(std::isnan(distance(a, shorter).position));
  EXPECT_TRUE(std::isnan(distance(a, nan).position));
  EXPECT_EQ(distance(a, {{1.5L}, {1.0L}}).position, 0.5);
  EXPECT_EQ(distance(a, {{1.5L}, {1.0L}}).velocity, 1.0);
}

}  // namespace
}  // namespace dartboard::reference::extended_motion_test
