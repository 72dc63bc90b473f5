// A body for programs moves as a simulation of the same scene does, and reports what operations do to it.

#include "core/scene/soft_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/output/write_vtu.h"
#include "core/time/system/energy.h"
#include "tests/support/folder_for_tests.h"
#include "tests/support/moving_box.h"

namespace dartboard::soft_body_test {
namespace {

using namespace moving;

Problem box_problem() {
  Problem problem;
  problem.mesh = kuhn_box(2, 2, 2, 0.125);
  problem.material = {.density = 768, .stiffness = 64, .damping = 0.25, .viscosity = 0.5};
  for (const Eigen::Vector3d& p : problem.mesh.points) problem.initial_velocity.emplace_back(p.y(), -2 * p.x(), p.z());
  return problem;
}

/// A run of a scene with the given body and material; a cut after 5 of 10 steps unless the body is a chain.
struct Compared {
  std::string body, material, integrator;
};

class SoftBodyMoves : public ::testing::TestWithParam<Compared> {};

TEST_P(SoftBodyMoves, WithTheBitsOfASimulation) {
  const auto& [generate, material, integrator] = GetParam();
  Json json = moving_box();
  json["body"] = {{"generate", Json::parse(generate)}};
  json["material"].merge_patch(Json::parse(material));
  json["integrator"] = integrator;
  const bool cut = !json["body"]["generate"].contains("chain");
  if (cut)
    json = with_events(json,
                       R"([{"at": 0.005, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0.25, 0]}}}])");
  const SceneFile scene = parse(json);
  Simulation simulation(scene);
  run(simulation);

  SoftBody body(make_problem(scene), integrator);
  std::size_t operations = 0;
  for (int n = 0; n < 10; ++n) {
    if (n == 5 && cut) operations = body.dissociate({0.125, 0, 0}, {1, 0.25, 0});
    body.step(scene.step);
  }
  EXPECT_EQ(body.body().state_hash(), simulation.body().state_hash());
  EXPECT_EQ(operations, simulation.operations());
  EXPECT_EQ(operations > 0, cut);
}

INSTANTIATE_TEST_SUITE_P(
    All, SoftBodyMoves,
    testing::Values(Compared{R"({"box": {"cells": [2, 2, 2], "spacing": 0.125}})", "{}", "rk4"},
                    Compared{R"({"box": {"cells": [2, 2, 2], "spacing": 0.125}})", "{}", "bdf2"},
                    Compared{R"({"box": {"cells": [2, 2, 2], "spacing": 0.125, "kind": "hexahedra"}})", "{}", "verlet"},
                    Compared{R"({"box": {"cells": [2, 2, 2], "spacing": 0.125}})",
                             R"({"stiffness": null, "damping": null, "young": 1000, "poisson": 0.25})",
                             "backward-euler"},
                    Compared{R"({"sheet": {"cells": [4, 4], "spacing": 0.125}})", "{}", "symplectic-euler"},
                    Compared{R"({"chain": {"links": 6, "spacing": 0.125}})", "{}", "rk4"}),
    [](const auto& param) { return "Number" + std::to_string(param.index); });

TEST(SoftBody, ReportsWhatEachOperationDoes) {
  Problem problem = box_problem();
  problem.fixed = {0, 2};
  SoftBody body(problem);
  EXPECT_EQ(body.dissociate({0.125, 0, 0}, {1, 0, 0}), 8u);  // two triangles for each of the squares across
  EXPECT_EQ(body.dissociate({0.125, 0, 0}, {1, 0, 0}), 0u);
  EXPECT_EQ(body.apply(Release{BoxSelection{{-1, -1, -1}, {1, 1, 1}}}), 2u);
  EXPECT_EQ(body.apply(Remove{IdSelection{{0, 3}}}), 2u);
  EXPECT_EQ(body.apply(Refine{.cells = IdSelection{{5}}, .at_centre = true, .bracing = 0.0}), 1u);
  EXPECT_EQ(body.body().counts().cells, 48u - 2u + 3u);
  EXPECT_EQ(body.body().counts().components, 2u);
  EXPECT_EQ(body.body().violation(), "");
}

TEST(SoftBody, RefusesWhatItsKindDoesNotAdmit) {
  Problem chain;
  chain.mesh.points = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  EXPECT_THROW(SoftBody(chain).dissociate({0.5, 0, 0}, {1, 0, 0}), InputError);
  EXPECT_THROW(SoftBody(box_problem(), "no such method"), InputError);
  SoftBody body(box_problem());
  EXPECT_THROW(body.apply(Remove{IdSelection{{48}}}), InputError);
  EXPECT_EQ(body.body().counts().cells, 48u);
}

TEST(SoftBody, ThrowsTheDiagnosisOfAStepThatFails) {
  SoftBody body(box_problem());
  EXPECT_THROW(for (int n = 0; n < 200; ++n) body.step(10.0), SolverError);
}

TEST(SoftBody, ForgetsEarlierStepsWhenItIsRestarted) {
  // a method of two steps: without a restart it would go on from the motion of before
  SoftBody fresh(box_problem(), "bdf2"), used(box_problem(), "bdf2");
  for (int n = 0; n < 3; ++n) used.step(0.001);
  std::ranges::copy(fresh.motion().x, used.motion().x.begin());
  std::ranges::copy(fresh.motion().v, used.motion().v.begin());
  used.restart();
  fresh.step(0.001);
  used.step(0.001);
  EXPECT_EQ(used.body().state_hash(), fresh.body().state_hash());
  EXPECT_EQ(used.time(), 0.001 + 0.001 + 0.001 + 0.001);
}

TEST(SoftBody, KeepsItsEnergyThroughADissociation) {
  SoftBody body(box_problem());
  for (int n = 0; n < 5; ++n) body.step(0.001);
  const auto energy = [&body] {
    return total_energy(body.system(), body.vertices().position, body.vertices().velocity);
  };
  const double before = energy();
  ASSERT_GT(body.dissociate({0.125, 0, 0}, {1, 0, 0}), 0u);
  EXPECT_NEAR(energy(), before, 1e-13 * before);  // sums of some 200 terms in another order
}

TEST(SoftBody, ShowsWhereItHasMovedWhatHoldsItAndItsStress) {
  Problem problem = box_problem();
  problem.fixed = {0};
  problem.initial_velocity[0].setZero();
  problem.held_axes = {{1, 1}};
  SoftBody body(problem);
  body.step(0.001);
  const Frame frame = body.frame({.held = true, .stress = true, .displacement = true});
  EXPECT_EQ(frame.time, 0.001);
  ASSERT_EQ(frame.held.size(), 27u);
  EXPECT_EQ(frame.held[0], 1);
  EXPECT_EQ(frame.held[1], 3);
  EXPECT_EQ(frame.held[2], 0);
  EXPECT_EQ(frame.von_mises_stress.size(), 27u);
  for (std::size_t k = 0; k < 27; ++k)
    EXPECT_EQ(frame.displacement[k], Eigen::Vector3d(frame.mesh.points[k] - problem.mesh.points[k])) << k;
}

class SoftBodyFile : public FolderTest {};

TEST_F(SoftBodyFile, HoldsItsFrame) {
  SoftBody body(box_problem());
  body.step(0.001);
  body.write(folder_ / "body.vtu");
  EXPECT_EQ(text("body.vtu"), to_vtu(body.frame()));
}

}  // namespace
}  // namespace dartboard::soft_body_test
