#include "validation/statics/warped_stiffness.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "core/plain/eigenvalues.h"
#include "core/plain/error.h"
#include "validation/statics/linearised.h"
#include "validation/statics/static_problem.h"

namespace dartboard::warped_stiffness_test {
namespace {

using Eigen::Vector3d;

struct Body {
  StaticProblem problem = loaded_beam(CellKind::tetrahedron, 1, 1.0, true);
  std::unique_ptr<SimulatedBody> body = body_of(problem, Model::corotational);
  SpringSystem system = body->system();
  std::span<const Vector3d> rest = body->vertices().position;
};
double apart(const Eigen::SparseMatrix<double>& a, const Eigen::SparseMatrix<double>& b) {
  return (a - b).norm() / b.norm();
}

TEST(WarpedStiffness, IsTheTangentOfABodyAtRest) {
  const Body b;
  EXPECT_LT(apart(WarpedStiffness(b.system, b.rest)(b.rest), linearised(b.system, b.rest).stiffness), 1e-13);
}

// Rotated as a whole it has no stress, and a rotation changes nothing of the tangent but its frame.
TEST(WarpedStiffness, IsTheTangentOfABodyThatHasTurned) {
  const Body b;
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1.2, Vector3d(1, 2, -1).normalized()).toRotationMatrix();
  std::vector<Vector3d> x;
  for (const Vector3d& p : b.rest) x.push_back(turn * p + Vector3d(0.5, -1.0, 2.0));
  EXPECT_LT(apart(WarpedStiffness(b.system, b.rest)(x), linearised(b.system, x).stiffness), 1e-12);
}

// Squeezed to a third of its length, the tangent is negative somewhere.
TEST(WarpedStiffness, IsPositiveWhereTheTangentIsNot) {
  const Body b;
  std::vector<Vector3d> x;
  for (const Vector3d& p : b.rest) x.push_back(Vector3d(0.3 * p[0], p[1], p[2]));
  const auto lowest = [](const Eigen::SparseMatrix<double>& k) {
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> of(Eigen::MatrixXd(k), Eigen::EigenvaluesOnly);
    return of.eigenvalues()[0] / of.eigenvalues()[of.eigenvalues().size() - 1];
  };
  EXPECT_GT(lowest(WarpedStiffness(b.system, b.rest)(x)), -1e-12);
  EXPECT_LT(lowest(linearised(b.system, x).stiffness), -1e-3);
  EXPECT_GT(lowest(linearised(b.system, x, Compression::projected).stiffness), -1e-12);
}

TEST(WarpedStiffness, IsOfTetrahedraAlone) {
  const auto hexahedra = body_of(loaded_beam(CellKind::hexahedron, 1, 1.0, true), Model::corotational);
  EXPECT_THROW(WarpedStiffness(hexahedra->system(), hexahedra->vertices().position), InputError);
}

}  // namespace
}  // namespace dartboard::warped_stiffness_test
