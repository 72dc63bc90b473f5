#include "core/elements/membrane_law.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "core/plain/eigenvalues.h"
#include "core/plain/error.h"
#include "core/plain/random.h"

namespace dartboard::membrane_law_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

SurfaceGradient random_gradient(SplitMix64& random, double size) {
  SurfaceGradient f = SurfaceGradient::Zero();
  f(0, 0) = f(1, 1) = 1.0;
  for (double& entry : f.reshaped()) entry += size * random.next_signed();
  return f;
}

MembraneLaw law_of(Model model, double young, double nu) {
  return MembraneLaw({.stiffness = 0.0, .damping = 0.0, .young = young, .poisson = nu, .model = model});
}
constexpr Model models[] = {Model::stvk, Model::corotational};

// A sheet is a solid without stress across it. In the solids' laws that stress is 2 mu e33 + lambda tr e, of Green's
// strain or of S - I, which is zero for e33 = -nu / (1 - nu) (e11 + e22); the solid with that stretch across itself has
// the energy of the sheet.
TEST(MembraneLaw, IsTheSolidThatHasNoStressAcrossIt) {
  SplitMix64 random(1);
  for (const double nu : {-0.9, -0.2, 0.0, 0.3, 0.4999})
    for (int k = 0; k < 100; ++k) {
      const SurfaceGradient f = random_gradient(random, 0.2);
      const double trace = std::sqrt(f.squaredNorm() + 2.0 * f.col(0).cross(f.col(1)).norm());  // of S
      const double ratio = -nu / (1.0 - nu), square = 1.0 + ratio * (f.squaredNorm() - 2.0),
                   across = 1.0 + ratio * (trace - 2.0);
      // of a solid that hardly changes its volume, lambda tr e is a small difference of large numbers
      const double scale = 40.0 / (1.0 - 2.0 * nu);
      const auto expect_same = [&](const auto& solid, const MembraneLaw& sheet, double stretch) {
        if (!(stretch > 0.1)) return;
        Matrix3d whole;
        whole << f, stretch * f.col(0).cross(f.col(1)).normalized();
        EXPECT_NEAR(sheet.energy(f), solid.energy(whole), 2e-15 * scale) << nu;
        const Matrix3d stress = solid.stress(whole);
        EXPECT_LE((stress.leftCols<2>() - sheet.stress(f)).norm(), 2e-14 * scale) << nu;
        EXPECT_LE(stress.col(2).norm(), 2e-14 * scale) << nu;
      };
      expect_same(StVenantKirchhoff(lame_of(40.0, nu)), law_of(Model::stvk, 40.0, nu),
                  std::sqrt(std::max(0.0, square)));
      expect_same(Corotational(lame_of(40.0, nu)), law_of(Model::corotational, 40.0, nu), across);
    }
}

// Turned in space, or described by rotated axes of the plane, it is the same piece.
TEST(MembraneLaw, KnowsNoDirections) {
  SplitMix64 random(2);
  const Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  const Eigen::Matrix2d axes = Eigen::Rotation2Dd(1.1).toRotationMatrix();
  for (const Model model : models) {
    const MembraneLaw law = law_of(model, 40.0, 0.3);
    for (int k = 0; k < 100; ++k) {
      const SurfaceGradient f = random_gradient(random, 0.3);
      EXPECT_NEAR(law.energy(turn * f * axes), law.energy(f), 1e-13 * 40.0);
      EXPECT_LE((law.stress(turn * f * axes) - turn * law.stress(f) * axes).norm(), 1e-13 * 40.0);
    }
    SurfaceGradient rigid = SurfaceGradient::Zero();
    rigid.topRows<2>() = axes;
    EXPECT_LE(law.energy(turn * rigid), 1e-28);
  }
}

TEST(MembraneLaw, StiffensAsItsStressDoes) {
  SplitMix64 random(3);
  for (const Model model : models)
    for (const double nu : {-0.5, 0.3}) {
      const MembraneLaw law = law_of(model, 40.0, nu);
      for (int k = 0; k < 50; ++k) {
        const SurfaceGradient f = random_gradient(random, 0.3), d = random_gradient(random, 0.5);
        const SurfaceHessian h = law.hessian(f, Compression::exact);
        // Central differences of t and 2 t, cancelled to t^4 times a fifth derivative: of a cubic stress nothing is
        // left, of one that turns with the surface tens of thousands of t^4 = 1e-12, by the fifth power of the smaller
        // stretch.
        const auto slope = [&](double t) -> SurfaceGradient {
          return (law.stress(f + t * d) - law.stress(f - t * d)) / (2.0 * t);
        };
        const SurfaceGradient found = (4.0 * slope(1e-3) - slope(2e-3)) / 3.0;
        const Eigen::Matrix<double, 6, 1> product = h * d.reshaped();
        EXPECT_LE((product - found.reshaped()).norm(), (model == Model::stvk ? 1e-12 : 1e-8) * 40.0 * d.norm());
        EXPECT_LE((h - h.transpose()).norm(), 1e-14 * h.norm());
      }
    }
}

// The change of energy along a step is the work of the discrete stress.
TEST(MembraneLaw, DoesTheWorkThatItsEnergyChangesBy) {
  SplitMix64 random(6);
  for (const Model model : models) {
    const MembraneLaw law = law_of(model, 40.0, 0.3);
    for (const double size : {1e-6, 1e-2, 1.0})
      for (int k = 0; k < 50; ++k) {
        const SurfaceGradient f = random_gradient(random, 0.3), d = size * random_gradient(random, 0.5);
        const EnergyChange change = law.change(f, d);
        const double before = law.energy(f), after = law.energy(f + d);
        EXPECT_NEAR(change.value, after - before, 1e-15 * (before + after + change.sizes));
        const SurfaceGradient stress = law.discrete_stress(f, d);
        EXPECT_NEAR(stress.cwiseProduct(d).sum(), change.value, 1e-15 * change.sizes);
        // symmetric times F half way: no torque
        const Matrix3d turning = stress * (f + 0.5 * d).transpose();
        EXPECT_LE((turning - turning.transpose()).norm(), 1e-14 * stress.norm() * (f + 0.5 * d).norm());
      }
  }
}

// Compressed, even to a point or turned over: no eigenvalue below 0 is left, and stretched directions are unchanged.
TEST(MembraneLaw, IsProjectedToWhatDoesNotPushOutward) {
  SplitMix64 random(4);
  for (const Model model : models) {
    int changed = 0, kept = 0;
    for (const double nu : {-0.9, 0.0, 0.49}) {
      const MembraneLaw law = law_of(model, 40.0, nu);
      for (int k = 0; k < 300; ++k) {
        const SurfaceGradient f = (k % 3 == 0 ? 0.1 : 1.0) * random_gradient(random, k % 2 == 0 ? 0.2 : 1.5);
        const SurfaceHessian exact = law.hessian(f, Compression::exact), h = law.hessian(f, Compression::projected);
        const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver{Eigen::MatrixXd(exact)};
        const double size = exact.norm();
        EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(h)).eigenvalues()[0], -1e-14 * size);
        // what was added is at least what was missing
        EXPECT_GE(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(h - exact)).eigenvalues()[0],
                  -1e-14 * size);
        if (model == Model::corotational) {
          const SurfaceHessian nearest = solver.eigenvectors() * solver.eigenvalues().cwiseMax(0.0).asDiagonal() *
                                         solver.eigenvectors().transpose();
          EXPECT_LE((h - nearest).norm(), 1e-13 * size);
        }
        if (solver.eigenvalues()[0] < -1e-12 * size) ++changed;
        // out of the surface nothing but stress resists, so that none of it is a compression here
        if (solver.eigenvalues()[0] > 1e-12 * size) {
          EXPECT_LE((h - exact).norm(), 1e-14 * size);
          ++kept;
        }
      }
    }
    EXPECT_GT(changed, 100);
    EXPECT_GT(kept, 50);
  }
}

TEST(MembraneLaw, HasItsLargestStiffnessAtRestAsItsModulus) {
  SurfaceGradient rest = SurfaceGradient::Zero();
  rest(0, 0) = rest(1, 1) = 1.0;
  for (const Model model : models)
    for (const double nu : {-0.7, -0.1, 0.0, 0.2, 0.45}) {
      const MembraneLaw law = law_of(model, 3.0, nu);
      const SurfaceHessian h = law.hessian(rest, Compression::exact);
      const double largest = Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(Eigen::MatrixXd(h)).eigenvalues()[5];
      EXPECT_NEAR(law.modulus(), largest, 1e-14 * largest) << nu;
      EXPECT_NEAR(law.modulus(), 3.0 / (1.0 - std::abs(nu)), 1e-14 * largest) << nu;
    }
}

TEST(MembraneLaw, IsOfNoOtherModelThanItsOwn) {
  SplitMix64 random(5);
  const SurfaceGradient f = random_gradient(random, 0.5);
  EXPECT_EQ(law_of(Model::springs, 40.0, 0.3).energy(f), 0.0);
  EXPECT_EQ(law_of(Model::springs, 40.0, 0.3).modulus(), 0.0);
  EXPECT_NE(law_of(Model::stvk, 40.0, 0.3).energy(f), law_of(Model::corotational, 40.0, 0.3).energy(f));
  EXPECT_THROW(law_of(Model::neo_hookean, 40.0, 0.3), InputError);
}

// R is orthonormal and R'F symmetric and not negative, to some roundings, however flat F is: also for a piece drawn to
// a line, whose normal is known to few digits, or to a point.
TEST(SurfacePolar, IsTheNearestOrthonormalPair) {
  SplitMix64 random(7);
  for (const double flat : {1.0, 1e-3, 1e-8, 1e-14, 1e-17, 0.0})
    for (int k = 0; k < 200; ++k) {
      SurfaceGradient f = random_gradient(random, 1.5);
      f.col(1) = flat * f.col(1) + (1.0 - flat) * (k % 2 == 0 ? 1.0 : 0.3) * f.col(0);
      const auto [r, n] = surface_polar(f);
      EXPECT_LE((r.transpose() * r - Eigen::Matrix2d::Identity()).norm(), 4e-15) << flat;
      EXPECT_LE((r.transpose() * n).norm(), 2e-15) << flat;
      EXPECT_NEAR(n.norm(), 1.0, 1e-15);
      const Eigen::Matrix2d s = r.transpose() * f;
      EXPECT_LE(std::abs(s(0, 1) - s(1, 0)), 4e-15 * f.norm()) << flat;
      EXPECT_GE(s.trace(), f.norm() * (1 - 1e-15));
      EXPECT_GE(s.determinant(), -4e-15 * f.squaredNorm());
      EXPECT_LE((r * s - f).norm(), 4e-15 * f.norm());
    }
  EXPECT_EQ(surface_polar(SurfaceGradient::Zero()).rotation, SurfaceGradient::Identity());
}

}  // namespace
}  // namespace dartboard::membrane_law_test
