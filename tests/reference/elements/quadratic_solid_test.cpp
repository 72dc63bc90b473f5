#include "reference/elements/quadratic_solid.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"

namespace dartboard::reference::quadratic_solid_test {
namespace {

using Eigen::Vector3d;
using Eigen::VectorXd;

// The beam of the tables: 1 x 0.2 x 0.2 m, 1e5 Pa, 1000 kg/m^3; n cells across.
constexpr double young = 1e5, density = 1000.0, side = 0.2;
QuadraticSolid beam(int n, double poisson, double jitter = 0.0) {
  return {kuhn_box(5 * n, n, n, side / n, jitter, 3), {young, poisson, density}};
}
bool at_start(const Vector3d& x) { return x[0] < 1e-9; }
bool at_end(const Vector3d& x) { return x[0] > 1.0 - 1e-9; }

// K is singular for the six rigid motions and no others; M has the mass and its centre.
TEST(QuadraticSolid, HasTheMassOfItsVolumeAndNoForceInRigidMotions) {
  const QuadraticSolid solid = beam(1, 0.3, 0.2);
  const auto unknowns = static_cast<Eigen::Index>(3 * solid.nodes().size());
  for (int c = 0; c < 3; ++c) {
    VectorXd shift = VectorXd::Zero(unknowns), turn = VectorXd::Zero(unknowns);
    for (std::size_t i = 0; i < solid.nodes().size(); ++i) {
      shift[3 * static_cast<Eigen::Index>(i) + c] = 1.0;
      turn.segment<3>(3 * static_cast<Eigen::Index>(i)) = Vector3d::Unit(c).cross(solid.nodes()[i]);
    }
    EXPECT_LT((solid.stiffness() * shift).norm(), 1e-9);
    EXPECT_LT((solid.stiffness() * turn).norm(), 1e-9);
    EXPECT_NEAR(shift.dot(solid.mass() * shift), density * 0.04, 1e-11);
  }
}

// sigma_xx = M z / I by tractions on both ends: u = (x z, -nu y z, (nu (y^2 - z^2) - x^2) / 2) M / EI is quadratic, so
// the elements represent it exactly, whatever their shapes, and the energy is M^2 L / 2 EI.
TEST(QuadraticSolid, BendsExactly) {
  const double poisson = 0.3, inertia = side * side * side * side / 12.0, moment = 2.0;
  const QuadraticSolid solid = beam(2, poisson, 0.2);
  const auto traction = [&](double sign) {
    return [=](const Vector3d& x) { return Vector3d(sign * moment * (x[2] - side / 2) / inertia, 0, 0); };
  };
  const VectorXd force = solid.load(at_end, traction(1.0)) + solid.load(at_start, traction(-1.0));
  const double curvature = moment / (young * inertia);
  VectorXd exact(force.size());
  for (std::size_t i = 0; i < solid.nodes().size(); ++i) {
    const Vector3d x = solid.nodes()[i] - Vector3d(0, side / 2, side / 2);
    exact.segment<3>(3 * static_cast<Eigen::Index>(i)) =
        curvature *
        Vector3d(x[0] * x[2], -poisson * x[1] * x[2], (poisson * (x[1] * x[1] - x[2] * x[2]) - x[0] * x[0]) / 2);
  }
  EXPECT_LT((solid.stiffness() * exact - force).norm(), 1e-10 * force.norm());
  EXPECT_NEAR(force.dot(exact) / 2.0, moment * moment / (2.0 * young * inertia), 1e-10 * force.dot(exact));
}

// Values of 27-node hexahedra, 4 and 6 across, computed with scikit-fem 12.0.2; the corners of the clamp are singular,
// so that both converge slowly from below. Quadratic tetrahedra 3 across are within 1 %.
TEST(QuadraticSolid, IsTheClampedBeamOfAnotherCode) {
  struct Row {
    double poisson, work, first, torsion, second, axial;
  };
  for (const Row& row : {Row{0.25, 4.0801e-5, 1.98303, 9.15479, 10.73468, 15.76598},
                         Row{0.30, 4.0665e-5, 1.98710, 8.97822, 10.71319, 15.79413}}) {
    const QuadraticSolid solid = beam(3, row.poisson);
    const HeldSolid held = solid.held_at(solid.nodes_where(at_start));
    const VectorXd force = solid.load(at_end, [](const Vector3d&) { return Vector3d(0, 0, 1.0); });
    EXPECT_NEAR(force.dot(held.displacements(force)) / row.work, 1.0, 0.01) << row.poisson;
    const auto omega = held.frequencies(6);
    EXPECT_NEAR(omega[0] / row.first, 1.0, 0.005);
    EXPECT_NEAR(omega[1] / row.first, 1.0, 0.005);
    EXPECT_NEAR(omega[2] / row.torsion, 1.0, 0.01);
    EXPECT_NEAR(omega[3] / row.second, 1.0, 0.008);
    EXPECT_NEAR(omega[5] / row.axial, 1.0, 0.002);
  }
}

TEST(QuadraticSolid, SaysWhereItIsNotHeld) {
  const QuadraticSolid solid = beam(1, 0.3);
  const VectorXd force = solid.load(at_end, [](const Vector3d&) { return Vector3d(0, 0, 1.0); });
  EXPECT_THROW(solid.held_at({}).displacements(force), SolverError);
}

TEST(QuadraticSolid, TakesTetrahedraAlone) {
  EXPECT_THROW(QuadraticSolid(hexahedron_box(1, 1, 1, 1.0), {young, 0.3, density}), InputError);
}

}  // namespace
}  // namespace dartboard::reference::quadratic_solid_test
