// A body for programs moves as a simulation of the same scene does, and reports what operations do to it.

#include "core/scene/soft_body.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/forces/piece_term.h"
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

TEST(SoftBody, RefusesStepsThatAreNotAboveZero) {
  SoftBody body(box_problem(), "verlet");
  for (const double h : {0.0, -1e-3, std::nan(""), std::numeric_limits<double>::infinity()})
    EXPECT_THROW(body.step(h), InputError) << h;
  EXPECT_EQ(body.time(), 0.0);
}

TEST(SoftBody, RefusesAPoissonsRatioForSprings) {
  Problem problem = box_problem();
  problem.material.poisson = 0.3;
  EXPECT_THROW(SoftBody(problem, "verlet"), InputError);
  problem.material.model = Model::neo_hookean;
  problem.material.young = 1e4;
  SoftBody(problem, "verlet").step(1e-5);
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
  chain.mesh.links = {{0, 1}, {1, 2}};
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
  EXPECT_EQ(frame.stress.size(), 27u);
  for (std::size_t k = 0; k < 27; ++k)
    EXPECT_EQ(frame.displacement[k], Eigen::Vector3d(frame.mesh.points[k] - problem.mesh.points[k])) << k;
}

/// Linear springs from vertices to where they are at the start, as stiff as their masses are large.
struct Tethers {
  std::vector<std::uint32_t> vertex;
  std::vector<Eigen::Vector3d> place;
  std::vector<double> k;

  static constexpr bool is_internal = false;
  std::string_view name() const { return "tethers"; }
  std::size_t size() const { return vertex.size(); }
  ForceTerm::Nodes nodes(std::size_t piece) const { return {&vertex[piece], 1}; }
  double energy(std::size_t piece, std::span<const Eigen::Vector3d> x) const {
    return 0.5 * k[piece] * (x[0] - place[piece]).squaredNorm();
  }
  void add_forces(std::size_t piece, std::span<const Eigen::Vector3d> x, std::span<Eigen::Vector3d> force) const {
    force[0] -= k[piece] * (x[0] - place[piece]);
  }
  void add_tangent(std::size_t piece, std::span<const Eigen::Vector3d>, std::span<Eigen::Matrix3d> blocks) const {
    blocks[0] += k[piece] * Eigen::Matrix3d::Identity();
  }
  double stiffness(std::size_t piece) const { return k[piece]; }
};
Tethers tethers_of(const VertexColumns& v, double omega) {
  Tethers tethers;
  for (std::uint32_t k = 0; k < v.size(); ++k) {
    tethers.vertex.push_back(k);
    tethers.place.push_back(v.position[k]);
    tethers.k.push_back(omega * omega * v.mass[k]);
  }
  return tethers;
}

class SoftBodyOnTethers : public ::testing::TestWithParam<const char*> {};

TEST_P(SoftBodyOnTethers, SwingsAsAWhole) {
  // all vertices with one frequency: no spring of the body is ever stretched
  Problem problem = box_problem();
  problem.material.damping = problem.material.viscosity = 0.0;
  problem.surroundings.gravity.setZero();
  for (Eigen::Vector3d& v : problem.initial_velocity) v = {0.25, 0, 0};
  SoftBody body(problem, GetParam());
  const Eigen::Vector3d start = body.vertices().position[5];
  const double omega = 2.0;
  body.add(std::make_unique<PieceTerm<Tethers>>(tethers_of(body.vertices(), omega)));
  const auto energy = [&] { return total_energy(body.system(), body.vertices().position, body.vertices().velocity); };
  const double before = energy();
  for (int n = 0; n < 100; ++n) body.step(0.01);
  // of order 2 at least: an error of (omega h)^2 / 12 of the phase, and less than twice that of the place
  const Eigen::Vector3d moved = body.vertices().position[5] - start;
  EXPECT_NEAR(moved.x(), 0.25 / omega * std::sin(omega * 1.0), 0.25 / omega * 4e-4 / 6);
  EXPECT_NEAR(moved.y(), 0.0, 1e-14);
  EXPECT_NEAR(energy(), before, 4e-4 * before);
}
INSTANTIATE_TEST_SUITE_P(Methods, SoftBodyOnTethers,
                         testing::Values("verlet", "rk4", "implicit-midpoint", "energy-momentum"),
                         [](const auto& param) { return "Number" + std::to_string(param.index); });

TEST(SoftBody, LetsAnAddedForceFollowEachOperation) {
  SoftBody body(box_problem());
  std::size_t calls = 0, vertices = 0;
  auto tethers = std::make_unique<PieceTerm<Tethers>>(tethers_of(body.vertices(), 1.0));
  PieceTerm<Tethers>& term = *tethers;
  body.add(std::move(tethers), [&](const VertexColumns& v) {
    ++calls;
    vertices = v.size();
    term.pieces() = tethers_of(v, 1.0);
  });
  ASSERT_EQ(body.dissociate({0.125, 0, 0}, {1, 0, 0}), 8u);
  EXPECT_EQ(calls, 1u);
  EXPECT_EQ(vertices, 27u + 9u);
  EXPECT_EQ(body.system().terms.back()->size(), 27u + 9u);
  EXPECT_EQ(body.dissociate({0.125, 0, 0}, {1, 0, 0}), 0u);
  EXPECT_EQ(calls, 1u);
  EXPECT_NO_THROW(body.step(0.001));
}

TEST(SoftBody, FindsTheVertexOfAPointUntilItIsRemoved) {
  SoftBody body(box_problem());
  for (std::uint32_t p = 0; p < 27; ++p) EXPECT_EQ(body.vertices().point[body.vertex_of(p).value()], p);
  EXPECT_EQ(body.vertex_of(27), std::nullopt);
  ASSERT_EQ(body.apply(Remove{BoxSelection{{-1, -1, -1}, {0.125, 1, 1}}}), 24u);
  EXPECT_EQ(body.vertex_of(0), std::nullopt);
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
