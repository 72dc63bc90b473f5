// Forces from outside: their size, the vertices they act on, their times, and the effect of a cut on them.

#include "core/scene/timeline/applied_forces.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/scene/file/scene_problem.h"
#include "core/scene/plan/scene_plan.h"
#include "core/time/integrators.h"
#include "core/time/system/energy.h"
#include "tests/support/moving_box.h"
#include "tests/support/run_in_memory.h"

namespace dartboard::applied_forces_test {
namespace {

using namespace moving;
using Eigen::Vector3d;

constexpr const char* side = R"({"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]}})";

// A box that floats at rest, and nothing that would change its momentum.
Json floating_box(const char* forces) {
  Json scene = moving_box();
  scene.erase("initial_velocity");
  scene["gravity"] = {0, 0, 0};
  scene["material"]["viscosity"] = 0;
  scene["forces"] = Json::parse(forces);
  return scene;
}
/// Applies to the vertices of one side of the box.
Json with_key(const char* key, const Json& value) {
  Json force = Json::parse(side);
  force[key] = value;
  return force;
}
Json pulled_box() {
  Json scene = floating_box("[]");
  scene["forces"] = Json::array({with_key("force", {3, -1, 2})});
  return scene;
}
const Vector3d pull_of_box(3, -1, 2);

/// The sum of all forces applied now [N].
Vector3d sum_of_forces(const Simulation& simulation) {
  const VertexColumns& v = simulation.body().vertices();
  Vector3d sum(0, 0, 0);
  for (std::size_t k = 0; k < v.pull.size(); ++k) sum += v.mass[k] * v.pull[k];
  return sum;
}

TEST(AppliedForces, GiveABodyTheirSumTimesTheTimeAsMomentumWithEveryIntegrator) {
  for (const IntegratorEntry& entry : integrators()) {
    Json scene = pulled_box();
    scene["integrator"] = entry.name;
    Simulation simulation(parse(scene));
    run(simulation);
    // inner forces have no sum; the residual of implicit methods has one, of 1e-12 of the forces in a step
    EXPECT_LE((simulation.diagnostics().momentum - 0.01 * pull_of_box).norm(), 1e-11 * 0.01 * pull_of_box.norm())
        << entry.name;
  }
}

TEST(AppliedForces, StretchEachLinkOfAChainByTheForceOverItsStiffness) {
  for (const char* integrator : {"rk4", "verlet", "backward-euler", "ros2", "baraff-witkin", "local-global"}) {
    Json scene = Json::parse(R"({"name": "chain", "step": 0.005, "duration": 4, "gravity": [0, 0, 0],
      "body": {"generate": {"chain": {"links": 6, "spacing": 0.25}}}, "fixed": [{"ids": [0]}],
      "material": {"density": 2, "stiffness": 1000, "damping": 0, "viscosity": 20},
      "forces": [{"ids": [6], "force": [5, 0, 0]}]})");
    scene["integrator"] = integrator;
    Simulation simulation(parse(scene));
    run(simulation);
    const auto& x = simulation.body().vertices().position;
    // as for the chain that hangs (chain_test.cpp): at rest after 4 s, to 4e-18; implicit methods stop at 1e-10 of a
    // step
    for (std::size_t i = 1; i <= 6; ++i) EXPECT_NEAR(x[i].x() - x[i - 1].x() - 0.25, 0.005, 1e-11) << integrator;
  }
}

TEST(AppliedForces, ActBetweenTheirTimesAndNotBeforeOrAfter) {
  Json scene = floating_box("[]");
  Json force = with_key("force", {3, -1, 2});
  force["from"] = 0.002;
  force["until"] = 0.006;
  scene["forces"] = Json::array({force});
  scene["integrator"] = "verlet";
  Simulation simulation(parse(scene));
  for (int n = 0; n <= 10; ++n) {
    const double acted = 0.001 * std::clamp(n - 2, 0, 4);
    EXPECT_LE((simulation.diagnostics().momentum - acted * pull_of_box).norm(), 1e-15) << n;
    EXPECT_EQ(sum_of_forces(simulation).norm() > 1.0, n >= 2 && n < 6) << n;
    if (n < 10) {
      ASSERT_FALSE(simulation.advance());
    }
  }
}

TEST(AppliedForces, AddUpWhereSeveralActOnAVertex) {
  Json scene = pulled_box();
  scene["forces"].push_back(Json::parse(R"({"ids": [26], "force": [1, 1, 1]})"));
  const Simulation simulation(parse(scene));
  EXPECT_LE((sum_of_forces(simulation) - Vector3d(4, 0, 3)).norm(), 1e-14);
}

TEST(AppliedForces, AreSharedInProportionToMasses) {
  const Simulation simulation(parse(pulled_box()));
  const VertexColumns& v = simulation.body().vertices();
  for (std::size_t k = 0; k < v.size(); ++k) {
    const bool selected = v.position[k].x() == 0.25;
    EXPECT_EQ(v.pull[k] != Vector3d(0, 0, 0), selected);
    if (selected) {
      EXPECT_EQ(v.pull[k], v.pull[26]);
    }
  }
}

// A cut through the middle of the side: its vertices come apart, and their masses sum to the old ones.
TEST(AppliedForces, KeepTheirSumWhenVerticesComeApart) {
  Json scene = pulled_box();
  scene["events"] =
      Json::parse(R"([{"at": 0.005, "dissociate": {"plane": {"point": [0, 0.125, 0], "normal": [0, 1, 0]}}}])");
  scene["integrator"] = "verlet";
  Simulation simulation(parse(scene));
  run(simulation);
  EXPECT_EQ(simulation.body().counts().vertices, 36u);
  EXPECT_LE((sum_of_forces(simulation) - pull_of_box).norm(), 1e-14);
  EXPECT_LE((simulation.diagnostics().momentum - 0.01 * pull_of_box).norm(), 1e-15);
}

TEST(AppliedForces, GoWithTheMatterThatIsRemoved) {
  Json scene = pulled_box();
  scene["events"] =
      Json::parse(R"([{"at": 0.005, "remove": {"box": {"min": [0.13, 0, 0], "max": [0.25, 0.12, 0.12]}}}])");
  Simulation simulation(parse(scene));
  const auto mass_of_side = [&simulation] {
    double mass = 0.0;
    const VertexColumns& v = simulation.body().vertices();
    for (std::size_t k = 0; k < v.size(); ++k)
      if (v.pull[k] != Vector3d(0, 0, 0)) mass += v.mass[k];
    return mass;
  };
  const double before = mass_of_side();
  run(simulation);
  const double after = mass_of_side();
  EXPECT_LT(after, 0.9 * before);
  EXPECT_LE((sum_of_forces(simulation) - after / before * pull_of_box).norm(), 1e-14);
}

TEST(AppliedForces, OfAPressureAreItsProductWithTheAreaAgainstTheNormal) {
  for (const char* kind : {"tetrahedra", "hexahedra", "mixed"}) {
    Json scene = floating_box("[]");
    scene["body"]["generate"]["box"]["kind"] = kind;
    scene["forces"] = Json::array({with_key("pressure", 64)});
    const Simulation simulation(parse(scene));
    EXPECT_LE((sum_of_forces(simulation) - Vector3d(-64 * 0.0625, 0, 0)).norm(), 1e-14) << kind;
  }
}

// A quarter of the side has the same force as a face of a cube: each corner has a quarter of it.
TEST(AppliedForces, OfAPressureAreSharedByTheCornersOfEachFace) {
  Json scene = floating_box("[]");
  scene["body"]["generate"]["box"]["kind"] = "hexahedra";
  scene["forces"] = Json::array({with_key("pressure", 64)});
  const Simulation simulation(parse(scene));
  const VertexColumns& v = simulation.body().vertices();
  for (std::size_t k = 0; k < v.size(); ++k) {
    const Vector3d& x = v.position[k];
    const auto faces = [](double place) { return place == 0.125 ? 2 : 1; };
    const double expected = x.x() == 0.25 ? -64.0 / 64 / 4 * faces(x.y()) * faces(x.z()) : 0.0;
    EXPECT_LE((v.mass[k] * v.pull[k] - Vector3d(expected, 0, 0)).norm(), 1e-15);
  }
}

TEST(AppliedForces, OfAPressureAllRoundHaveNoSumAndNoMoment) {
  Json scene = floating_box(R"([{"box": {"min": [-1, -1, -1], "max": [1, 1, 1]}, "pressure": 64}])");
  scene["body"]["generate"]["box"]["jitter"] = 0.2;
  scene["integrator"] = "verlet";
  Simulation simulation(parse(scene));
  EXPECT_LE(sum_of_forces(simulation).norm(), 1e-14);
  ASSERT_FALSE(simulation.advance());
  EXPECT_LE(simulation.diagnostics().angular_momentum.norm(), 1e-16);
  // inwards: a body under pressure from all sides shrinks
  const VertexColumns& v = simulation.body().vertices();
  double along = 0.0;
  for (std::size_t k = 0; k < v.size(); ++k) along += v.velocity[k].dot(v.position[k] - Vector3d::Constant(0.125));
  EXPECT_LT(along, -1e-3);
}

TEST(AppliedForces, OfAPressureOnASurfaceAreAgainstTheNormalOfItsFaces) {
  Json scene = floating_box(R"([{"box": {"min": [-9, -9, -9], "max": [9, 9, 9]}, "pressure": 32}])");
  scene["body"] = Json::parse(R"({"generate": {"sheet": {"cells": [2, 3], "spacing": 0.5}}})");
  const Simulation simulation(parse(scene));
  EXPECT_LE((sum_of_forces(simulation) - Vector3d(0, 0, -32 * 1.5)).norm(), 1e-13);
}

// The same tetrahedron, its corners named the right-handed way and the other.
TEST(AppliedForces, OfAPressurePointInwardsHoweverTheCornersOfACellAreNamed) {
  for (const std::vector<std::uint32_t>& nodes : {std::vector<std::uint32_t>{0, 1, 2, 3}, {0, 2, 1, 3}}) {
    Mesh mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    mesh.add_cell(CellKind::tetrahedron, nodes);
    VertexColumns vertices;
    vertices.mass.assign(4, 2.0);
    vertices.point = {0, 1, 2, 3};
    SceneFile scene;
    scene.forces.push_back({IdSelection{{0, 1, 2}}, {}, 12.0, 0.0, {}, "/forces/0"});  // the face at z = 0
    AppliedForces forces(scene, mesh, vertices);
    std::vector<Vector3d> pull(4, Vector3d(0, 0, 0));
    ASSERT_EQ(forces.apply(0.0, 1.0, vertices.point, pull), LoadChange::begins_or_ends);
    // 12 Pa on half a square metre, a third at each corner, over 2 kg
    EXPECT_EQ(pull, (std::vector<Vector3d>{{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 0}}));
    EXPECT_EQ(forces.apply(1.0, 2.0, vertices.point, pull), LoadChange::none);
  }
}

// A mass of 1 kg on a spring: its kinetic energy is the work of the force.
TEST(AppliedForces, HaveAPotentialThatEnergyComesFrom) {
  Json scene = Json::parse(R"({"name": "mass", "step": 0.01, "duration": 1, "gravity": [0, 0, 0],
    "body": {"generate": {"chain": {"links": 1, "spacing": 1}}}, "fixed": [{"ids": [0]}],
    "material": {"density": 2, "stiffness": 8, "damping": 0, "viscosity": 0},
    "forces": [{"ids": [1], "force": [2, 0, 0]}], "integrator": "energy-momentum"})");
  Simulation simulation(parse(scene));
  const Diagnostics first = simulation.diagnostics();
  ASSERT_TRUE(first.applied);
  EXPECT_EQ(*first.applied, -2.0);
  run(simulation);
  const Diagnostics last = simulation.diagnostics();
  const double x = simulation.body().vertices().position[1].x();
  EXPECT_EQ(*last.applied, -2.0 * x);
  EXPECT_GT(last.kinetic + last.elastic, 0.1);
  EXPECT_NEAR(last.energy(), first.energy(), 1e-12);
  // a quarter of a metre to and fro about its new place, at 2 sqrt(2) / s
  EXPECT_NEAR(x, 1.25 - 0.25 * std::cos(std::sqrt(8.0)), 1e-4);
}

// The work of one that begins and ends meanwhile stays in the account.
TEST(AppliedForces, LeaveTheEnergyTheyGaveInTheAccountWhenTheyEnd) {
  Json scene = Json::parse(R"({"name": "mass", "step": 0.01, "duration": 1, "gravity": [0, 0, 0],
    "body": {"generate": {"chain": {"links": 1, "spacing": 1}}}, "fixed": [{"ids": [0]}],
    "material": {"density": 2, "stiffness": 8, "damping": 0, "viscosity": 0}, "integrator": "energy-momentum"})");
  for (const char* when : {R"({"from": 0.2, "until": 0.5})", R"({"until": 0.5})", R"({"from": 0.205})"}) {
    Json force = Json::parse(R"({"ids": [1], "force": [2, 0, 0]})");
    force.update(Json::parse(when));
    scene["forces"] = Json::array({force});
    Simulation simulation(parse(scene));
    const double first = simulation.diagnostics().energy();
    run(simulation);
    const Diagnostics last = simulation.diagnostics();
    EXPECT_GT(last.kinetic + last.elastic, 0.05) << when;
    EXPECT_NEAR(last.energy(), first, 1e-12) << when;
  }
}

TEST(AppliedForces, AreNotToldWhereASceneHasNone) {
  EXPECT_FALSE(Simulation(parse(moving_box())).diagnostics().applied);
  EXPECT_TRUE(Simulation(parse(moving_box())).body().vertices().pull.empty());
}

// From rest to thousands of times any earlier energy: this is no divergence.
TEST(AppliedForces, AreNoDivergenceHoweverMuchWorkTheyDo) {
  for (const char* integrator : {"rk4", "backward-euler"}) {
    Json scene = floating_box("[]");
    scene["forces"] = {with_key("pressure", -64), Json::parse(R"({"box": {"min": [-1, -1, -1], "max": [1, 1, 1]},
                                                                  "force": [1e5, 0, 0]})")};
    scene["integrator"] = integrator;
    scene["duration"] = 0.5;
    Simulation simulation(parse(scene));
    run(simulation);
    EXPECT_GT(simulation.diagnostics().kinetic, 1e7) << integrator;
  }
}

// With a method of two steps, which begins anew whenever a force changes: not where a run is continued.
TEST(AppliedForces, GoOnWithTheSameBitsWhereARunIsInterrupted) {
  Json scene = pulled_box();
  scene["forces"].push_back(Json::parse(R"({"ids": [0, 1], "force": [0, 9, 0], "from": 0.003, "until": 0.007})"));
  scene["events"] =
      Json::parse(R"([{"at": 0.005, "dissociate": {"plane": {"point": [0, 0.125, 0], "normal": [0, 1, 0]}}}])");
  scene["integrator"] = "bdf2";
  scene["output"] = Json::parse(R"({"diagnostics_every": {"steps": 1}})");
  const SceneFile file = parse(scene);
  const recorded::RunInMemory one = recorded::whole(file);
  for (std::uint64_t n = 1; n < 10; ++n) recorded::expect_same(recorded::in_two(file, n), one);
}

TEST(AppliedForces, ArePlannedToTheByteAndLeftOutWhereNoKeyAsksForThem) {
  Json scene = pulled_box();
  scene["forces"].push_back(with_key("pressure", 5));
  const auto plan_of = [](const Json& json) {
    const SceneFile file = parse(json);
    ScenePlan plan = plan_scene(file);
    return plan;
  };
  const ScenePlan with = plan_of(scene), without = plan_of(moving_box());
  const auto item = std::ranges::find(with.items, Part::pull, &PlanItem::part);
  ASSERT_NE(item, with.items.end());
  // 27 vertices, and two forces on 9 points: one pull for all, and one each
  EXPECT_EQ(item->bytes, 27 * 24 + 9 * 4 + 24 + 9 * 4 + 9 * 24);
  EXPECT_EQ(item->why, "/forces: 2");
  EXPECT_TRUE(std::ranges::none_of(without.items, [](const PlanItem& i) { return i.part == Part::pull; }));
  EXPECT_TRUE(std::ranges::any_of(without.left_out, [](const LeftOut& l) { return l.why == "/forces: not given"; }));
}

}  // namespace
}  // namespace dartboard::applied_forces_test
