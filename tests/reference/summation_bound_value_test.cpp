// The bounds of summation_bound.cpp on bodies small enough to add up by hand: they are the derived ones, and no wider.

#include <gtest/gtest.h>

#include <cmath>

#include "reference/summation_bound.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::reference::summation_bound_value_test {
namespace {

constexpr double u = 0x1p-53, slack = 2 * 1.001;  // two implementations, and neglected terms

double gamma(double n) { return n * u / (1 - n * u); }

/// One regular tetrahedron at rest: three springs at each corner, one cell around each edge.
struct OneTetrahedron {
  OneTetrahedron() {
    problem.mesh = regular_tetrahedron();
    problem.material = {.density = 1.0, .stiffness = 8.0, .damping = 0.5, .viscosity = 0.25};
    problem.surroundings.gravity.setZero();
    state.x = problem.mesh.points;
    state.v.assign(4, Eigen::Vector3d::Zero());
    length = (state.x[1] - state.x[0]).norm();
    mass = signed_measure(problem.mesh, 0) / 4.0;
  }
  Problem problem;
  PointState state;
  double length, mass;
};

void expect_all(const std::vector<double>& bound, double expected) {
  for (const double b : bound) EXPECT_NEAR(b / expected, 1.0, 1e-6);
}

// gamma_13 k (l + L) of each of three springs.
TEST(ForceBoundOfATetrahedron, AtRestIsTheRoundingOfItsLengths) {
  const OneTetrahedron one;
  expect_all(force_bound(one.problem, one.state), slack * 3 * gamma(13) * 8.0 * 2 * one.length);
}

// Twice as long: gamma_13 k 3 L, gamma_{m+12} k L with m = 1, and gamma_{p+2} of the sum of |f| = k L, p = 3.
TEST(ForceBoundOfATetrahedron, StretchedAddsTheRoundingOfItsElongationsAndTheirSum) {
  OneTetrahedron one;
  for (auto& x : one.state.x) x *= 2.0;
  const double k_l = 8.0 * one.length;
  expect_all(force_bound(one.problem, one.state), slack * 3 * k_l * (3 * gamma(13) + gamma(13) + gamma(5)));
}

// A body that flies as a whole: drag m v viscosity, with gamma_{n+p+5}, n = 1 cell and p = 3 springs, and the rounding
// of the mass of the cell, 11 u |e|^3 / 6 of its volume.
TEST(ForceBoundOfATetrahedron, FlyingAddsTheRoundingOfItsDrag) {
  OneTetrahedron one;
  for (auto& v : one.state.v) v = {0, 0, 1e6};
  const double at_rest = 3 * gamma(13) * 8.0 * 2 * one.length;
  const double mass_rounding = 11.01 * u * std::pow(one.length, 3) / 6.0 / 4.0;
  expect_all(force_bound(one.problem, one.state),
             slack * (at_rest + 0.25 * 1e6 * (gamma(9) * one.mass + mass_rounding)));
}

// One corner moves: gamma_{m+23} c |dv| of each of its springs, and the contribution of their damping to the sum.
TEST(ForceBoundOfATetrahedron, MovingAddsTheRoundingOfItsDamping) {
  OneTetrahedron one;
  one.problem.material.viscosity = 0.0;
  const Eigen::Vector3d middle = (one.state.x[1] + one.state.x[2] + one.state.x[3]) / 3.0;
  const double speed = 1e6;
  one.state.v[0] = (one.state.x[0] - middle).normalized() * speed;
  const double at_rest = 3 * gamma(13) * 8.0 * 2 * one.length;
  const double force = 0.5 * speed * std::sqrt(2.0 / 3.0);  // c dv . u, an edge is inclined to the height
  const double expected = slack * (at_rest + 3 * gamma(24) * 0.5 * speed + gamma(5) * 3 * force);
  EXPECT_NEAR(force_bound(one.problem, one.state)[0] / expected, 1.0, 1e-6);
}

// Nothing moves and steps are short: each adds gamma_4 of the largest coordinate vector, for positions that are added
// to one term after the other.
TEST(StateBoundOfATetrahedron, AtRestGrowsByFourRoundingsOfAPositionAStep) {
  OneTetrahedron one;
  one.problem.h = 1e-9;
  double size = 0.0;
  for (const auto& x : one.state.x) size = std::max(size, x.norm());
  for (const int steps : {1, 5, 20})
    EXPECT_NEAR(state_bound(one.problem, one.state, steps).position / (slack * 1.001 * steps * gamma(4) * size), 1.0,
                1e-3)
        << steps;
}

// The velocity is off by h times the error of the acceleration: gamma_13 k (l + L) over the mass of each spring, and in
// the last three stages, whose weights add up to 5/6, by P = 2 sum k / m times one rounding of a position.
TEST(StateBoundOfATetrahedron, AtRestHasAVelocityThatIsOffByTheForcesRounding) {
  OneTetrahedron one;
  one.problem.h = 1e-9;
  const double size = one.state.x[0].norm(), force = 3 * gamma(13) * 8.0 * 2 * one.length;
  const double expected = slack * 1.001 * one.problem.h * (force + 5.0 / 6.0 * 2 * 3 * 8.0 * u * size) / one.mass;
  EXPECT_NEAR(state_bound(one.problem, one.state, 1).velocity / expected, 1.0, 1e-2);
}

// In a free fall no spring pulls, so a bound only adds up: per step the velocity's is off by the acceleration's
// gamma_15 (2 n + p + 10) and by the last sum, gamma_8 of its terms and gamma_4 of what they are added to; the
// position's by the velocities of the stages, each with the rounding of its product and sum, and by its own last sum.
TEST(StateBoundOfATetrahedron, InAFreeFallAddsUpTheRoundingOfWhatItsMotionReaches) {
  OneTetrahedron one;
  one.problem.material = {.density = 1.0, .stiffness = 0.0, .damping = 0.0, .viscosity = 0.0};
  const double g = 1e4, h = 0.5, left_out = 1.001;
  one.problem.surroundings.gravity = {0, 0, -g};
  one.problem.h = h;
  double X = 0.0, V = 0.0;
  for (int step = 0; step < 10; ++step) {
    const double t = h * step, v = g * t, A = left_out * gamma(15) * g;
    double x = 0.0;
    for (const auto& at : one.problem.mesh.points) x = std::max(x, (at - Eigen::Vector3d(0, 0, g * t * t / 2)).norm());
    const auto stage = [&](double reach) {
      return V + reach * A + left_out * (gamma(1) * (v + reach * g) + gamma(2) * reach * g);
    };
    const double travel = h * (v + h * g / 2);
    X += h / 6 * (V + 4 * stage(h / 2) + stage(h)) + left_out * (gamma(8) * travel + gamma(4) * (x + travel));
    V += h * A + left_out * (gamma(8) * h * g + gamma(4) * (v + h * g));
    const StateBound bound = state_bound(one.problem, one.state, step + 1);
    EXPECT_NEAR(bound.velocity / (slack * V), 1.0, 1e-9) << step;
    EXPECT_NEAR(bound.position / (slack * X), 1.0, 1e-9) << step;
  }
}

// Differences grow by exp(h sqrt P) a step, P = 2 sum k / m of a corner: that is the spectral radius of (0 1; P 0).
TEST(StateBoundOfATetrahedron, GrowsNoFasterThanItsLipschitzConstantSays) {
  OneTetrahedron one;
  one.problem.material.damping = one.problem.material.viscosity = 0.0;
  const double rate = std::sqrt(2 * 3 * 8.0 / one.mass);
  one.problem.h = 0.1 / rate;
  const auto bound = [&](int steps) { return state_bound(one.problem, one.state, steps).position; };
  const double growth = std::pow(bound(120) / bound(100), 1.0 / 20);
  EXPECT_LE(growth, std::exp(0.1) * 1.001);
  EXPECT_GE(growth, 1.08);
}

}  // namespace
}  // namespace dartboard::reference::summation_bound_value_test
