// Changes by an event that must not happen, measured on bodies that are changed on purpose.

#include "core/scene/timeline/event_jumps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

#include "core/meshes/generators/mesh_generators.h"
#include "tests/support/moving_box.h"

namespace dartboard::event_jumps_test {
namespace {

using namespace moving;

/// Two masses of 1 kg at a distance of 1 m, and a spring of 8 N/m between them.
Problem link() {
  Problem problem;
  problem.mesh.points = {{0, 0, 0}, {1, 0, 0}};
  problem.mesh.links = {{0, 1}};
  problem.material = {.density = 2.0, .stiffness = 8.0, .damping = 0.0, .viscosity = 0.0};
  return problem;
}

/// An event with an arbitrary effect on a body.
struct Push : ReadyEvent {
  explicit Push(std::function<std::size_t()> what) : act(std::move(what)) {}
  std::size_t apply(EventTargets*) override { return act(); }
  std::size_t repeat(const EventTargets&) override { return act(); }
  std::function<std::size_t()> act;
};

TEST(KeptSums, AreMassEnergyOfMotionAndOfSpringsAndMomentum) {
  const auto body = make_simulated_body(link(), false);
  const Motion motion = body->motion();
  motion.x[1] = {1.5, 0, 0};
  motion.v[0] = {0, 3, 4};
  motion.v[1] = {-1, 0, 0};
  const KeptSums sums = kept_sums(*body);
  EXPECT_EQ(sums.mass, 2.0);
  EXPECT_EQ(sums.stiffness, 8.0);
  EXPECT_EQ(sums.energy, 12.5 + 0.5 + 8.0 * 0.25 / 2);
  EXPECT_EQ(sums.momentum, Eigen::Vector3d(-1, 3, 4));
  EXPECT_EQ(sums.size_of_momentum, 5.0 + 1.0);
}

const KeptSums before{
    .mass = 4, .stiffness = 16, .energy = 10, .contact = 1, .momentum = {1, 0, 0}, .size_of_momentum = 8};

TEST(EventJumps, AreRelativeToWhatWasThereBefore) {
  EventJumps jumps;
  jumps.add(before,
            {.mass = 3, .stiffness = 17, .energy = 15, .contact = 3, .momentum = {1, 3, 4}, .size_of_momentum = 100});
  EXPECT_EQ(jumps.events, 1u);
  EXPECT_EQ(jumps.mass, 1.0 / 4);
  EXPECT_EQ(jumps.stiffness, 1.0 / 16);
  EXPECT_EQ(jumps.energy, 5.0 / 10);
  EXPECT_EQ(jumps.contact, 2.0 / 10);
  EXPECT_EQ(jumps.momentum, 5.0 / 8);
}

TEST(EventJumps, AreTheLargestOfAllEventsEachOfItsKind) {
  EventJumps jumps;
  jumps.add(before,
            {.mass = 5, .stiffness = 16, .energy = 10, .contact = 1, .momentum = {1, 0, 0}, .size_of_momentum = 8});
  jumps.add(before,
            {.mass = 4, .stiffness = 12, .energy = 7.5, .contact = 1, .momentum = {1, 0, 0}, .size_of_momentum = 8});
  jumps.add(before,
            {.mass = 4, .stiffness = 16, .energy = 10, .contact = 1, .momentum = {0, 0, 0}, .size_of_momentum = 8});
  EXPECT_EQ(jumps.events, 3u);
  EXPECT_EQ(jumps.mass, 1.0 / 4);
  EXPECT_EQ(jumps.stiffness, 4.0 / 16);
  EXPECT_EQ(jumps.energy, 2.5 / 10);
  EXPECT_EQ(jumps.momentum, 1.0 / 8);
}

TEST(EventJumps, AreNoneWhereNothingChangesThoughThereWasNothing) {
  const KeptSums nothing{
      .mass = 0, .stiffness = 0, .energy = 0, .contact = 0, .momentum = {0, 0, 0}, .size_of_momentum = 0};
  EventJumps jumps;
  jumps.add(nothing, nothing);
  EXPECT_EQ(jumps.mass, 0.0);
  EXPECT_EQ(jumps.energy, 0.0);
  EXPECT_EQ(jumps.momentum, 0.0);
}

TEST(EventJumps, KeepWhatIsNoNumber) {
  EventJumps jumps;
  KeptSums lost = before;
  lost.energy = std::numeric_limits<double>::quiet_NaN();
  jumps.add(before, lost);
  jumps.add(before, before);
  EXPECT_TRUE(std::isnan(jumps.energy));
}

TEST(EventJumps, OfAnEventAreMeasuredOnBothSidesOfIt) {
  const auto body = make_simulated_body(link(), false);
  const Motion motion = body->motion();
  motion.v[0] = {2, 0, 0};  // 2 J, 2 kg m/s
  EventJumps jumps;
  Push kick([&] {
    motion.v[1] = {0, 1, 0};  // half a joule and 1 kg m/s more
    return 3;
  });
  EXPECT_EQ(apply_watched(kick, *body, jumps), 3u);
  EXPECT_EQ(jumps.events, 1u);
  EXPECT_EQ(jumps.mass, 0.0);
  EXPECT_EQ(jumps.momentum, 1.0 / 2);
  EXPECT_EQ(jumps.energy, 0.5 / 2);
}

TEST(EventJumps, OfAnEventThatFindsNothingToDoAreNotCounted) {
  const auto body = make_simulated_body(link(), false);
  EventJumps jumps;
  Push idle([] { return 0; });
  EXPECT_EQ(apply_watched(idle, *body, jumps), 0u);
  EXPECT_EQ(jumps.events, 0u);
}

// A dissociation changes no mass of a cell: any loss occurs where a vertex or an edge comes apart.
TEST(EventJumps, AreOfTheMassesOfVerticesAndTheStiffnessesOfSprings) {
  Problem problem;
  problem.mesh = kuhn_box(2, 2, 2, 0.125);
  problem.material = {.density = 768.0, .stiffness = 64.0, .damping = 0.0, .viscosity = 0.0};
  const auto body = make_simulated_body(problem, true);
  EventJumps jumps;
  Push halving([&] {
    const_cast<VertexColumns&>(body->vertices()).mass[5] *= 0.5;
    return 1;
  });
  const double lost = 0.5 * body->vertices().mass[5];
  EXPECT_EQ(apply_watched(halving, *body, jumps), 1u);
  EXPECT_EQ(jumps.mass, lost / 12.0);
}

TEST(EventJumps, OfARemovalAreTheMassRemoved) {
  const SceneFile scene = parse(with_events(moving_box(), R"([{"at": 0.005, "remove": {"ids": [3, 7, 11]}}])"));
  const Simulation simulation(scene);
  Problem problem;
  problem.mesh = kuhn_box(2, 2, 2, 0.125);
  problem.material = scene.material;
  const auto body = make_simulated_body(problem, true);
  const auto event = body->make_ready(scene.events.at(0));
  EventJumps jumps;
  EXPECT_EQ(apply_watched(*event, *body, jumps), 3u);
  EXPECT_EQ(jumps.mass, 0.75 / 12);  // a quarter of a kilogram each (moving_box.h)
}

TEST(Simulation, WatchesTheEventsThatOnlyDissociateWhileItIsAskedTo) {
  const char* events = R"([{"at": 0.001, "remove": {"ids": [5]}},
                           {"at": 0.002, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}},
                           {"at": 0.003, "refine": {"cells": {"ids": [20]}}},
                           {"at": 0.004, "tear": {"vertex": 26, "direction": [0, 1, 0]}}])";
  for (const bool watch : {true, false}) {
    Simulation simulation(parse(with_events(moving_box(), events)));
    simulation.watch_events(watch);
    run(simulation);
    EXPECT_EQ(simulation.idle_events(), std::vector<std::string>{});
    EXPECT_EQ(simulation.jumps().events, watch ? 2u : 0u);
    // sums of at most 2^7 terms with at most 2^4 roundings each
    EXPECT_LE(simulation.jumps().mass, 0x1p-42);
    EXPECT_LE(simulation.jumps().stiffness, 0x1p-42);
    EXPECT_LE(simulation.jumps().momentum, 0x1p-42);
    EXPECT_LE(simulation.jumps().energy, 0x1p-42);
  }
}

}  // namespace
}  // namespace dartboard::event_jumps_test
