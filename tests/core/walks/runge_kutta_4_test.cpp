#include "core/walks/runge_kutta_4.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <complex>
#include <cstring>
#include <limits>
#include <vector>

#include "core/mechanics/add_cell_springs.h"
#include "core/walks/cell_arrays.h"
#include "core/walks/dart_coverage.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::runge_kutta_4_test {
namespace {

using Eigen::Vector3d;
constexpr double u = std::numeric_limits<double>::epsilon() / 2;  // unit roundoff
constexpr auto every = Held::by_every_dart;

Problem without_losses(Mesh mesh) {
  Problem problem;
  problem.mesh = std::move(mesh);
  problem.material.damping = problem.material.viscosity = 0;
  problem.surroundings.gravity = {0, 0, 0};
  return problem;
}

template <class Body>
void run(Body& body, double h, int steps) {
  CellArrays arrays;
  arrays.rebuild(body);
  RungeKutta4 integrator;
  for (int k = 0; k < steps; ++k) integrator.step(arrays, body, h);
}

// A triangle with its corners at 0 (fixed), L on the x axis and somewhere (fixed); only the spring along the axis is
// kept. The free corner is a linear oscillator: w = (x - L) + i v / omega obeys w' = -i omega w, and one step of the
// method multiplies w by R(z) = 1 + z + z^2/2 + z^3/6 + z^4/24 at z = -i theta, theta = h omega, |R| <= 1.
//
// Rounding in one step, in the norm of w, for |x| <= X, |w| <= a <= X/8, |v| <= omega a: the position is rounded once
// at size X (u X); three stage positions are (u X each) and enter the velocity through h omega^2 / 6 (2 + 2 + 1) u X,
// which is less than theta u X once divided by omega, and the position through less than theta^2 u X <= 3 theta u X;
// the length sqrt(x^2) and its difference from L are exact. All else is relative to a: at most 30 operations on terms
// below (1 + theta)^4 a, so 30 (1 + theta)^4 u a. Steps do not amplify (|R| <= 1): n steps, n times as much.
TEST(RungeKutta4, FollowsItsOwnPolynomialOnALinearOscillator) {
  const double L = 2.0;
  Problem problem = without_losses({});
  problem.mesh.points = {{0, 0, 0}, {L, 0, 0}, {0, 1, 0}};
  problem.mesh.add_cell(CellKind::triangle, std::array<std::uint32_t, 3>{0, 1, 2});
  problem.fixed = {0, 2};
  for (const double theta_wanted : {0.01, 0.5, 1.7, 2.8}) {
    auto body = build_body<Map2, every>(problem);
    double k = 0;
    CellArrays arrays;
    arrays.rebuild(body);
    arrays.for_each_edge(body, [&](std::uint32_t e, std::uint32_t a, std::uint32_t b) {
      const bool axis = body.vertices.point[a] + body.vertices.point[b] == 1;
      if (!axis) body.springs.change(e, [](Spring& s) { s.stiffness = 0; });
      if (axis) k = body.springs[e].stiffness;
    });
    PointState state = body.state();
    const double a = 0.125, X = L + 2 * a;
    state.x[1].x() = L + a;
    body.set_state(state);
    double mass = 0;
    for (std::size_t i = 0; i < 3; ++i)
      if (body.vertices.point[i] == 1) mass = body.vertices.mass[i];

    using Complex = std::complex<long double>;
    const long double omega = std::sqrt(static_cast<long double>(k) / mass);
    const auto h = static_cast<double>(theta_wanted / omega);
    const Complex z(0, -omega * h);
    const Complex R = 1.0L + z * (1.0L + z / 2.0L * (1.0L + z / 3.0L * (1.0L + z / 4.0L)));
    const int n = 200;
    Complex w = static_cast<long double>(a);
    for (int step = 0; step < n; ++step) w *= R;

    run(body, h, n);
    const PointState end = body.state();
    const double theta = theta_wanted, small = 30 * std::pow(1 + theta, 4) * a;
    const double bound = n * u * (X * (1 + 4 * theta) + small);
    EXPECT_NEAR(end.x[1].x() - L, static_cast<double>(w.real()), bound) << "theta " << theta;
    EXPECT_NEAR(end.v[1].x() / static_cast<double>(omega), static_cast<double>(w.imag()), bound) << "theta " << theta;
    EXPECT_EQ(end.x[1].y(), 0.0);
  }
}

// Without springs a fall is a parabola, which the method follows exactly. Rounding: a step rounds the velocity once at
// size V and its increment g h by at most 8 operations, the position once at size X and its increment at most h V by 8
// operations, and passes the error of the velocity on times h.
TEST(RungeKutta4, FallsFreelyToWithinRounding) {
  Problem problem = without_losses(unequal_tetrahedra());
  problem.material.stiffness = 0;
  problem.surroundings.gravity = {0, 0.5, -9.81};
  problem.initial_velocity.assign(5, {1, -2, 3});
  auto body = build_body<TetMap, every>(problem);
  const double h = 0.01;
  const int n = 300;
  run(body, h, n);
  const PointState end = body.state();
  const double t = n * h;
  const Vector3d g = problem.surroundings.gravity, v0(1, -2, 3);
  const double V = 4 + 10 * t, X = 3 + V * t;                          // |v0| < 4, |g| < 10, |x0| < 3
  const double velocity_bound = n * u * (V + 8 * 10 * h) + u * 4 * V;  // and the evaluation of the expected value
  const double position_bound = n * u * (X + 8 * h * V) + t * velocity_bound + u * 8 * X;
  for (std::size_t p = 0; p < 5; ++p)
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(end.v[p][axis], v0[axis] + g[axis] * t, velocity_bound);
      EXPECT_NEAR(end.x[p][axis], problem.mesh.points[p][axis] + v0[axis] * t + g[axis] * t * t / 2, position_bound);
    }
}

Problem a_moving_body() {
  Problem problem;
  problem.mesh = kuhn_grid(1, 1, 1, 0.5, 0.1, 2);
  problem.surroundings.gravity = {0, 0, -0.25};  // stays far from springs of no length, where the forces are not smooth
  problem.material.damping = 0.5;
  problem.fixed = {0, 3};
  return problem;
}

std::vector<Vector3d> positions_after(double h, int steps) {
  auto body = build_body<TetMap, every>(a_moving_body());
  run(body, h, steps);
  return body.state().x;
}

double distance(const std::vector<Vector3d>& a, const std::vector<Vector3d>& b) {
  double sum = 0;
  for (std::size_t p = 0; p < a.size(); ++p) sum += (a[p] - b[p]).squaredNorm();
  return std::sqrt(sum);
}

// y(h) = y + C4 h^4 + C5 h^5 + ...: the distances of successive halvings have the ratio 16 (1 + c h + ...), so the
// order seen is 4 + O(h): its distance from 4 halves as well, and it is within 0.2 already at h = 1/64.
TEST(RungeKutta4, HasOrderFour) {
  const auto y1 = positions_after(1.0 / 64, 64), y2 = positions_after(1.0 / 128, 128);
  const auto y4 = positions_after(1.0 / 256, 256), y8 = positions_after(1.0 / 512, 512);
  const double coarse = std::log2(distance(y1, y2) / distance(y2, y4));
  const double fine = std::log2(distance(y2, y4) / distance(y4, y8));
  EXPECT_GT(distance(y4, y8), 100 * 512 * u);  // far above the rounding of 512 steps at size 1
  EXPECT_NEAR(coarse, 4.0, 0.2);
  EXPECT_LT(std::abs(fine - 4.0), 0.75 * std::abs(coarse - 4.0) + 0.01);
}

TEST(RungeKutta4, DoesNotMoveFixedVerticesByABit) {
  Problem problem = a_moving_body();
  problem.initial_velocity.assign(8, {3, -1, 2});
  auto body = build_body<TetMap, every>(problem);
  body.set_state({problem.mesh.points, problem.initial_velocity});  // does not set them going either
  run(body, 0.01, 50);
  const PointState end = body.state();
  for (const auto p : problem.fixed) {
    EXPECT_EQ(std::memcmp(end.x[p].data(), problem.mesh.points[p].data(), 3 * sizeof(double)), 0) << p;
    EXPECT_EQ(end.v[p], Vector3d(0, 0, 0));
  }
  EXPECT_NE(end.x[1], problem.mesh.points[1]);
}

TEST(RungeKutta4, LeavesNoForceBehind) {
  auto body = build_body<TetMap, every>(a_moving_body());
  run(body, 0.01, 1);
  for (const auto& f : body.vertices.force) EXPECT_EQ(f, Vector3d(0, 0, 0));
}

TEST(RungeKutta4, RestsWhereNothingActs) {
  auto body = build_body<TetMap, every>(without_losses(unequal_tetrahedra()));
  const auto before = body.state();
  run(body, 0.01, 20);
  EXPECT_EQ(body.state().x, before.x);
}

TEST(RungeKutta4, MayTakeBodiesOfAnySizeInTurn) {
  auto large = build_body<TetMap, every>(a_moving_body());
  auto small = build_body<TetMap, every>(without_losses(unequal_tetrahedra()));
  RungeKutta4 integrator;
  integrator.step(DartCoverage{}, large, 0.01);
  integrator.step(DartCoverage{}, small, 0.01);
  integrator.step(DartCoverage{}, large, 0.01);
  auto alone = build_body<TetMap, every>(a_moving_body());
  run(alone, 0.01, 2);
  EXPECT_EQ(large.state_hash(), alone.state_hash());
}

// Such a body would move without these forces: a walk computes no force but that of springs along edges.
TEST(RungeKutta4, RefusesABodyWithForcesThatItDoesNotKnow) {
  const auto refused = [](Mesh mesh, const Material& material, auto map, Diagonals diagonals = Diagonals::none) {
    Problem problem = without_losses(std::move(mesh));
    problem.material = material;
    auto body = build_body<decltype(map), every>(problem);
    add_cell_springs(body, problem.mesh, diagonals);
    try {
      run(body, 1e-3, 1);
    } catch (const InputError&) {
      return true;
    }
    return false;
  };
  const Material springs, elements{.young = 1e5, .poisson = 0.3, .model = Model::stvk};
  EXPECT_FALSE(refused(kuhn_box(1, 1, 1, 0.1), springs, TetMap()));
  EXPECT_TRUE(refused(kuhn_box(1, 1, 1, 0.1), elements, TetMap()));
  EXPECT_TRUE(refused(hexahedron_box(1, 1, 1, 0.1), elements, Map3()));
  EXPECT_TRUE(refused(triangle_sheet(1, 1, 0.1), elements, Map2()));
  EXPECT_TRUE(refused(quad_sheet(1, 1, 0.1), elements, Map2()));
  EXPECT_FALSE(refused(hexahedron_box(1, 1, 1, 0.1), springs, Map3()));
  EXPECT_TRUE(refused(hexahedron_box(1, 1, 1, 0.1), springs, Map3(), Diagonals::faces));
}

}  // namespace
}  // namespace dartboard::runge_kutta_4_test
