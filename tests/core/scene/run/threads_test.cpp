// The bits of a motion do not depend on the number of threads.

#include <gtest/gtest.h>

#include <string>

#include "core/base/archive.h"
#include "core/base/thread_team.h"
#include "core/scene/output/write_vtu.h"
#include "core/time/system/accelerations.h"
#include "tests/support/moving_box.h"

namespace dartboard::threads_test {
namespace {

using namespace moving;

/// A number of threads as long as it is there.
class Threads {
 public:
  explicit Threads(unsigned count) : before_(use_threads(count)) {}
  ~Threads() { use_threads(before_); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;

 private:
  unsigned before_;
};

/// A body with enough elements to be shared, damped and viscous, some vertices held, pulled and driven; cut on the way.
Json elements(const char* kind, const char* model) {
  Json scene = Json::parse(R"({
    "name": "large", "step": 0.0001, "duration": 0.0005,
    "body": {"generate": {"box": {"cells": [9, 8, 7], "spacing": 0.125}}},
    "material": {"density": 768, "young": 2e4, "poisson": 0.3, "viscosity": 0.5, "damping": {"ratio": 0.05, "frequency": 2}},
    "initial_velocity": {"linear": [[1, -2, 0], [2, 0.5, 0], [0, 0, -1]], "centre": [0.5, 0.5, 0.5]},
    "fixed": [{"box": {"min": [0, 0, 0], "max": [0, 1, 0.5]}}, {"box": {"min": [1.125, 0, 0], "max": [1.125, 1, 0.5]}, "axes": ["x"]}],
    "driven": [{"box": {"min": [0, 1, 0.75], "max": [0.1, 1, 1]}, "velocity": [0, 1, 0]}],
    "forces": [{"plane": {"point": [0, 0, 0.875], "normal": [0, 0, 1]}, "acceleration": [3, 0, 1]}],
    "events": [{"at": 0.0002, "dissociate": {"plane": {"point": [0.5, 0, 0], "normal": [1, 0.2, 0]}}}]})");
  scene["body"]["generate"]["box"]["kind"] = kind;
  scene["material"]["model"] = model;
  return scene;
}
bool is_shared(const Simulation& simulation) { return terms_of(simulation.body().system()).is_shared(); }

void expect_equal_bits(const Json& scene) {
  std::uint64_t alone = 0;
  for (const unsigned threads : {1u, 3u}) {
    const Threads in_use(threads);
    Simulation simulation(parse(scene));
    EXPECT_EQ(is_shared(simulation), threads > 1);
    run(simulation);
    EXPECT_GT(simulation.operations(), 0u);
    if (threads == 1)
      alone = simulation.body().state_hash();
    else
      EXPECT_EQ(simulation.body().state_hash(), alone) << threads << " threads, " << scene["integrator"];
  }
}

TEST(Threads, MoveElementsWithTheBitsOfOne) {
  for (const char* model : {"neo-hookean", "corotational"}) {
    Json scene = elements("tetrahedra", model);
    scene["integrator"] = "rk4";
    expect_equal_bits(scene);
  }
  Json scene = elements("hexahedra", "stvk");
  scene["body"]["generate"]["box"]["cells"] = {14, 14, 13};
  expect_equal_bits(scene);
}

TEST(Threads, MoveUnderEveryExplicitIntegratorWithTheBitsOfOne) {
  for (const char* integrator :
       {"explicit-euler", "symplectic-euler", "verlet", "blanes-moan-4", "dormand-prince-54", "verlet-compensated"}) {
    Json scene = elements("tetrahedra", "neo-hookean");
    scene["integrator"] = integrator;
    expect_equal_bits(scene);
  }
}

TEST(Threads, MoveSolidsAndSurfacesTogetherWithTheBitsOfOne) {
  Json scene = elements("tetrahedra", "neo-hookean");
  scene["bodies"] =
      Json::array({scene["body"],
                   Json::parse(R"({"generate": {"sheet": {"cells": [30, 30], "spacing": 0.05}}, "translate": [3, 0, 0],
    "material": {"density": 0.2, "young": 60, "poisson": 0.3}})")});
  scene.erase("body");
  scene["integrator"] = "verlet";
  expect_equal_bits(scene);
}

/// All that a run of the scene depends on at its start, and all that it reports there.
std::string start_of(const Json& scene, unsigned threads) {
  const Threads in_use(threads);
  const Simulation simulation(parse(scene));
  Archive archive;
  simulation.save(archive);
  return archive.written() + to_vtu(simulation.frame()) + diagnostics_row(simulation.diagnostics());
}

TEST(Threads, MakeLargeBodiesWithTheBitsOfOne) {
  Json scene = elements("tetrahedra", "neo-hookean");
  scene["body"]["generate"]["box"]["cells"] = {16, 16, 16};
  EXPECT_EQ(start_of(scene, 1), start_of(scene, 3));
  scene["material"] = {{"density", 768}, {"stiffness", 20}, {"damping", 0.1}};
  EXPECT_EQ(start_of(scene, 1), start_of(scene, 3));
  scene.erase("events");
  EXPECT_EQ(start_of(scene, 1), start_of(scene, 3));
  scene["body"]["generate"]["box"] = {{"cells", {28, 28, 28}}, {"spacing", 0.125}, {"kind", "hexahedra"}};
  EXPECT_EQ(start_of(scene, 1), start_of(scene, 3));
}

TEST(Threads, LeaveSmallBodiesToOne) {
  const Threads in_use(2);
  EXPECT_FALSE(is_shared(Simulation(parse(moving_box()))));
}

}  // namespace
}  // namespace dartboard::threads_test
