// Reports of a simulation, in scenes whose numbers are known beforehand and exact.

#include <gtest/gtest.h>

#include <cmath>

#include "core/scene/run/scene_run.h"
#include "tests/support/moving_box.h"

namespace dartboard::simulation_sums_test {
namespace {

using namespace moving;

/// Masses of 1, 2 and 1 kg at (0, 1, 0), (1, 1, 0) and (2, 1, 0).
Json free_chain() {
  return Json::parse(R"({"name": "chain", "step": 0.25, "duration": 1, "gravity": [-1, -2, -3],
                         "body": {"generate": {"chain": {"links": 2, "spacing": 1}}, "translate": [0, 1, 0]},
                         "initial_velocity": [1, 2, 3],
                         "material": {"density": 2, "stiffness": 8, "damping": 0, "viscosity": 0}})");
}

/// A mass of 1 kg that is held, and one that is pulled away from it at 1 m/s.
Json pulled_link() {
  Json scene = free_chain();
  scene["body"] = Json::parse(R"({"generate": {"chain": {"links": 1, "spacing": 1}}})");
  scene["fixed"] = Json::parse(R"([{"ids": [0]}])");
  scene["driven"] = Json::parse(R"([{"ids": [1], "velocity": [1, 0, 0]}])");
  scene["gravity"] = {-2, 0, 0};
  scene["duration"] = 0.5;
  scene.erase("initial_velocity");
  return scene;
}

TEST(Diagnostics, OfAFlyingChainAreThoseOfItsMassesOneByOne) {
  const Diagnostics d = Simulation(parse(free_chain())).diagnostics();
  EXPECT_EQ(d.time, 0.0);
  EXPECT_EQ(d.mass, 4.0);
  EXPECT_EQ(d.kinetic, 4.0 * 14 / 2);
  EXPECT_EQ(d.elastic, 0.0);
  // - sum m g.x = the sum of m (x + 2 y + 3 z)
  EXPECT_EQ(d.gravitational, 1.0 * 2 + 2.0 * 3 + 1.0 * 4);
  EXPECT_EQ(d.energy(), 28.0 + 12.0);
  EXPECT_EQ(d.momentum, Eigen::Vector3d(4, 8, 12));
  // the sum of m x is (4, 4, 0), and that times (1, 2, 3)
  EXPECT_EQ(d.angular_momentum, Eigen::Vector3d(4 * 3 - 0 * 2, 0 * 1 - 4 * 3, 4 * 2 - 4 * 1));
  EXPECT_EQ(d.operations, 0u);
}

TEST(Diagnostics, OfAPulledLinkAreItsTensionAndTheWorkDoneOnIt) {
  Simulation simulation(parse(pulled_link()));
  run(simulation);
  const Diagnostics d = simulation.diagnostics();
  EXPECT_EQ(d.time, 0.5);
  EXPECT_EQ(d.elastic, 8.0 * 0.25 / 2);  // half a metre too long
  EXPECT_EQ(d.kinetic, 0.5);
  EXPECT_EQ(d.gravitational, 2.0 * 1.5);
  EXPECT_EQ(d.largest_stress, 8.0 * 0.5);
  EXPECT_EQ(d.boundary, 0.0);
}

TEST(Diagnostics, CountOperationsAndWhatIsLeft) {
  Simulation simulation(parse(with_events(
      moving_box(), R"([{"at": 0.001, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}},
                        {"at": 0.002, "remove": {"ids": [5, 40]}}])")));
  run(simulation);
  const Diagnostics d = simulation.diagnostics();
  EXPECT_EQ(d.operations, 8u + 2u);  // four squares of two triangles
  EXPECT_EQ(d.counts.cells, 46u);
  EXPECT_EQ(d.counts.components, 2u);
  EXPECT_EQ(d.mass, 46 * 0.25);
}

// ---- counts and boundaries, of bodies with a map and without

Diagnostics of_body(const char* generate, bool with_map) {
  Json scene = moving_box();
  scene["body"]["generate"] = Json::parse(generate);
  if (with_map) scene = with_events(scene, R"([{"at": 0.005, "remove": {"ids": [0]}}])");
  return Simulation(parse(scene)).diagnostics();
}

TEST(Diagnostics, OfABoxCountItsLatticeAndMeasureItsSides) {
  for (const bool with_map : {true, false}) {
    const Diagnostics d = of_body(R"({"box": {"cells": [1, 2, 3], "spacing": 0.25, "kind": "hexahedra"}})", with_map);
    // edges along x, y and z; faces across them
    EXPECT_EQ(d.counts, (CellCounts{.vertices = 2 * 3 * 4,
                                    .edges = 1 * 3 * 4 + 2 * 2 * 4 + 2 * 3 * 3,
                                    .faces = 2 * 2 * 3 + 1 * 3 * 3 + 1 * 2 * 4,
                                    .cells = 6,
                                    .components = 1}));
    EXPECT_EQ(d.boundary, 2 * (1 * 2 + 2 * 3 + 3 * 1) / 16.0);
    EXPECT_EQ(d.largest_stress, 0.0);
  }
}

TEST(Diagnostics, OfASheetCountItsSquaresAndMeasureItsBorder) {
  for (const bool with_map : {true, false}) {
    const Diagnostics d =
        of_body(R"({"sheet": {"cells": [2, 3], "spacing": 0.25, "kind": "quadrilaterals"}})", with_map);
    EXPECT_EQ(d.counts, (CellCounts{.vertices = 12, .edges = 2 * 4 + 3 * 3, .faces = 6, .cells = 6, .components = 1}));
    EXPECT_EQ(d.boundary, 2 * (2 + 3) * 0.25);
  }
}

// ---- frames

TEST(Frame, HasTheVelocityAndMassOfEachPointBesideIt) {
  for (const char* kind : {"tetrahedra", "hexahedra", "mixed"})
    for (const bool with_map : {true, false}) {
      Json scene = moving_box();
      scene["body"]["generate"]["box"]["kind"] = kind;
      if (with_map) scene = with_events(scene, R"([{"at": 0.005, "remove": {"ids": [0]}}])");
      const Simulation simulation(parse(scene));
      const Frame frame = simulation.frame();
      Eigen::Matrix3d linear;
      linear << 1, -2, 0, 2, 0.5, 0, 0, 0, -1;  // moving_box.h; products and sums of few bits: exact
      ASSERT_GE(frame.velocity.size(), 27u);
      double moved = 0.0;
      for (std::size_t k = 0; k < frame.velocity.size(); ++k) {
        const Eigen::Vector3d from_centre = frame.mesh.points[k] - Eigen::Vector3d(0.125, 0.125, 0.125);
        EXPECT_EQ(frame.velocity[k], linear * from_centre) << kind << " " << with_map << " " << k;
        moved += frame.velocity[k].norm();
      }
      EXPECT_GT(moved, 1.0);
      if (kind != std::string("hexahedra")) continue;
      // 1.5 kg of a cube of (1/8 m)^3 at 768 kg/m^3, an eighth to each corner; the middle has all eight cubes
      for (std::size_t k = 0; k < 27; ++k) {
        const Eigen::Vector3d& x = frame.mesh.points[k];
        const double cubes = std::ldexp(1.0, int(x[0] == 0.125) + int(x[1] == 0.125) + int(x[2] == 0.125));
        EXPECT_DOUBLE_EQ(frame.mass[k], cubes * 1.5 / 8);
      }
    }
}

TEST(Frame, HasTheTimeOfItsStep) {
  Simulation simulation(parse(free_chain()));
  for (int n = 0; n < 3; ++n) simulation.advance();
  EXPECT_EQ(simulation.frame().time, 0.75);
  EXPECT_EQ(simulation.diagnostics().time, 0.75);
  EXPECT_EQ(simulation.probes().time, 0.75);
}

TEST(Frame, OfABodyThatFellApartTellsItsCellsAndPartsApart) {
  // the box is cut at the start, and cell 3 is gone: those behind it keep their numbers in the mesh
  const Simulation simulation(parse(
      with_events(moving_box(), R"([{"at": 0, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}},
                        {"at": 0, "remove": {"ids": [3]}}])")));
  const Frame frame = simulation.frame();
  ASSERT_EQ(frame.mesh.cell_count(), 47u);
  std::vector<std::uint32_t> numbers = frame.mesh_cell;
  std::sort(numbers.begin(), numbers.end());
  for (std::uint32_t k = 0; k < 47; ++k) EXPECT_EQ(numbers[k], k < 3 ? k : k + 1);
  // six tetrahedra of each cube, and cubes count along x first
  for (std::size_t c = 0; c < 47; ++c) {
    const bool right = frame.mesh_cell[c] / 6 % 2 == 1;
    for (const std::uint32_t p : frame.mesh.cell(c))
      EXPECT_TRUE(right ? frame.mesh.points[p].x() >= 0.125 : frame.mesh.points[p].x() <= 0.125);
    EXPECT_EQ(frame.component[c] == frame.component[0], right == (frame.mesh_cell[0] / 6 % 2 == 1));
  }
}

// ---- runs

TEST(SceneRun, MeasuresTheDriftOfAllEnergyAgainstThatOfMotionAndSprings) {
  const SceneFile scene = parse(pulled_link());
  Simulation simulation(scene);
  RunWatcher watcher;
  const RunResult result = run_scene(simulation, scene.output, watcher);
  // kinetic 0.5 J; elastic from 0 to 1 J, gravitational from 2 to 3 J
  EXPECT_EQ(result.energy_drift, 2.0 / 1.5);
  EXPECT_EQ(result.first.energy(), 2.5);
  EXPECT_EQ(result.last.energy(), 4.5);
}

TEST(SceneRun, CountsALossOfEnergyForADriftToo) {
  Json json = pulled_link();
  json["gravity"] = {8, 0, 0};
  const SceneFile scene = parse(json);
  Simulation simulation(scene);
  RunWatcher watcher;
  // gravitational from -8 to -12 J, elastic from 0 to 1 J
  EXPECT_EQ(run_scene(simulation, scene.output, watcher).energy_drift, 3.0 / 1.5);
}

TEST(SceneRun, AccountsForMassThatWasRemoved) {
  EXPECT_EQ(mass_unaccounted_for(8.0, 2.0, 6.0), 0.0);
  EXPECT_EQ(mass_unaccounted_for(8.0, 2.0, 5.0), 1.0 / 8);
  EXPECT_EQ(mass_unaccounted_for(8.0, 0.0, 10.0), 2.0 / 8);
  EXPECT_EQ(mass_unaccounted_for(0.0, 0.0, 0.0), 0.0);
}

// A driven end starts after two steps, and the third cannot be taken: a spring of 1e300 N/m is stretched by 1e-3 m,
// pulls by 1e297 N, and that moves its end by 1e291 m within the step, where its force is beyond the range of
// doubles. The state kept last is that of the drive's start: one step, which only the integrator has seen, is taken
// back.
TEST(Simulation, TakesBackAStepThatTheIntegratorCouldNotTake) {
  Json scene = free_chain();
  scene["material"]["stiffness"] = 1e300;
  scene["gravity"] = {0, 0, 0};
  scene["initial_velocity"] = {0, 0, 0};
  scene["driven"] = Json::parse(R"([{"ids": [0], "velocity": [1, 0, 0], "from": 0.002}])");
  scene["step"] = 0.001;
  scene["duration"] = 0.01;
  Simulation simulation(parse(scene));
  ASSERT_FALSE(simulation.advance());
  ASSERT_FALSE(simulation.advance());
  const auto start = simulation.body().vertices().position;
  const auto divergence = divergence_of_step(simulation);
  ASSERT_TRUE(divergence);
  EXPECT_EQ(divergence->step, 3u);
  EXPECT_EQ(divergence->taken_back, 1u);
  EXPECT_EQ(simulation.body().vertices().position, start);
}

}  // namespace
}  // namespace dartboard::simulation_sums_test
