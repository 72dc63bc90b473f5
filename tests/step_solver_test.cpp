#include "core/time/step_solver.h"

#include <gtest/gtest.h>

#include "tests/spring_bodies_for_tests.h"

namespace dartboard {
namespace {

using Eigen::Vector3d;

// The second body is another one to a factor of the first: conjugate gradients do not reach the rounding with it in the
// four iterations that a patience of one allows.
TEST(StepSolver, FactorsOnceWhenAKeptFactorIsWornOut) {
  SpringArrays first = spring_grid(2, 2, 2), second = first;
  for (Vector3d& p : second.x) p = Vector3d(p.y(), 2.0 * p.z(), 3.0 * p.x());
  StepSolver solver({.patience = 1});
  WorkCounters work;
  const auto b = random_vectors(first.x.size(), 4);
  std::vector<Vector3d> x(b.size());
  const auto prepare = [&](const SpringArrays& body) {
    const TangentsAt tangents = [&body](Compression compression, std::vector<SpringTangent>& result) {
      evaluate_tangents(body.system(), body.x, compression, result);
    };
    return solver.prepare(body.system(), tangents, 0.02, work);
  };
  ASSERT_EQ(prepare(first), SolveStatus::ok);
  ASSERT_EQ(prepare(second), SolveStatus::ok);
  EXPECT_EQ(work.factorisations, 1u);
  ASSERT_EQ(solver.solve(b, x, Accuracy::full, work), SolveStatus::ok);
  EXPECT_EQ(work.factorisations, 2u);
  ASSERT_EQ(prepare(second), SolveStatus::ok);
  EXPECT_EQ(work.factorisations, 2u);
  ASSERT_EQ(solver.solve(b, x, Accuracy::full, work), SolveStatus::ok);
  EXPECT_EQ(work.factorisations, 2u);
}

}  // namespace
}  // namespace dartboard
