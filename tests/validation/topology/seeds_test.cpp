// A seed draws the same numbers again, and another seed draws others, wherever validation takes one.

#include <gtest/gtest.h>

#include <algorithm>

#include "core/meshes/generators/mesh_generators.h"
#include "core/time/integrators.h"
#include "tests/support/ticking_clock_for_tests.h"
#include "validation/conservation/refinement_conservation.h"
#include "validation/stability/stability_limits.h"
#include "validation/tradeoff/work_precision.h"

namespace dartboard::seeds_test {
namespace {

constexpr Material soft{.density = 1000.0, .stiffness = 0.3, .damping = 0.01, .viscosity = 0.5};

using Counts = std::vector<std::size_t>;
Counts operations_of(const ConservationResult& r) {
  return {r.dissociations, r.tears, r.removals, r.refinements, r.series, r.steps};
}

ConservationPlan plan_of(std::uint64_t seed) {
  ConservationPlan plan;
  plan.seed = seed;
  plan.operations = 60;
  plan.everything_every = plan.oracle_every = 1000;
  return plan;
}

TEST(Seeds, DrawTheOperationsOfAConservationRun) {
  const Problem problem = moving_problem(kuhn_box(2, 2, 1, 0.125), soft, 1);
  const auto run = [&](std::uint64_t seed) {
    return operations_of(validate_conservation<TetMap>(problem, plan_of(seed)));
  };
  EXPECT_EQ(run(3), run(3));
  EXPECT_NE(run(3), run(4));
}

TEST(Seeds, DrawTheOperationsOfARefinementRun) {
  const Problem problem = moving_problem(kuhn_box(2, 1, 1, 0.125), soft, 1);
  const auto run = [&](std::uint64_t seed) {
    return operations_of(validate_refinement<TetMap>(problem, plan_of(seed)));
  };
  EXPECT_EQ(run(3), run(3));
  EXPECT_NE(run(3), run(4));
}

TEST(Seeds, DrawTheVelocitiesAndTheHeldPointsOfAMovingProblem) {
  const auto made = [](std::uint64_t seed) { return moving_problem(kuhn_box(3, 3, 3, 0.125), soft, seed); };
  EXPECT_EQ(made(1).initial_velocity, made(1).initial_velocity);
  EXPECT_NE(made(1).initial_velocity, made(2).initial_velocity);
  EXPECT_NE(made(1).fixed, made(2).fixed);
}

TEST(Seeds, DrawWhatIsCutFromTheBodyOfAMesh) {
  const auto springs = [](std::uint64_t seed) {
    return mesh_bodies("box", kuhn_box(2, 2, 2, 1.0, 0.2, 5), 12, seed).at(1).body.springs.size();
  };
  EXPECT_EQ(springs(1), springs(1));
  EXPECT_TRUE(springs(1) != springs(2) || springs(1) != springs(3));
}

TEST(Seeds, DrawTheOrderOfTheContenders) {
  const TradeoffScene scene = chain_scene(4, 4.0, 2);
  const SceneReference reference = reference_of(scene, ticking());
  std::vector<TradeoffContender> contenders;
  for (const std::string name : {"verlet", "rk4", "symplectic-euler", "explicit-euler", "blanes-moan-4"})
    contenders.push_back({name, [name] { return make_integrator(name); }, false, false});
  const auto order = [&](std::uint64_t seed) {
    WorkPrecisionOptions options;
    options.fewest_repetitions = options.most_repetitions = 1;
    options.most_s = 1e-5;
    options.seed = seed;
    std::vector<std::string> seen;
    (void)work_precision(scene, reference, contenders, ticking(), options, [&](const WorkPoint& p) {
      if (seen.empty() || seen.back() != p.contender) seen.push_back(p.contender);
    });
    return seen;
  };
  EXPECT_EQ(order(1), order(1));
  EXPECT_TRUE(order(1) != order(2) || order(1) != order(3));
}

}  // namespace
}  // namespace dartboard::seeds_test
