// Refusals of the reference for invalid input: each names the wrong numbers, each in its place.

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "core/plain/error.h"
#include "reference/adjacency_graph.h"
#include "reference/cgal/cgal_body.h"
#include "reference/error_norms.h"
#include "reference/ode_codes.h"
#include "reference/summation_bound.h"
#include "tests/support/meshes_for_tests.h"

namespace dartboard::reference::reference_messages_test {
namespace {

std::string refusal(const std::function<void()>& action) {
  try {
    action();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no refusal";
}

Problem one_tetrahedron() {
  Problem problem;
  problem.mesh = regular_tetrahedron();
  return problem;
}

PointState still(std::size_t positions, std::size_t velocities) {
  return {std::vector<Eigen::Vector3d>(positions, {0, 0, 0}), std::vector<Eigen::Vector3d>(velocities, {0, 0, 0})};
}

// Four points in a row, three springs; an event after 2 s that renumbers them.
NetworkMotion row() {
  NetworkMotion motion;
  motion.network.mass.assign(4, 1.0);
  motion.network.fixed.assign(4, 0);
  motion.network.springs = {{0, 1, 8.0, 0.5, 1.0}, {1, 2, 8.0, 0.5, 1.0}, {2, 3, 8.0, 0.5, 1.0}};
  motion.start = still(4, 4);
  for (std::size_t i = 0; i < 4; ++i) motion.start.x[i][0] = static_cast<double>(i);
  motion.checkpoints = {1.0, 3.0};
  motion.events = {{2.0, motion.network, {3, 2, 1, 0}}};
  return motion;
}

std::string refusal_of(const std::function<void(NetworkMotion&)>& spoil) {
  NetworkMotion motion = row();
  spoil(motion);
  return refusal([&] { check(motion); });
}

TEST(ReferenceRefuses, AStateOfAnotherBodyByItsPositionsVelocitiesAndThePointsThereAre) {
  const Problem problem = one_tetrahedron();
  for (const auto& [positions, velocities] : {std::pair{4, 3}, std::pair{3, 4}, std::pair{5, 2}}) {
    const PointState state = still(static_cast<std::size_t>(positions), static_cast<std::size_t>(velocities));
    const std::string expected = "a state of " + std::to_string(positions) + " positions and " +
                                 std::to_string(velocities) + " velocities for 4 points";
    EXPECT_EQ(refusal([&] { AdjacencyGraph(problem).set_state(state); }), expected);
    EXPECT_EQ(refusal([&] { CgalBody(problem).set_state(state); }), expected);
    EXPECT_EQ(refusal([&] { force_bound(problem, state); }), expected);
    EXPECT_EQ(refusal([&] { state_bound(problem, state, 1); }), expected);
    EXPECT_EQ(refusal([&] { centre_of_mass(row().network, state); }), expected);
    EXPECT_EQ(refusal([&] { sums_of(row().network, state, {0, 0, 0}); }), expected);
  }
  EXPECT_EQ(refusal([&] { AdjacencyGraph(problem).set_state(still(4, 4)); }), "no refusal");
  EXPECT_EQ(refusal([&] { CgalBody(problem).set_state(still(4, 4)); }), "no refusal");
  EXPECT_EQ(refusal([&] { centre_of_mass(row().network, still(4, 4)); }), "no refusal");
}

TEST(ReferenceRefuses, StatesThatAreNotThoseOfTheCheckpoints) {
  const NetworkMotion motion = row();
  const std::vector<PointState> two(2, still(4, 4)), three(3, still(4, 4));
  EXPECT_EQ(refusal([&] { motion_errors(motion, three, two); }), "3 states and 2 of the reference at 2 checkpoints");
  EXPECT_EQ(refusal([&] { motion_errors(motion, two, three); }), "2 states and 3 of the reference at 2 checkpoints");
  EXPECT_EQ(refusal([&] { motion_errors(motion, two, two); }), "no refusal");
  std::vector<PointState> short_one = two;
  short_one[1] = still(3, 4);
  EXPECT_EQ(refusal([&] { motion_errors(motion, two, short_one); }),
            "a state of 3 positions and 4 velocities for 4 points");
}

TEST(ReferenceRefuses, AProblemThatHasNoBody) {
  Problem problem = one_tetrahedron();
  problem.initial_velocity.assign(3, {0, 0, 0});
  EXPECT_EQ(refusal([&] { AdjacencyGraph{problem}; }), "3 initial velocities for 4 points");
  problem = one_tetrahedron();
  problem.h = -0.5;
  EXPECT_EQ(refusal([&] { AdjacencyGraph{problem}; }), "the time step -0.5 is not > 0");
  problem = one_tetrahedron();
  problem.fixed = {2, 7};
  EXPECT_EQ(refusal([&] { AdjacencyGraph{problem}; }), "fixed point 7 does not exist, there are 4");
  EXPECT_EQ(refusal([&] { force_bound(problem, still(4, 4)); }), "fixed point 7 does not exist");
  EXPECT_EQ(refusal([&] { spring_network(problem); }), "point 7 is fixed, and there are 4");
  problem.fixed = {4};  // the first that does not exist
  EXPECT_EQ(refusal([&] { AdjacencyGraph{problem}; }), "fixed point 4 does not exist, there are 4");
  EXPECT_EQ(refusal([&] { spring_network(problem); }), "point 4 is fixed, and there are 4");
  problem = one_tetrahedron();
  problem.mesh.points.emplace_back(9, 9, 9);
  EXPECT_EQ(refusal([&] { AdjacencyGraph{problem}; }), "the mass of point 4 is 0, not > 0");
}

TEST(ReferenceRefuses, ACellThatNamesNoPointOrOneTwice) {
  Mesh mesh = unequal_tetrahedra();
  mesh.nodes[6] = 5;
  EXPECT_EQ(refusal([&] { rebuild(mesh, {}); }), "cell 1 names point 5, and there are 5");
  mesh.nodes[6] = 2;
  EXPECT_EQ(refusal([&] { rebuild(mesh, {}); }), "cell 1 names point 2 twice");
}

TEST(ReferenceRefuses, AMeshThatIsNoMap) {
  Problem three;
  three.mesh = unequal_tetrahedra();
  three.mesh.points.emplace_back(1, 1, 1);
  three.mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{0, 1, 2, 5});
  EXPECT_EQ(refusal([&] { CgalBody{three}; }), "3 darts from point 0 to 1 would be 3-linked; a map has room for two");
  Problem pinched = one_tetrahedron();
  pinched.mesh.points.insert(pinched.mesh.points.end(), {{2, 1, 1}, {1, 2, 1}, {1, 1, 2}});
  pinched.mesh.add_cell(CellKind::tetrahedron, std::array<std::uint32_t, 4>{3, 4, 5, 6});
  EXPECT_EQ(refusal([&] { CgalBody{pinched}; }), "point 3 is pinched: it lies on two vertices of the map");
}

TEST(ReferenceRefuses, ANetworkByTheFirstThingThatIsWrong) {
  EXPECT_EQ(refusal_of([](auto&) {}), "no refusal");
  EXPECT_EQ(refusal_of([](auto& m) { m.network.fixed.pop_back(); }), "4 points, 3 entries in `fixed`");
  EXPECT_EQ(refusal_of([](auto& m) { m.network.mass[2] = -3.0; }), "point 2 has a mass of -3, expected a positive one");
  EXPECT_EQ(refusal_of([](auto& m) { m.network.mass[3] = std::numeric_limits<double>::infinity(); }),
            "point 3 has a mass of inf, expected a positive one");
  EXPECT_EQ(refusal_of([](auto& m) { m.network.springs[1].b = 4; }), "spring 1 joins points 1 and 4 of 4");
  EXPECT_EQ(refusal_of([](auto& m) { m.network.springs[0].a = 5; }), "spring 0 joins points 5 and 1 of 4");
  EXPECT_EQ(refusal_of([](auto& m) { m.network.springs[2].b = 2; }), "spring 2 joins points 2 and 2 of 4");
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(refusal_of([&](auto& m) { m.network.springs[0].stiffness = none; }),
            "spring 0 has a number that is not finite");
  EXPECT_EQ(refusal_of([&](auto& m) { m.network.springs[1].damping = none; }),
            "spring 1 has a number that is not finite");
  EXPECT_EQ(refusal_of([&](auto& m) { m.network.springs[2].rest_length = none; }),
            "spring 2 has a number that is not finite");
  EXPECT_EQ(refusal_of([&](auto& m) { m.network.viscosity = none; }), "viscosity and gravity must be finite");
  EXPECT_EQ(refusal_of([&](auto& m) { m.network.gravity[1] = none; }), "viscosity and gravity must be finite");
}

TEST(ReferenceRefuses, AStartThatIsNotOneOfTheNetwork) {
  EXPECT_EQ(refusal_of([](auto& m) { m.start = still(4, 3); }),
            "the start has 4 positions and 3 velocities for 4 points");
  EXPECT_EQ(refusal_of([](auto& m) { m.start = still(5, 4); }),
            "the start has 5 positions and 4 velocities for 4 points");
  EXPECT_EQ(refusal_of([](auto& m) { m.start.x[3][2] = std::numeric_limits<double>::infinity(); }),
            "the start is not finite");
  EXPECT_EQ(refusal_of([](auto& m) { m.start.v[0][1] = std::numeric_limits<double>::quiet_NaN(); }),
            "the start is not finite");
}

TEST(ReferenceRefuses, TimesThatDoNotAscend) {
  EXPECT_EQ(refusal_of([](auto& m) { m.checkpoints.clear(); }), "there is no checkpoint");
  EXPECT_EQ(refusal_of([](auto& m) { m.checkpoints[0] = 0.0; }), "checkpoint 0 s after 0 s");
  EXPECT_EQ(refusal_of([](auto& m) { m.checkpoints[1] = 0.5; }), "checkpoint 0.5 s after 1 s");
  EXPECT_EQ(refusal_of([](auto& m) { m.checkpoints[1] = 1.0; }), "checkpoint 1 s after 1 s");
  EXPECT_EQ(refusal_of([](auto& m) { m.checkpoints[1] = std::numeric_limits<double>::infinity(); }),
            "checkpoint inf s after 1 s");
  EXPECT_EQ(refusal_of([](auto& m) { m.events[0].time = 0.0; }), "event at 0 s after 0 s");
  EXPECT_EQ(refusal_of([](auto& m) {
              m.events.push_back({1.5, m.network, {0, 1, 2, 3}});
            }),
            "event at 1.5 s after 2 s");
  // several at one time are several
  EXPECT_EQ(refusal_of([](auto& m) { m.events.push_back({2.0, m.network, {0, 1, 2, 3}}); }), "no refusal");
}

TEST(ReferenceRefuses, AnEventWhosePointsComeFromNowhere) {
  EXPECT_EQ(refusal_of([](auto& m) { m.events[0].from.pop_back(); }), "event at 2 s gives the origin of 3 points of 4");
  EXPECT_EQ(refusal_of([](auto& m) { m.events[0].from[1] = 4; }), "event at 2 s: a point comes from point 4 of 4");
  // the points before the second event are those that the first one left: three
  const auto second_from = [](std::uint32_t last) {
    return refusal_of([last](auto& m) {
      SpringNetwork three = m.network;
      three.mass.pop_back();
      three.fixed.pop_back();
      three.springs.pop_back();
      m.events = {{2.0, three, {0, 1, 2}}, {2.5, three, {0, 1, last}}};
    });
  };
  EXPECT_EQ(second_from(2), "no refusal");
  EXPECT_EQ(second_from(3), "event at 2.5 s: a point comes from point 3 of 3");
}

TEST(ReferenceRefuses, StepsAndTolerancesThatAreNotPositive) {
  const NetworkMotion motion = row();
  for (const double none : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_EQ(refusal([&] { run_odeint_fehlberg(motion, none); }), "the step must be positive");
    EXPECT_EQ(refusal([&] { run_odeint_bulirsch_stoer(motion, none); }), "the tolerance must be positive");
    if (!have_sundials()) continue;
    EXPECT_EQ(refusal([&] { run_cvode_adams(motion, none); }), "the tolerance must be positive");
    EXPECT_EQ(refusal([&] { run_arkode_fehlberg(motion, 1e-9, none); }), "the tolerance must be positive");
  }
}

}  // namespace
}  // namespace dartboard::reference::reference_messages_test
