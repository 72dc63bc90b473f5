// The plan of a conservation run: its problem, its series, and the number of its comparisons of everything.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <set>
#include <utility>

#include "core/meshes/generators/mesh_generators.h"
#include "tests/support/conservation_rows_for_tests.h"
#include "validation/conservation/conservation.h"

namespace dartboard::conservation_plan_test {
namespace {

constexpr Material soft{.density = 1000.0, .stiffness = 0.3, .damping = 0.01, .viscosity = 0.5};

ConservationPlan plan_of(std::uint64_t seed, std::size_t operations) {
  ConservationPlan plan;
  plan.seed = seed;
  plan.operations = operations;
  return plan;
}

// One series at a time, on a body too large for four operations to take it apart.
TEST(ConservationSeries, HaveOneToFourOperationsAfterNoneToTwoSteps) {
  std::set<std::size_t> operations, steps;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const auto result =
        validate_conservation<TetMap>(moving_problem(kuhn_box(2, 1, 1, 0.125), soft, seed), plan_of(seed, 1));
    EXPECT_EQ(result.series, 1u);
    operations.insert(result.operations());
    steps.insert(result.steps);
  }
  EXPECT_EQ(operations, (std::set<std::size_t>{1, 2, 3, 4}));
  EXPECT_EQ(steps, (std::set<std::size_t>{0, 1, 2}));
}

// A run of no operations compares everything twice.
TEST(ConservationPlans, CompareEverythingAtTheStartAtTheEndAndAsOftenAsAsked) {
  const Problem large = moving_problem(kuhn_box(4, 4, 4, 0.125), soft, 1);  // never down to a small body
  const auto looks = [&](std::size_t every, std::size_t operations) {
    ConservationPlan plan = plan_of(1, operations);
    plan.everything_every = every;
    const auto result = validate_conservation<TetMap>(large, plan);
    EXPECT_EQ(violation_of(result), "none");
    EXPECT_EQ(result.bodies_from_scratch, 1u);
    EXPECT_EQ(row(result, "all views").checks % result.whole_comparisons, 0u);
    return std::pair(result.whole_comparisons, result.series);
  };
  EXPECT_EQ(looks(1, 0).first, 2u);
  EXPECT_EQ(looks(1000, 40).first, 2u);
  const auto [looks_1, series] = looks(1, 40);
  EXPECT_EQ(looks_1, 2 + series);
  const std::size_t looks_10 = looks(10, 40).first;  // after 10 operations or up to three more, and so on
  EXPECT_GE(looks_10, 2u + 3);
  EXPECT_LE(looks_10, 2u + 4);
}

TEST(ConservationPlans, CompareTheMotionAtTheEndAndAsOftenAsAsked) {
  const Problem large = moving_problem(kuhn_box(3, 3, 3, 0.125), soft, 1);
  const auto bodies = [&](std::size_t every) {
    ConservationPlan plan = plan_of(1, 20);
    plan.oracle_every = every;
    const auto result = validate_conservation<TetMap>(large, plan);
    return std::pair(result.bodies_from_scratch, result.series);
  };
  EXPECT_EQ(bodies(1000).first, 1u);
  const auto [all, series] = bodies(1);
  EXPECT_EQ(all, 1 + series);
}

// The field is linear about the middle of the points, so that they do not move on.
TEST(MovingProblem, StretchesTheBodyAboutItsMiddle) {
  const Mesh mesh = kuhn_box(3, 2, 2, 0.5, 0.2, 7);
  const Problem problem = moving_problem(mesh, soft, 3);
  ASSERT_EQ(problem.initial_velocity.size(), mesh.points.size());
  Eigen::Vector3d mean(0, 0, 0);
  double fastest = 0.0;
  for (const auto& v : problem.initial_velocity) {
    mean += v;
    fastest = std::max(fastest, v.norm());
  }
  EXPECT_GT(fastest, 0.0);
  EXPECT_LT(mean.norm(), 1e-12 * fastest);
  // four points fix the field; all others obey it
  Eigen::Matrix3d along, speed;
  for (int k = 0; k < 3; ++k) {
    const auto other = static_cast<std::size_t>(k == 0 ? 1 : k == 1 ? 4 : 12);  // next along x, y, z
    along.col(k) = mesh.points[other] - mesh.points[0];
    speed.col(k) = problem.initial_velocity[other] - problem.initial_velocity[0];
  }
  const Eigen::Matrix3d field = speed * along.inverse();
  for (std::size_t i = 0; i < mesh.points.size(); ++i)
    EXPECT_LT(
        (problem.initial_velocity[i] - problem.initial_velocity[0] - field * (mesh.points[i] - mesh.points[0])).norm(),
        1e-12 * fastest);
}

TEST(MovingProblem, ObeysItsSeed) {
  const Mesh mesh = kuhn_box(3, 3, 3, 0.5);
  const Problem one = moving_problem(mesh, soft, 3), again = moving_problem(mesh, soft, 3),
                other = moving_problem(mesh, soft, 4);
  EXPECT_EQ(one.initial_velocity, again.initial_velocity);
  EXPECT_EQ(one.fixed, again.fixed);
  EXPECT_NE(one.initial_velocity, other.initial_velocity);
  EXPECT_NE(one.fixed, other.fixed);
}

}  // namespace
}  // namespace dartboard::conservation_plan_test
