// Scenes whose bodies are attached to each other or to fixed places.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "core/scene/file/scene_problem.h"
#include "core/scene/forces/attached_points.h"
#include "core/scene/plan/scene_plan.h"
#include "core/scene/run/scene_verdict.h"
#include "core/time/watch/stable_step.h"
#include "tests/support/bodies/surveys_for_tests.h"
#include "tests/support/moving_box.h"
#include "tests/support/plan_memory.h"
#include "tests/support/run_in_memory.h"

namespace dartboard::attachments_scene_test {
namespace {

using namespace moving;
using Eigen::Vector3d;

Json with(Json scene, const char* key, const char* value) {
  scene[key] = Json::parse(value);
  return scene;
}

/// Two boxes whose meshes do not match, the upper one attached to the top of the lower one, which turns and is
/// stretched; the upper one rests.
Json two_boxes() {
  return Json::parse(R"({
    "name": "boxes", "step": 0.001, "duration": 0.02, "gravity": [0, 0, 0],
    "bodies": [
      {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.125, "pattern": "kuhn"}},
       "initial_velocity": {"linear": [[1, -2, 0], [2, 0.5, 0], [0, 0, -1]], "centre": [0.125, 0.125, 0.125]}},
      {"generate": {"box": {"cells": [2, 1, 1], "spacing": 0.1, "kind": "hexahedra"}}, "translate": [0.02, 0.07, 0.25]}],
    "material": {"density": 768, "stiffness": 64, "damping": 0.25, "viscosity": 0},
    "attachments": [{"box": {"min": [0, 0, 0.25], "max": [1, 1, 0.25]}, "to": 0, "stiffness": 500}]})");
}
/// A box of tetrahedra that hangs by its top.
Json hung_box() {
  Json scene = moving_box();
  scene["attachments"] = Json::parse(R"([{"plane": {"point": [0, 0, 0.25], "normal": [0, 0, 1]}, "stiffness": 500}])");
  return scene;
}
TEST(SceneAttachments, HaveNoForceAtRestAndShareTheirStiffnessByMass) {
  for (const bool on_map : {false, true}) {
    Json json = two_boxes();
    if (on_map)
      json["events"] = Json::parse(R"([{"at": 0.01, "remove": {"box": {"min": [9, 9, 9], "max": [9, 9, 9]}}}])");
    const Simulation simulation(parse(json));
    const SpringSystem system = simulation.body().system();
    const auto& x = simulation.body().vertices().position;
    ASSERT_EQ(system.terms.size(), 1u);
    const ForceTerm& term = *system.terms[0];
    ASSERT_EQ(term.size(), 6u);  // the lower face of the upper box; corners of the lower box are not held
    std::vector<Vector3d> force(x.size(), Vector3d(0, 0, 0));
    term.add_forces({x}, force);
    for (const Vector3d& f : force) EXPECT_LT(f.norm(), 1e-12);
    double stiffness = 0.0, mass = 0.0, first_mass = 0.0, first_stiffness = 0.0;
    std::size_t piece = 0;
    term.for_each_constant_tangent([&](ForceTerm::Nodes n, std::span<const Eigen::Matrix3d> blocks) {
      ASSERT_EQ(n.size(), 5u);
      EXPECT_GE(x[n[0]].z(), 0.25);
      stiffness += blocks[0](0, 0);
      mass += system.mass[n[0]];
      if (piece++ == 0) {
        first_mass = system.mass[n[0]];
        first_stiffness = blocks[0](0, 0);
      }
      double sum = 0.0;  // of the weights: a shift of all vertices does nothing
      for (std::size_t a = 1; a < 5; ++a) sum += blocks[a * (a + 1) / 2](0, 0);
      EXPECT_NEAR(sum, -blocks[0](0, 0), 1e-12 * blocks[0](0, 0));
    });
    EXPECT_NEAR(stiffness, 500.0, 1e-10);
    EXPECT_NEAR(first_stiffness / stiffness, first_mass / mass, 1e-14);
  }
}

// Of hundreds of cells; where several have a vertex on their sides, the first.
TEST(SceneAttachments, AreToTheFirstCellThatAVertexIsIn) {
  Json json = two_boxes();
  json["bodies"][1] = Json::parse(R"({"generate": {"box": {"cells": [3, 3, 3], "spacing": 0.09}},
                                      "translate": [0.11, 0.1, 0.12]})");
  json["attachments"][0].erase("box");
  json["attachments"][0]["plane"] = Json::parse(R"({"point": [0, 0, 0], "normal": [0, 0, 1]})");
  for (const char* box : {R"({"cells": [5, 5, 5], "spacing": 0.1, "jitter": 0.3, "seed": 4})",
                          R"({"cells": [5, 5, 5], "spacing": 0.1, "kind": "mixed"})",
                          R"({"cells": [5, 5, 5], "spacing": 0.1, "kind": "hexahedra"})"}) {
    json["bodies"][0]["generate"]["box"] = Json::parse(box);
    const SceneFile scene = parse(json);
    const Problem problem = make_problem(scene);
    const Mesh& mesh = problem.mesh;
    const std::vector<AttachedPoints> found = find_attachments(scene, problem);
    ASSERT_EQ(found.at(0).points.size(), 64u);
    for (const Attachment& one : found[0].points) {
      const Vector3d& x = mesh.points[one.point];
      Vector3d mean(0, 0, 0);
      for (std::size_t a = 0; a < 4; ++a) {
        mean += one.weight[a] * mesh.points[one.corners[a]];
        EXPECT_GE(one.weight[a], -1e-8) << box;
      }
      EXPECT_LT((mean - x).norm(), 1e-15);
      for (std::uint32_t c = 0; c < one.cell; ++c) {
        if (mesh.kinds[c] != CellKind::tetrahedron) continue;
        const auto n = mesh.cell(c);
        Eigen::Matrix3d sides;
        for (int k = 0; k < 3; ++k) sides.col(k) = mesh.points[n[static_cast<std::size_t>(k) + 1]] - mesh.points[n[0]];
        const Vector3d w = sides.inverse() * (x - mesh.points[n[0]]);
        EXPECT_LT(std::min(w.minCoeff(), 1.0 - w.sum()), -1e-9) << box << c;
      }
    }
  }
}

// The small box hovers over corners and edges of cells of the large one: several are equally near, but for rounding.
TEST(SceneAttachments, AreToTheSameCellsOfBodiesThatAreTurned) {
  const auto cells_of = [](double degrees) {
    Json json = two_boxes();
    json["bodies"][0]["generate"]["box"] = {{"cells", {2, 2, 2}}, {"spacing", 0.1}};
    json["bodies"][1]["generate"]["box"] = {{"cells", {2, 2, 1}}, {"spacing", 0.05}};
    const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180.0, Vector3d(1, 1, 1).normalized());
    for (Json& body : json["bodies"]) body["rotate"] = {{"axis", {1, 1, 1}}, {"degrees", degrees}};
    const Vector3d at = turn * Vector3d(0.05, 0.05, 0.22);
    json["bodies"][0]["translate"] = {0, 0, 0};
    json["bodies"][1]["translate"] = {at.x(), at.y(), at.z()};
    json["attachments"] =
        Json::array({{{"sphere", {{"centre", {0, 0, 0}}, {"radius", 9}}}, {"to", 0}, {"stiffness", 100}}});
    const SceneFile scene = parse(json);
    std::vector<std::uint32_t> cells;
    const std::vector<AttachedPoints> found = find_attachments(scene, make_problem(scene));
    for (const Attachment& one : found.at(0).points) cells.push_back(one.cell);
    return cells;
  };
  const std::vector<std::uint32_t> expected = cells_of(0.0);
  ASSERT_EQ(expected.size(), 18u);
  for (const double degrees : {17.0, 120.0, 240.0}) EXPECT_EQ(cells_of(degrees), expected) << degrees;
}

// The nearest points of two cells are 1e-8 of the size apart, more than the thickness of borders of the ball alone.
TEST(SceneAttachments, AreToTheSameCellsBesideABodyFarAway) {
  const auto corners_of = [](bool has_far_body) {
    Json json = two_boxes();
    json["bodies"] = Json::parse(R"([
      {"generate": {"ball": {"layers": 2, "radius": 1.7171}}, "scale": 1.10388, "translate": [1.89546, 0, 1.89546],
       "rotate": {"axis": [1, 0, 0], "degrees": 94}},
      {"generate": {"box": {"cells": [1, 1, 1], "spacing": 0.97}}, "scale": 1.30162, "translate": [3.82883, 0.063, 0],
       "rotate": {"axis": [1, 0, 0], "degrees": -26.9}}])");
    if (has_far_body)
      json["bodies"].push_back(
          {{"generate", {{"box", {{"cells", {1, 1, 1}}, {"spacing", 0.5}}}}}, {"translate", {-150, 0, 0}}});
    json["attachments"] =
        Json::parse(R"([{"box": {"min": [0, 0, 0.09], "max": [6, 0.9, 3]}, "to": 0, "stiffness": 1e6}])");
    const SceneFile scene = parse(json);
    std::vector<std::array<std::uint32_t, 4>> corners;
    const std::vector<AttachedPoints> found = find_attachments(scene, make_problem(scene));
    for (const Attachment& one : found.at(0).points) corners.push_back(one.corners);
    return corners;
  };
  const auto expected = corners_of(false);
  ASSERT_EQ(expected.size(), 2u);
  EXPECT_EQ(corners_of(true), expected);
}

// Where a vertex is in no cell, it is not farther away from one than the longest edge.
TEST(SceneAttachments, AreToTheNearestCellOfTheBody) {
  Json json = two_boxes();
  json["bodies"][1]["translate"] = {0.02, 0.07, 0.31};
  json["attachments"][0]["box"]["max"] = {1, 1, 0.35};
  const SceneFile scene = parse(json);
  const Problem problem = make_problem(scene);
  const std::vector<AttachedPoints> found = find_attachments(scene, problem);
  ASSERT_EQ(found.size(), 1u);
  ASSERT_EQ(found[0].points.size(), 6u);
  for (const Attachment& one : found[0].points) {
    const Vector3d& x = problem.mesh.points[one.point];
    ASSERT_EQ(one.count, 4u);
    Vector3d mean(0, 0, 0), low = problem.mesh.points[one.corners[0]], high = low;
    double negative = 0.0;
    for (std::size_t a = 0; a < 4; ++a) {
      const Vector3d& corner = problem.mesh.points[one.corners[a]];
      mean += one.weight[a] * corner;
      low = low.cwiseMin(corner);
      high = high.cwiseMax(corner);
      negative = std::min(negative, one.weight[a]);
      EXPECT_NE(std::ranges::find(problem.mesh.cell(one.cell), one.corners[a]), problem.mesh.cell(one.cell).end());
    }
    EXPECT_LT((mean - x).norm(), 1e-15);
    EXPECT_LT(negative, 0.0);
    // straight below or next to it where the lower box is narrower
    EXPECT_EQ(high.z(), 0.25);
    const double away = std::max(0.0, x.x() - 0.25);
    EXPECT_LE(low.x() - 1e-12, x.x());
    EXPECT_GE(high.x() + away + 1e-12, x.x());
  }
  json["bodies"][1]["translate"] = {0.02, 0.07, 0.5};
  json["attachments"][0]["box"]["max"] = {1, 1, 0.5};
  EXPECT_EQ(
      refusal(json),
      "file: /attachments/0: vertex 27 is 0.25 m away from body 0, whose nearest cell has edges of up to 0.217 m; "
      "expected no vertex farther away than that");
}

TEST(SceneAttachments, OfASurfaceLieInItsPlane) {
  Json json = Json::parse(R"({"name": "sheets", "step": 0.001, "duration": 0.01,
    "bodies": [{"generate": {"sheet": {"cells": [3, 2], "spacing": 0.1, "kind": "quadrilaterals"}}},
               {"generate": {"sheet": {"cells": [2, 2], "spacing": 0.1}}, "rotate": {"axis": [1, 0, 0], "degrees": 90},
                "translate": [0.03, 0.13, 0]}],
    "attachments": [{"box": {"min": [0.01, 0.12, 0], "max": [1, 0.15, 0]}, "to": 0, "stiffness": 5}]})");
  const Simulation simulation(parse(json));
  const SpringSystem system = simulation.body().system();
  ASSERT_EQ(system.terms.back()->size(), 3u);
  EXPECT_EQ(system.terms.back()->nodes(0).size(), 4u);
  EXPECT_LT(system.terms.back()->energy(simulation.body().vertices().position), 1e-30);
  json["bodies"][1]["translate"] = {0.03, 0.13, 0.001};
  json["attachments"][0]["box"]["max"] = {1, 0.15, 0.01};
  EXPECT_EQ(
      refusal(json),
      "file: /attachments/0: vertex 12 is 0.001 m above the plane of the nearest face of body 0; expected vertices "
      "in that plane, so that there is no force at rest");
}

// Explicit methods to rounding, implicit ones to the tolerance of their solver.
TEST(SceneAttachments, KeepMomentumAndAngularMomentum) {
  for (const auto& [integrator, linear, angular] :
       {std::tuple{"rk4", 1e-14, 1e-6}, {"verlet", 1e-14, 1e-13}, {"implicit-midpoint", 1e-9, 1e-8}}) {
    Json json = two_boxes();
    json["integrator"] = integrator;
    json["material"]["damping"] = 0;
    Simulation simulation(parse(json));
    const Diagnostics first = simulation.diagnostics();
    run(simulation);
    const Diagnostics last = simulation.diagnostics();
    const SpringSystem system = simulation.body().system();
    ASSERT_GT(system.terms[0]->energy(simulation.body().vertices().position), 1e-3) << integrator;
    const double momentum = std::sqrt(2.0 * simulation.body().mass() * first.kinetic);
    EXPECT_LE((last.momentum - first.momentum).norm(), linear * momentum) << integrator;
    EXPECT_LE((last.angular_momentum - first.angular_momentum).norm(), angular * momentum) << integrator;
    EXPECT_NEAR(last.energy() / first.energy(), 1.0, 1e-2) << integrator;
  }
}

// The springs together bear the weight, however the body stretches: the mean of their stretches by mass.
TEST(SceneAttachments, LetABodyHangLowerByItsWeightOverTheirStiffness) {
  Json json = hung_box();
  json["gravity"] = {0, 0, -9.81};
  json["initial_velocity"] = {0, 0, 0};
  json["material"] = Json::parse(R"({"density": 768, "young": 2e4, "poisson": 0.3, "viscosity": 20})");
  json["integrator"] = "backward-euler";
  json["step"] = 0.05;
  json["duration"] = 10;
  json["attachments"][0]["stiffness"] = 2000;
  const SceneFile scene = parse(json);
  const Problem problem = make_problem(scene);
  Simulation simulation(scene);
  run(simulation);
  const VertexColumns& v = simulation.body().vertices();
  double moment = 0.0, mass = 0.0;
  for (std::size_t k = 0; k < v.size(); ++k)
    if (const Vector3d& rest = problem.mesh.points[v.point[k]]; rest.z() == 0.25) {
      moment += v.mass[k] * (rest - v.position[k]).z();
      mass += v.mass[k];
    }
  EXPECT_NEAR(moment / mass, simulation.body().mass() * 9.81 / 2000, 1e-8);
}

// Equal boxes at one place, every vertex of one attached to that of the other: both move as a whole, and the distance
// oscillates with the frequency of the stiffness and the reduced mass. Errors decrease with the order of the method.
TEST(SceneAttachments, LetTwoBodiesOscillateByTheirReducedMass) {
  Json json = Json::parse(R"({"name": "two", "step": 0.0078125, "duration": 0.5, "gravity": [0, 0, 0],
    "bodies": [{"generate": {"box": {"cells": [1, 1, 1], "spacing": 0.125}}, "material": {"density": 1000}},
               {"generate": {"box": {"cells": [1, 1, 1], "spacing": 0.125}}, "material": {"density": 3000},
                "initial_velocity": [1, 0, 0]}],
    "material": {"stiffness": 50, "damping": 0, "viscosity": 0},
    "attachments": [{"box": {"min": [-1, -1, -1], "max": [1, 1, 1]}, "to": 0, "stiffness": 200}]})");
  // all vertices at the places of body 0 are selected, and its own are not held
  const double one = 1000 * 0.125 * 0.125 * 0.125, other = 3 * one, omega = std::sqrt(200.0 * (1 / one + 1 / other));
  const double distance = std::sin(omega * 0.5) / omega, centre = 0.5 * other / (one + other);
  const auto error = [&](const char* integrator, double step) {
    json["integrator"] = integrator;
    json["step"] = step;
    Simulation simulation(parse(json));
    run(simulation);
    const VertexColumns& v = simulation.body().vertices();
    double worst = 0.0;
    const Problem problem = make_problem(parse(json));
    for (std::size_t k = 0; k < v.size(); ++k) {
      const bool heavy = v.point[k] >= 8;
      const double moved = centre + (heavy ? one : -other) / (one + other) * distance;
      worst = std::max(worst, std::abs(v.position[k].x() - problem.mesh.points[v.point[k]].x() - moved));
    }
    return worst;
  };
  for (const auto& [integrator, order] : {std::tuple{"verlet", 2.0}, {"rk4", 4.0}, {"implicit-midpoint", 2.0}}) {
    const double coarse = error(integrator, 1.0 / 64), fine = error(integrator, 1.0 / 128);
    EXPECT_LT(coarse, 0.02) << integrator;
    EXPECT_NEAR(std::log2(coarse / fine), order, 0.25) << integrator;
  }
}

// With all vertices held to their places, the square of every frequency grows by stiffness over mass.
TEST(SceneAttachments, LowerTheLongestStableStep) {
  Json json = hung_box();
  json["material"]["damping"] = 0;
  json["integrator"] = "verlet";
  json["attachments"][0]["plane"]["point"] = {0, 0, 0};
  Json free = json;
  free.erase("attachments");
  const auto omega_of = [](const Simulation& simulation) {
    return StableStepEstimate().refresh(simulation.body().system(), simulation.body().vertices().position);
  };
  const StableStep before = omega_of(Simulation(parse(free)));
  json["attachments"][0]["stiffness"] = 4 * before.upper * before.upper * Simulation(parse(free)).body().mass();
  const Simulation held(parse(json));
  const StableStep after = omega_of(held);
  EXPECT_LE(after.lower, std::sqrt(5.0) * before.upper);
  EXPECT_GE(after.upper, std::sqrt(5.0) * before.lower);
  // both bounds are within a few percent of the frequency
  EXPECT_NEAR(after.upper / before.upper, std::sqrt(5.0), 0.2);
  EXPECT_LT(held.step_limit().stable, 0.5 * Simulation(parse(free)).step_limit().stable);
  json["step"] = 1.05 * 2.0 / after.lower;
  json["duration"] = 0.1;
  EXPECT_TRUE(Simulation(parse(json)).step_warning());
}

// A vertex that comes apart, cells of a target that are removed, and numbers that change.
constexpr const char* events = R"([
  {"at": 0.002, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}},
  {"every": 0.003, "from": 0.001, "until": 0.018, "remove": {"random": {"count": 2, "seed": 5}}},
  {"at": 0.006, "remove": {"box": {"min": [0, 0, 0.2], "max": [0.1, 0.1, 0.25]}}}])";

TEST(SceneAttachments, GoOnWithTheSameBitsWhereARunIsInterrupted) {
  for (const char* integrator : {"verlet", "backward-euler"})
    for (const Json& json : {with(two_boxes(), "events", events), two_boxes(), with(hung_box(), "events", events)}) {
      Json scene = json;
      scene["integrator"] = integrator;
      scene["output"] = Json::parse(R"({"diagnostics_every": {"steps": 1}})");
      const SceneFile file = parse(scene);
      const recorded::RunInMemory one = recorded::whole(file);
      ASSERT_FALSE(one.result.divergence);
      for (std::uint64_t n = 1; n < one.simulation->step_count(); n += 4)
        recorded::expect_same(recorded::in_two(file, n), one);
    }
}

TEST(SceneAttachments, GoWithTheCellsThatTheyAreAttachedTo) {
  Json json = with(two_boxes(), "events", R"([
    {"at": 0.005, "remove": {"box": {"min": [0, 0, 0.13], "max": [0.3, 0.3, 0.25]}}}])");
  json["material"]["damping"] = 0;
  Simulation simulation(parse(json));
  const std::size_t before = simulation.body().system().terms[0]->size();
  run(simulation);
  EXPECT_EQ(before, 6u);
  EXPECT_EQ(simulation.body().system().terms[0]->size(), 0u);
}

TEST(SceneAttachments, MoveWithTheSameBitsOnAMap) {
  Json json = two_boxes();
  Simulation columns(parse(json));
  json["events"] = Json::parse(R"([{"at": 0.02, "remove": {"box": {"min": [9, 9, 9], "max": [9, 9, 9]}}}])");
  Simulation on_map(parse(json));
  run(columns);
  run(on_map);
  EXPECT_EQ(columns.body().state_hash(), on_map.body().state_hash());
}

TEST(SceneAttachments, ArePlannedToTheByte) {
  Json chain = Json::parse(R"({"name": "chain", "step": 0.001, "duration": 0.01,
    "body": {"generate": {"chain": {"links": 4, "spacing": 0.1}}}, "attachments": [{"ids": [0, 4], "stiffness": 10}]})");
  Json both = with(two_boxes(), "events", events);
  both["attachments"].push_back(Json::parse(R"({"sphere": {"centre": [0, 0, 0], "radius": 0.01}, "stiffness": 3})"));
  for (const Json& json : {chain, both, two_boxes(), hung_box(), with(hung_box(), "events", events)}) {
    const SceneFile file = parse(json);
    const Problem problem = make_problem(file);
    ScenePlan plan = plan_scene(file);
    EXPECT_TRUE(plan.unplanned.empty());
    const auto item = std::ranges::find(plan.items, Part::force, &PlanItem::part);
    ASSERT_NE(item, plan.items.end());
    EXPECT_EQ(item->bytes, memory::predicted_bytes(file, problem, plan, *item));
    if (json != both) continue;
    EXPECT_EQ(item->what, "springs without length: 6 vertices to body 0, 1 vertex to fixed places");
    EXPECT_EQ(item->why, "/attachments/0/stiffness: 500; /attachments/1/stiffness: 3");
  }
  const SceneFile without = parse(moving_box());
  for (const PlanItem& item : plan_scene(without).items) EXPECT_NE(item.part, Part::force);
}

// A mean over what is connected by cells, though springs pull at other parts.
TEST(SceneAttachments, DoNotConnectParts) {
  Json json = two_boxes();
  json["output"]["probes"] = Json::parse(R"([{"name": "upper", "near": [0.02, 0.07, 0.35]}])");
  json["duration"] = 0;
  json["expect"]["places"] =
      Json::parse(R"([{"probe": "upper", "position": [0.12, 0.12, 0.3], "within": 1e-12, "of": "part"}])");
  const SceneFile scene = parse(json);
  Simulation simulation(scene);
  EXPECT_EQ(simulation.body().counts().components, 2u);
  const auto rows = compare_with_expectation(scene, simulation, {});
  EXPECT_TRUE(std::ranges::all_of(rows, [](const ExpectedRow& row) { return row.holds; }));
}

// Vertices at one place, or apart by rounding, are not too close for their coordinates.
TEST(SceneAttachments, WarnOfNoCoordinates) {
  Json json = two_boxes();
  json["material"] = Json::parse(R"({"density": 768, "young": 2e4, "poisson": 0.3})");
  json["bodies"][1]["generate"]["box"] = Json::parse(R"({"cells": [2, 2, 2], "spacing": 0.125})");
  json["bodies"][1]["rotate"] = Json::parse(R"({"axis": [0, 0, 1], "degrees": 90})");
  json["bodies"][1]["translate"] = {0.25, 1e-15, 0.25};
  EXPECT_FALSE(survey_of(parse(json)).coarse_coordinate);
}

}  // namespace
}  // namespace dartboard::attachments_scene_test
