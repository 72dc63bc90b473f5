#include "reference/elements/released_motion.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/eigenvalues.h"
#include "reference/elements/quadratic_solid.h"

namespace dartboard::reference::released_motion_test {
namespace {

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

QuadraticSolid bar() { return {kuhn_box(3, 1, 1, 0.2), {1e5, 0.3, 1000.0}}; }
bool at_start(const Vector3d& x) { return x[0] < 1e-9; }
bool at_end(const Vector3d& x) { return x[0] > 0.6 - 1e-9; }

// One node on three springs of their own: omega^2 = k / m in each direction, from f / k.
TEST(ReleasedMotion, OfOneMassIsAnOscillationInEachDirection) {
  HeldSolid solid;
  solid.stiffness.resize(3, 3);
  solid.mass.resize(3, 3);
  const Vector3d k(2.0, 8.0, 18.0), f(1.0, 4.0, -9.0);
  for (int c = 0; c < 3; ++c) {
    solid.stiffness.insert(c, c) = k[c];
    solid.mass.insert(c, c) = 2.0;
  }
  const ReleasedMotion motion{HeldFactor(solid), f};
  EXPECT_EQ(motion.vectors(), 3u);
  for (const double t : {0.0, 0.3, 2.0, 11.0})
    for (int c = 0; c < 3; ++c)
      EXPECT_NEAR(motion.displacements(t)[c], f[c] / k[c] * std::cos(std::sqrt(k[c] / 2.0) * t), 1e-13) << t;
}

// All modes of a small bar, by dense matrices without Ritz vectors. Of its 162 modes those that bend it that way, about
// half, take part: with as many vectors nothing is left out. The load excites modes across the bar by the square of
// their periods, so that sixty vectors leave out some thousandth over four periods.
TEST(ReleasedMotion, IsThatOfAllModesOfABentBar) {
  const QuadraticSolid solid = bar();
  const VectorXd force = solid.load(at_end, [](const Vector3d&) { return Vector3d(0, 0, 1.0); });
  const HeldSolid held = solid.held_at(solid.nodes_where(at_start));
  const HeldFactor factor(held);
  const ReleasedMotion motion(factor, force), all(factor, force, 162);
  EXPECT_EQ(motion.vectors(), 60u);

  std::vector<bool> is_held(solid.nodes().size(), false);
  for (const std::uint32_t i : held.held) is_held[i] = true;
  std::vector<Eigen::Index> free;
  for (std::size_t i = 0; i < is_held.size(); ++i)
    for (std::size_t c = 0; c < 3 && !is_held[i]; ++c) free.push_back(static_cast<Eigen::Index>(3 * i + c));
  const MatrixXd k = MatrixXd(held.stiffness)(free, free), m = MatrixXd(held.mass)(free, free);
  const Eigen::GeneralizedSelfAdjointEigenSolver<MatrixXd> modes(k, m);
  const VectorXd start = k.llt().solve(VectorXd(force(free)));
  const VectorXd part = modes.eigenvectors().transpose() * m * start;
  const VectorXd omega = modes.eigenvalues().cwiseSqrt();
  const double period = 2.0 * 3.14159265358979 / omega[0];
  for (int n = 0; n <= 16; ++n) {
    const double t = period * n / 4.0 + 0.01;
    const VectorXd exact = modes.eigenvectors() * (part.array() * (omega * t).array().cos()).matrix();
    EXPECT_LT((VectorXd(motion.displacements(t)(free)) - exact).norm(), 3e-3 * start.norm()) << n;
    EXPECT_LT((VectorXd(all.displacements(t)(free)) - exact).norm(), 1e-7 * start.norm()) << n;
  }
}

}  // namespace
}  // namespace dartboard::reference::released_motion_test
