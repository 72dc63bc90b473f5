#include "reference/adjacency_graph.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "core/plain/error.h"
#include "reference/closed_form.h"
#include "reference/summation_bound.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::reference::adjacency_graph_test {
namespace {

constexpr double u = 0x1p-53;

double largest(const std::vector<Eigen::Vector3d>& a, const std::vector<Eigen::Vector3d>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) most = std::max(most, (a[i] - b[i]).lpNorm<Eigen::Infinity>());
  return most;
}

Problem weightless(Mesh mesh) {
  Problem problem;
  problem.mesh = std::move(mesh);
  problem.surroundings.gravity.setZero();
  return problem;
}

// A regular tetrahedron that breathes: x_i = (1 + q) R_i. The pulls of its edges add up to -4 R_i / L times the
// tension, so m q'' = -4 k q - (4 c + viscosity m) q' without any approximation: a nonlinear body with a linear motion.
struct Breathing {
  Problem problem = weightless(regular_tetrahedron());
  Swing start{0.125, 0.5};
  double omega2, drag;

  explicit Breathing(double h) {
    problem.material = {.density = 1.5, .stiffness = 25.0, .damping = 0.3, .viscosity = 0.2};  // points of 1 kg
    problem.h = h;
    omega2 = 4.0 * 25.0;
    drag = 4.0 * 0.3 + 0.2;
  }
  PointState state(const Swing& s) const {
    PointState out;
    for (const auto& r : problem.mesh.points) {
      out.x.push_back((1.0 + s.q) * r);
      out.v.push_back(s.v * r);
    }
    return out;
  }
  PointState run(int steps) const {
    AdjacencyGraph body(problem);
    body.set_state(state(start));
    body.step(steps);
    return body.state();
  }
};

TEST(AdjacencyGraph, HasTheCellsOfItsMesh) {
  const AdjacencyGraph body(weightless(unequal_tetrahedra()));
  EXPECT_EQ(body.nodes(), 5u);
  EXPECT_EQ(body.springs(), 9u);
  EXPECT_EQ(body.cells(), 2u);
  EXPECT_EQ(body.masses().size(), 5u);
  EXPECT_EQ(body.spring_list()[0].b, 1u);
}

TEST(AdjacencyGraph, DoesNotMoveAtRest) {
  const Problem problem = weightless(kuhn_grid(2, 2, 2, 0.1, 0.1, 1));
  AdjacencyGraph body(problem);
  body.step(10);
  EXPECT_EQ(body.state().x, problem.mesh.points);  // lengths and rest lengths are computed alike: no force at all
}

TEST(AdjacencyGraph, BreathesAsRungeKuttaOfALinearOscillator) {
  const Breathing b(0.01);
  const int steps = 20;
  const PointState end = b.run(steps), expected = b.state(rk4_oscillate(b.omega2, b.drag, b.start, 0.01, steps));
  // the bound for two implementations, and for the 2 x 2 map some 16 roundings a step on numbers below 2 (x) and 4 (v)
  const StateBound bound = state_bound(b.problem, b.state(b.start), steps);
  EXPECT_LE(largest(end.x, expected.x), bound.position + 16 * steps * u * 2);
  EXPECT_LE(largest(end.v, expected.v), bound.velocity + 16 * steps * u * 4);
}

TEST(AdjacencyGraph, ConvergesToTheMotionWithOrderFour) {
  // the distance in phase space, omega q and v together: for one of them alone the leading term vanishes at times
  const auto error = [](int steps) {
    const Breathing b(0.64 / steps);
    const PointState end = b.run(steps), exact = b.state(oscillate(b.omega2, b.drag, b.start, 0.64));
    return std::hypot(std::sqrt(b.omega2) * largest(end.x, exact.x), largest(end.v, exact.v));
  };
  // the error is C h^4 (1 + O(h omega)), here h omega = 0.1 and 0.05: the measured order is 4 up to log2 of 1 +- 0.1
  EXPECT_NEAR(std::log2(error(64) / error(128)), 4.0, 0.15);
}

TEST(AdjacencyGraph, FallsAlongTheParabolaThatRungeKuttaReproduces) {
  Problem problem;
  problem.mesh = kuhn_grid(2, 1, 1, 0.1, 0.1, 2);
  problem.material.viscosity = 0.0;
  problem.initial_velocity.assign(problem.mesh.points.size(), {1.0, 0.5, 2.0});
  AdjacencyGraph body(problem);
  const PointState start = body.state();
  body.step(10);
  const PointState end = body.state();
  // polynomials up to degree 4 are integrated exactly, so only rounding remains
  const StateBound bound = state_bound(problem, start, 10);
  for (std::size_t i = 0; i < body.nodes(); ++i) {
    const Flight exact = free_fall({start.x[i], start.v[i]}, problem.surroundings.gravity, 0.0, 10 * problem.h);
    EXPECT_LE((end.x[i] - exact.x).lpNorm<Eigen::Infinity>(), bound.position);
    EXPECT_LE((end.v[i] - exact.v).lpNorm<Eigen::Infinity>(), bound.velocity);
  }
}

TEST(AdjacencyGraph, ExertsNoForceAndNoTorqueOnItselfAndKeepsMomentum) {
  Problem problem = weightless(kuhn_grid(2, 2, 2, 0.1));
  problem.material.viscosity = 0.0;
  AdjacencyGraph body(problem);
  PointState start = body.state();
  for (auto& x : start.x) x = {1.25 * x[0], 0.75 * x[1], x[2] + 0.5 * x[0]};
  body.set_state(start);

  // inner forces are opposite and along the line between their points: no force and no torque, up to their rounding
  const auto forces = body.spring_and_drag_forces();
  const auto bound = force_bound(problem, start);
  Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = force;
  double force_rounding = 0.0, torque_rounding = 0.0;
  for (std::size_t i = 0; i < body.nodes(); ++i) {
    const Eigen::Vector3d arm = start.x[i];
    force += forces[i];
    torque += arm.cross(forces[i]);
    force_rounding += bound[i] + 30 * u * forces[i].norm();                  // and 27 terms to add
    torque_rounding += arm.norm() * (bound[i] + 33 * u * forces[i].norm());  // and a cross product
  }
  EXPECT_LE(force.norm(), force_rounding);
  EXPECT_LE(torque.norm(), torque_rounding);

  // Runge-Kutta keeps linear invariants, so momentum stays zero up to the rounding of the velocities
  body.step(10);
  const PointState end = body.state();
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
  double allowed = 0.0;
  const StateBound after = state_bound(problem, start, 10);
  for (std::size_t i = 0; i < body.nodes(); ++i) {
    momentum += body.masses()[i] * end.v[i];
    allowed += body.masses()[i] * (after.velocity + 30 * u * end.v[i].norm());
  }
  EXPECT_LE(momentum.lpNorm<Eigen::Infinity>(), allowed);
  EXPECT_GT(largest(end.v, start.v), 0.0);
}

TEST(AdjacencyGraph, HoldsFixedPointsStillWhateverTheirInitialVelocity) {
  Problem problem;
  problem.mesh = kuhn_grid(1, 1, 1, 0.1);
  problem.fixed = {0, 3};
  problem.initial_velocity.assign(8, {1.0, 2.0, 3.0});
  AdjacencyGraph body(problem);
  body.step(5);
  for (std::uint32_t i : problem.fixed) {
    EXPECT_EQ(body.state().x[i], problem.mesh.points[i]);
    EXPECT_EQ(body.state().v[i], Eigen::Vector3d(0, 0, 0));
  }
  EXPECT_NE(body.state().x[1], problem.mesh.points[1]);
  EXPECT_NE(body.spring_and_drag_forces()[0], Eigen::Vector3d(0, 0, 0));
}

TEST(AdjacencyGraph, ContinuesBitForBitFromARestoredState) {
  const Breathing b(0.01);
  AdjacencyGraph body(b.problem);
  body.set_state(b.state(b.start));
  body.step(3);
  const PointState middle = body.state();
  body.step(4);
  const PointState end = body.state();
  body.set_state(middle);
  body.step(4);
  EXPECT_EQ(body.state().x, end.x);
  EXPECT_EQ(body.state().v, end.v);
}

TEST(AdjacencyGraph, HasNoForceInASpringOfNoLength) {
  Problem problem = weightless(regular_tetrahedron());
  AdjacencyGraph body(problem);
  PointState state = body.state();
  state.x.assign(4, {1.0, 1.0, 1.0});
  body.set_state(state);
  for (const auto& f : body.spring_and_drag_forces()) EXPECT_EQ(f.norm(), 0.0);
}

TEST(AdjacencyGraph, RefusesWhatIsNoProblem) {
  Problem problem = weightless(regular_tetrahedron());
  problem.fixed = {4};
  EXPECT_THROW(AdjacencyGraph{problem}, InputError);
  problem.fixed.clear();
  problem.initial_velocity.resize(3);
  EXPECT_THROW(AdjacencyGraph{problem}, InputError);
  problem.initial_velocity.clear();
  problem.h = 0.0;
  EXPECT_THROW(AdjacencyGraph{problem}, InputError);
  problem.h = 1e-3;
  problem.mesh.points.emplace_back(9, 9, 9);  // in no cell: it has no mass
  EXPECT_THROW(AdjacencyGraph{problem}, InputError);
  problem.mesh.points.pop_back();
  EXPECT_THROW(AdjacencyGraph{problem}.set_state({}), InputError);
}

}  // namespace
}  // namespace dartboard::reference::adjacency_graph_test
