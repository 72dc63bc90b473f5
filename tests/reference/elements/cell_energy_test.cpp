#include "reference/elements/cell_energy.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

namespace dartboard::reference::cell_energy_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Corners = std::array<Vector3d, 4>;

constexpr Model laws[] = {Model::neo_hookean, Model::corotational, Model::stvk};

Material of(Model model) {
  return {.density = 1.0,
          .stiffness = 0.0,
          .damping = 0.0,
          .viscosity = 0.0,
          .young = 10.0,
          .poisson = 0.25,
          .model = model};
}
const Corners rest{Vector3d(0.1, 0.2, 0.3), Vector3d(1.1, 0.2, 0.4), Vector3d(0.0, 1.2, 0.3), Vector3d(0.2, 0.1, 1.5)};
const double volume = std::abs((rest[1] - rest[0]).dot((rest[2] - rest[0]).cross(rest[3] - rest[0]))) / 6.0;

Corners moved(const Matrix3d& f) {
  Corners now;
  for (std::size_t k = 0; k < 4; ++k) now[k] = f * rest[k] + Vector3d(3, -1, 2);
  return now;
}

TEST(TetrahedronEnergy, IsNothingWhereItOnlyTurns) {
  const Matrix3d turn = Eigen::AngleAxisd(2.5, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  // rounding of the places alone: a strain of some eps, squared, times a modulus of 10
  for (const Model law : laws)
    EXPECT_LT(std::abs(static_cast<double>(tetrahedron_energy(of(law), rest, moved(turn)))), 1e-15);
}

// mu = 4, lambda = 4: a small strain e has mu e:e + lambda/2 (tr e)^2, a shear of s and a stretch of t and -u.
TEST(TetrahedronEnergy, OfSmallStrainsIsLinearElasticity) {
  const double s = 1e-5, t = 2e-5, u = 3e-5;
  Matrix3d f = Matrix3d::Identity();
  f(0, 1) = f(1, 0) = s;
  f(0, 0) += t;
  f(2, 2) -= u;
  const double expected = volume * (4.0 * (2 * s * s + t * t + u * u) + 2.0 * (t - u) * (t - u));
  for (const Model law : laws)
    EXPECT_NEAR(static_cast<double>(tetrahedron_energy(of(law), rest, moved(f))) / expected, 1.0, 3e-4) << name(law);
}

// A stretch to twice the length along x, by hand: F = diag(2, 1, 1).
TEST(TetrahedronEnergy, OfAStretchIsAsItsFormulaHasIt) {
  const Corners now = moved(Vector3d(2, 1, 1).asDiagonal().toDenseMatrix());
  const auto of_law = [&](Model law) { return static_cast<double>(tetrahedron_energy(of(law), rest, now)) / volume; };
  EXPECT_NEAR(of_law(Model::corotational), 4.0 + 2.0, 1e-14);         // |F - 1|^2 = 1, trace 1
  EXPECT_NEAR(of_law(Model::stvk), 4.0 * 2.25 + 2.0 * 2.25, 1e-14);   // E = 3/2
  const double m = 16.0 / 3, l = 4 + 10.0 / 3, a = 1 + 0.75 * m / l;  // I = 6, J = 2
  EXPECT_NEAR(of_law(Model::neo_hookean),
              m / 2 * (3 - std::log(7.0 / 4)) + l / 2 * ((2 - a) * (2 - a) - (1 - a) * (1 - a)), 1e-14);
}

// Turned inside out, corotational pulls back along the shortest way: F = diag(1, 1, -1/4) is at 5/4 from a rotation.
TEST(TetrahedronEnergy, OfAnInvertedCellIsOfTheNearestProperRotation) {
  const Corners now = moved(Vector3d(1, 1, -0.25).asDiagonal().toDenseMatrix());
  EXPECT_NEAR(static_cast<double>(tetrahedron_energy(of(Model::corotational), rest, now)) / volume,
              4.0 * 1.5625 + 2.0 * 1.5625, 1e-14);
}

TEST(TetrahedronEnergy, DoesNotDependOnTheOrderOfTheCorners) {
  const Corners now = moved(Vector3d(1.2, 0.9, 1.1).asDiagonal().toDenseMatrix());
  for (const Model law : laws) {
    const Corners other_rest{rest[2], rest[0], rest[1], rest[3]}, other_now{now[2], now[0], now[1], now[3]};
    const long double energy = tetrahedron_energy(of(law), rest, now);
    EXPECT_NEAR(static_cast<double>(tetrahedron_energy(of(law), other_rest, other_now) / energy), 1.0, 1e-16 * 64);
  }
}

}  // namespace
}  // namespace dartboard::reference::cell_energy_test
