// Scenes of solids, surfaces and chains side by side.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "core/scene/file/scene_problem.h"
#include "core/scene/plan/scene_plan.h"
#include "core/time/system/energy.h"
#include "tests/support/bodies/surveys_for_tests.h"
#include "tests/support/moving_box.h"
#include "tests/support/run_in_memory.h"

namespace dartboard::bodies_of_dimensions_test {
namespace {

using namespace moving;
using Eigen::Vector3d;

/// A box of tetrahedra with damped elements, a sheet of membranes and a chain, all moving; the chain first, so that no
/// body has the numbers that it has alone.
Json three_bodies() {
  return Json::parse(R"({
    "name": "three", "step": 0.0005, "duration": 0.01,
    "bodies": [
      {"generate": {"chain": {"links": 5, "spacing": 0.1}}, "translate": [0, 2, 0],
       "initial_velocity": {"linear": [[1, 0, 0], [0, 0, 3], [2, 1, 0]]},
       "material": {"density": 0.5, "stiffness": 400, "damping": 0.1}},
      {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.125, "pattern": "kuhn"}},
       "initial_velocity": {"linear": [[1, -2, 0], [2, 0.5, 0], [0, 0, -1]], "centre": [0.125, 0.125, 0.125]},
       "material": {"density": 768, "young": 2e4, "poisson": 0.3, "damping": {"ratio": 0.05, "frequency": 2}}},
      {"generate": {"sheet": {"cells": [3, 3], "spacing": 0.1}}, "translate": [2, 0, 0],
       "initial_velocity": {"linear": [[1, 0, 0], [0, 2, 0], [1, -2, 0]]},
       "material": {"density": 0.2, "young": 60, "poisson": 0.3}}],
    "material": {"viscosity": 0.5}})");
}
/// The body of that number alone in the scene.
Json alone(Json scene, std::size_t body) {
  Json one = scene["bodies"][body];
  scene.erase("bodies");
  for (const char* key : {"material", "initial_velocity"}) {
    scene[key] = one[key];
    one.erase(key);
  }
  scene["material"]["viscosity"] = 0.5;
  scene["body"] = one;
  return scene;
}
constexpr std::size_t first_point[] = {0, 6, 33, 49};

/// The places of the vertices at a point of the mesh.
std::vector<Vector3d> places(const Simulation& simulation, std::size_t point) {
  const auto& v = simulation.body().vertices();
  std::vector<Vector3d> found;
  for (std::size_t k = 0; k < v.size(); ++k)
    if (v.point[k] == point) found.push_back(v.position[k]);
  return found;
}

/// Runs both and compares every point with that of the body alone, bit for bit.
void expect_each_as_alone(const Json& scene, const std::function<Json(std::size_t)>& alone_of) {
  Simulation together(parse(scene));
  run(together);
  for (std::size_t b = 0; b < 3; ++b) {
    Simulation one(parse(alone_of(b)));
    run(one);
    for (std::size_t p = first_point[b]; p < first_point[b + 1]; ++p)
      EXPECT_EQ(places(together, p), places(one, p - first_point[b])) << "body " << b << ", point " << p;
  }
}

TEST(BodiesOfDimensions, MoveAsEachWouldAloneToTheLastBit) {
  for (const char* integrator : {"rk4", "verlet", "symplectic-euler"}) {
    Json scene = three_bodies();
    scene["integrator"] = integrator;
    expect_each_as_alone(scene, [&](std::size_t b) { return alone(scene, b); });
  }
}

// One matrix for all of them has another order of elimination, and one tolerance.
TEST(BodiesOfDimensions, MoveAsEachWouldAloneUnderAnImplicitIntegrator) {
  Json scene = three_bodies();
  scene["integrator"] = "implicit-midpoint";
  Simulation together(parse(scene));
  run(together);
  for (std::size_t b = 0; b < 3; ++b) {
    Simulation one(parse(alone(scene, b)));
    run(one);
    for (std::size_t p = first_point[b]; p < first_point[b + 1]; ++p)
      EXPECT_LT((places(together, p).at(0) - places(one, p - first_point[b]).at(0)).norm(), 1e-11)
          << "body " << b << ", point " << p;
  }
}

TEST(BodiesOfDimensions, AreDrivenPulledHeldAndPressedLikeOneAlone) {
  Json scene = three_bodies();
  scene["fixed"] =
      Json::parse(R"([{"box": {"min": [0, 0, 0], "max": [1, 1, 0]}}, {"box": {"min": [0, 2, 0], "max": [0, 2, 0]}},
                                   {"box": {"min": [2, 0, 0], "max": [2, 1, 0]}, "axes": ["z"]}])");
  scene["driven"] = Json::parse(R"([{"box": {"min": [0.5, 2, 0], "max": [0.5, 2, 0]}, "velocity": [0, 0, 1]}])");
  scene["forces"] = Json::parse(R"([
    {"plane": {"point": [0, 0, 0.25], "normal": [0, 0, 1]}, "pressure": 500, "normals": "current"},
    {"plane": {"point": [2, 0, 0], "normal": [1, 0, 0]}, "pressure": 3, "normals": "current"},
    {"plane": {"point": [0.1, 0, 0], "normal": [1, 0, 0]}, "acceleration": [0, 3, 0]}])");
  const auto only = [&](const char* key, std::size_t body) {
    // those of the keys that select vertices of this body
    const std::vector<std::vector<std::size_t>> of =
        std::string(key) == "fixed"    ? std::vector<std::vector<std::size_t>>{{1}, {0}, {2}}
        : std::string(key) == "driven" ? std::vector<std::vector<std::size_t>>{{0}}
                                       : std::vector<std::vector<std::size_t>>{{1}, {2}, {0, 1, 2}};
    Json list = Json::array();
    for (std::size_t k = 0; k < of.size(); ++k)
      if (std::ranges::find(of[k], body) != of[k].end()) list.push_back(scene[key][k]);
    return list;
  };
  expect_each_as_alone(scene, [&](std::size_t b) {
    Json one = alone(scene, b);
    for (const char* key : {"fixed", "driven", "forces"}) one[key] = only(key, b);
    return one;
  });
}

TEST(BodiesOfDimensions, AreCutAndErodedLikeOneAlone) {
  Json scene = three_bodies();
  const Json cut =
      Json::parse(R"({"at": 0.002, "dissociate": {"plane": {"point": [0, 0.13, 0], "normal": [0, 1, 0]}}})");
  const Json hole = Json::parse(R"({"at": 0.004, "remove": {"box": {"min": [2, 0.2, -1], "max": [2.2, 0.4, 1]}}})");
  const Json corner = Json::parse(R"({"at": 0.005, "remove": {"ids": [3, 50]}})");
  scene["events"] = Json::array({cut, hole, corner});
  expect_each_as_alone(scene, [&](std::size_t b) {
    Json one = alone(scene, b);
    if (b == 0) {
      one.erase("events");
    } else {
      one["events"][2]["remove"]["ids"] = Json::array({b == 1 ? 3 : 2});
    }
    return one;
  });
  Simulation together(parse(scene));
  run(together);
  EXPECT_EQ(together.body().violation(), "");
  EXPECT_EQ(together.body().map_name(), "tetrahedral 3-g-map and 2-g-map");
  EXPECT_GT(together.body().removed_mass(), 0.0);
  EXPECT_EQ(together.body().counts().cells, 48u + 18u - 2u - 4u);
}

TEST(BodiesOfDimensions, FallOnObstaclesLikeOneAlone) {
  Json scene = three_bodies();
  scene["bodies"][0]["material"]["width"] = 0.01;
  for (const std::size_t b : {0u, 1u, 2u}) {
    scene["bodies"][b]["translate"] = {b == 2 ? 2.0 : 0.0, b == 0 ? 2.0 : 0.0, 0.0005};
    scene["bodies"][b]["initial_velocity"] = {0, 0.2, -0.1};
  }
  scene["contact"] = Json::parse(R"({"pressure": 2e4, "depth": 0.002, "friction": 0.4, "restitution": 0.5,
    "obstacles": [{"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}]})");
  for (const bool on_map : {false, true}) {
    if (on_map)
      scene["events"] =
          Json::parse(R"([{"at": 0.002, "dissociate": {"plane": {"point": [0, 0.13, 0], "normal": [0, 1, 0]}}}])");
    Simulation together(parse(scene));
    run(together);
    std::size_t contacts = 0;
    for (const std::size_t b : {0u, 1u, 2u}) {
      Json own = alone(scene, b);
      if (b == 0) own.erase("events");
      Simulation one(parse(own));
      run(one);
      EXPECT_TRUE(b > 0 || one.diagnostics().contact->contacts > 0u);
      contacts += one.diagnostics().contact->contacts;
      for (std::size_t p = first_point[b]; p < first_point[b + 1]; ++p) {
        const auto found = places(together, p), expected = places(one, p - first_point[b]);
        ASSERT_EQ(found.size(), expected.size());
        // friction is swept over all contacts until none changes much: a chain at rest along x has rounding there
        for (std::size_t k = 0; k < found.size(); ++k)
          EXPECT_LT((found[k] - expected[k]).norm(), b == 0 ? 1e-21 : 0x1p-1074) << "body " << b << ", point " << p;
      }
    }
    EXPECT_EQ(together.diagnostics().contact->contacts, contacts);
  }
}

/// A chain between two boxes, which hold it by springs; the second box is another one of hexahedra.
Json rope() {
  return Json::parse(R"({
    "name": "rope", "step": 0.0005, "duration": 0.05, "gravity": [0, 0, 0],
    "bodies": [
      {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.125, "pattern": "kuhn"}}, "initial_velocity": [-1, 0.5, 0]},
      {"generate": {"chain": {"links": 6, "spacing": 0.1}}, "translate": [0.24, 0.1, 0.1],
       "material": {"density": 0.5, "stiffness": 4000, "damping": 0}},
      {"generate": {"box": {"cells": [2, 2, 2], "spacing": 0.1, "kind": "hexahedra"}}, "translate": [0.83, 0.02, 0.01],
       "initial_velocity": [1, 0, -0.5]}],
    "material": {"density": 768, "young": 2e5, "poisson": 0.3, "viscosity": 0},
    "attachments": [{"box": {"min": [0.2, 0.1, 0.1], "max": [0.3, 0.1, 0.1]}, "to": 0, "stiffness": 2000},
                    {"box": {"min": [0.83, 0.1, 0.1], "max": [0.85, 0.1, 0.1]}, "to": 2, "stiffness": 2000}]})");
}

TEST(BodiesOfDimensions, PullEachOtherByARopeAndKeepMomentaAndEnergy) {
  Json scene = rope();
  scene["integrator"] = "verlet";
  Simulation simulation(parse(scene));
  const Diagnostics before = simulation.diagnostics();
  run(simulation);
  const Diagnostics after = simulation.diagnostics();
  const double size = before.kinetic / 0.5;  // [kg m/s] and [kg m^2/s], speeds are about 1 m/s
  EXPECT_LT((after.momentum - before.momentum).norm(), 1e-13 * size);
  EXPECT_LT((after.angular_momentum - before.angular_momentum).norm(), 1e-13 * size);
  EXPECT_NEAR(after.energy(), before.energy(), 1e-5 * before.energy());
  EXPECT_GT(after.elastic, 0.01 * before.energy());
}

// The same two boxes attached to each other, with and without a chain far away: in a body of one map the attachments
// follow changes, in a body of parts they are found again after each.
TEST(BodiesOfDimensions, StayAttachedThroughChangesAsBodiesOfOneMapDo) {
  Json scene = Json::parse(R"({
    "name": "boxes", "step": 0.0005, "duration": 0.02, "gravity": [0, 0, 0],
    "bodies": [
      {"generate": {"box": {"cells": [3, 3, 3], "spacing": 0.1, "pattern": "kuhn"}},
       "initial_velocity": {"linear": [[1, -2, 0], [2, 0.5, 0], [0, 0, -1]], "centre": [0.125, 0.125, 0.125]}},
      {"generate": {"box": {"cells": [3, 2, 2], "spacing": 0.08}}, "translate": [0.02, 0.07, 0.3]}],
    "material": {"density": 768, "stiffness": 64, "damping": 0.25, "viscosity": 0},
    "attachments": [{"box": {"min": [0, 0, 0.3], "max": [1, 1, 0.3]}, "to": 0, "stiffness": 500},
                    {"plane": {"point": [0, 0, 0.46], "normal": [0, 0, 1]}, "stiffness": 300}],
    "events": [{"at": 0.002, "dissociate": {"plane": {"point": [0.12, 0, 0], "normal": [1, 0, 0]}}},
               {"at": 0.004, "remove": {"sphere": {"centre": [0.1, 0.1, 0.3], "radius": 0.07}}},
               {"at": 0.008, "dissociate": {"plane": {"point": [0, 0.2, 0], "normal": [0, 1, 0]}}},
               {"at": 0.012, "remove": {"sphere": {"centre": [0.2, 0.2, 0.32], "radius": 0.06}}}]})");
  Simulation of_one(parse(scene));
  scene["bodies"].push_back(
      Json::parse(R"({"generate": {"chain": {"links": 3, "spacing": 0.1}}, "translate": [5, 0, 0]})"));
  Simulation of_parts(parse(scene));
  run(of_one);
  run(of_parts);
  EXPECT_GT(of_one.operations(), 30u);
  EXPECT_EQ(of_one.operations(), of_parts.operations());
  const auto pieces = [](const Simulation& simulation) { return simulation.body().system().terms.back()->size(); };
  EXPECT_EQ(pieces(of_one), pieces(of_parts));
  const auto &x = of_one.body().vertices().position, &y = of_parts.body().vertices().position;
  ASSERT_EQ(x.size() + 4, y.size());
  for (std::size_t k = 0; k < x.size(); ++k) EXPECT_LT((x[k] - y[k]).norm(), 1e-13) << k;
}

TEST(BodiesOfDimensions, GoOnFromACheckpointAsIfUninterrupted) {
  Json scene = rope();
  scene["bodies"].push_back(
      Json::parse(R"({"generate": {"sheet": {"cells": [3, 3], "spacing": 0.1}}, "translate": [0, 0, 0.001],
    "material": {"density": 0.2, "young": 60, "poisson": 0.3}})"));
  scene["forces"] = Json::parse(
      R"([{"box": {"min": [0, 0, 0.25], "max": [0.25, 0.25, 0.25]}, "pressure": 50, "normals": "current"}])");
  scene["contact"] = Json::parse(R"({"pressure": 2e4, "depth": 0.002, "friction": 0.4,
    "obstacles": [{"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}]})");
  scene["gravity"] = {0, 0, -9.81};
  scene["fixed"] = Json::parse(R"([{"box": {"min": [0.83, 0, 0.2], "max": [2, 1, 0.22]}}])");
  scene["duration"] = 0.02;
  scene["events"] = Json::parse(R"([
    {"at": 0.005, "dissociate": {"plane": {"point": [0, 0.13, 0], "normal": [0, 1, 0]}}},
    {"at": 0.006, "release": {"box": {"min": [0.9, 0, 0], "max": [2, 1, 1]}}},
    {"at": 0.012, "remove": {"box": {"min": [0.9, 0, 0], "max": [2, 1, 1]}}}])");
  scene["output"] = Json::parse(R"({"frames_every": 0.005, "diagnostics_every": 0.002, "probes_every": 0.002,
    "checkpoint": 0.008, "fields": ["held", "stress", "displacement", "springs", "contact"],
    "probes": [{"name": "end", "near": [0.84, 0.1, 0.1]}, {"name": "sheet", "near": [0.3, 0.3, 0]}]})");
  scene["bodies"][1]["material"]["width"] = 0.01;
  const SceneFile parsed = parse(scene);
  recorded::expect_same(recorded::whole(parsed), recorded::in_two(parsed, 16));
}

TEST(BodiesOfDimensions, AreListedInOneFrameWithTheirNumbersMaterialsAndComponents) {
  Json scene = three_bodies();
  scene["output"]["fields"] = {"held", "stress", "displacement", "springs"};
  Simulation simulation(parse(scene));
  run(simulation);
  const Frame frame = simulation.frame();
  EXPECT_EQ(frame.mesh.cell_count(), 48u + 18u);
  EXPECT_EQ(frame.largest_stress, simulation.body().largest_stress());
  ASSERT_EQ(frame.links.size(), 5u);
  for (std::size_t p = 0; p < frame.mesh_point.size(); ++p) EXPECT_EQ(frame.mesh_point[p], static_cast<int>(p));
  for (std::size_t c = 0; c < frame.mesh_cell.size(); ++c) EXPECT_EQ(frame.mesh_cell[c], c);
  const std::uint32_t components[] = {0, 1, 2}, materials[] = {1, 2, 0};  // of solids, surfaces, chains
  for (std::size_t c = 0; c < frame.component.size(); ++c) {
    const std::size_t kind = c < 48 ? 0 : c < 66 ? 1 : 2;
    EXPECT_EQ(frame.component[c], components[kind]) << c;
    EXPECT_EQ(frame.body[c], materials[kind]) << c;  // each has a material of its own
    EXPECT_EQ(frame.material[c], materials[kind]) << c;
  }
  for (std::size_t b = 0; b < 3; ++b) {
    Json json = alone(scene, b);
    if (b > 0) json["output"]["fields"] = {"held", "stress", "displacement"};
    Simulation one(parse(json));
    run(one);
    const Frame own = one.frame();
    for (std::size_t p = first_point[b]; p < first_point[b + 1]; ++p) {
      EXPECT_EQ(frame.mesh.points[p], own.mesh.points[p - first_point[b]]);
      EXPECT_EQ(frame.displacement[p], own.displacement[p - first_point[b]]);
      EXPECT_EQ(frame.stress[p], b == 0 ? Eigen::Matrix3d::Zero() : own.stress[p - first_point[b]]);
    }
    if (b == 0) {
      EXPECT_EQ(frame.tension, own.tension);
      EXPECT_EQ(frame.strain, own.strain);
    }
  }
  EXPECT_NE(to_vtu(frame).find("Name=\"tension\""), std::string::npos);
}

TEST(BodiesOfDimensions, AreListedAsAChainWhereNothingElseIsLeft) {
  Json scene = three_bodies();
  scene["output"]["fields"] = {"stress", "springs"};
  scene["events"] = Json::parse(R"([{"at": 0.001, "remove": {"box": {"min": [-9, -9, -9], "max": [9, 9, 9]}}}])");
  Simulation simulation(parse(scene));
  run(simulation);
  const Frame frame = simulation.frame();
  EXPECT_EQ(frame.mesh.points.size(), 6u);
  EXPECT_EQ(frame.component, (std::vector<std::uint32_t>(5, 0)));
  EXPECT_NE(to_vtu(frame).find("Name=\"tension\""), std::string::npos);
  EXPECT_EQ(simulation.body().boundary(), 0.0);
}

TEST(BodiesOfDimensions, AreExplainedWithAllTheirMemory) {
  Json scene = rope();
  scene["bodies"].push_back(
      Json::parse(R"({"generate": {"sheet": {"cells": [3, 3], "spacing": 0.1}}, "translate": [0, 3, 0],
    "material": {"density": 0.2, "young": 60, "poisson": 0.3}})"));
  for (const bool on_map : {false, true}) {
    if (on_map)
      scene["events"] =
          Json::parse(R"([{"at": 0.01, "dissociate": {"plane": {"point": [0, 3.1, 0], "normal": [0, 1, 0]}}}])");
    const SceneFile parsed = parse(scene);
    ScenePlan plan = plan_scene(parsed);
    for (const MemoryItem& item : plan.unplanned) ADD_FAILURE() << "not planned: " << name(item.part);
    EXPECT_EQ(plan.counts.vertices, 27u + 7u + 27u + 16u);
    EXPECT_EQ(plan.counts.components, 4u);
    const Simulation simulation(parsed);
    EXPECT_EQ(plan.counts.edges, simulation.body().counts().edges);
    EXPECT_EQ(plan.counts.faces, simulation.body().counts().faces);
    if (on_map) {
      const SceneSurvey survey = survey_of(parsed);
      ASSERT_EQ(plan.selections.size(), survey.selections.size());
      EXPECT_EQ(plan.selections.back().all, survey.selections.back().all);
      EXPECT_EQ(plan.selections.back().selected, survey.selections.back().selected);
      EXPECT_GT(plan.selections.back().selected, 0u);
    }
  }
}

TEST(BodiesOfDimensions, NameTheKeyThatIsWrong) {
  const auto with = [](const char* path, const char* value) {
    Json scene = three_bodies();
    scene[Json::json_pointer(path)] = Json::parse(value);
    return refusal(scene);
  };
  EXPECT_EQ(
      with("/contact", R"({"pressure": 1, "depth": 1, "bodies": "others"})"),
      "file: /contact/bodies: cannot be used with surfaces and chains, which have no inside, like /bodies/0; expected "
      "solids, only obstacles, or 'pairs' that do not touch");
  EXPECT_EQ(with("/attachments", R"([{"box": {"min": [2, 0, 0], "max": [2, 1, 0]}, "to": 0, "stiffness": 1}])"),
            "file: /attachments/0/to: is 0, a chain, which has no cells; expected a body with cells that the chain's "
            "vertices are attached to");
  EXPECT_EQ(
      with("/bodies/0/material", R"({"density": 1, "young": 1, "poisson": 0.3})"),
      "file: /bodies/0/material/poisson: is given for a chain, whose links are springs; expected a material of its "
      "own for the chain, without this key");
  EXPECT_EQ(
      with("/events", R"([{"at": 0, "remove": {"random": {"count": 2, "seed": 1}}}])"),
      "file: /events/0/remove/random: draws among cells of several dimensions; expected a place or numbers of cells");
  EXPECT_EQ(with("/events", R"([{"at": 0, "remove": {"ids": [65, 66]}}])"),
            "file: /events/0/remove/ids/1: is 66; expected a cell of the mesh, less than 66");
  EXPECT_EQ(
      with("/bodies/0/generate/chain/spacing", "1e-200"),
      "file: /bodies/0/generate/chain/spacing: is 1e-200: of the chains, counted by themselves: link 0 has a length of "
      "0 m and a mass of 0 kg; expected numbers > 0");
}

// Of one dimension they need no parts.
TEST(BodiesOfDimensions, OfChainsAloneAreLinkedEachByItself) {
  const Json scene = Json::parse(R"({
    "name": "chains", "step": 0.001, "duration": 0.02,
    "bodies": [{"generate": {"chain": {"links": 3, "spacing": 0.1}}, "initial_velocity": {"linear": [[1, 0, 0], [0, 0, 0], [2, 0, 0]]}},
               {"generate": {"chain": {"links": 4, "spacing": 0.2}}, "translate": [1, 0, 0],
                "material": {"density": 2, "stiffness": 90}}]})");
  Simulation simulation(parse(scene));
  EXPECT_EQ(simulation.body().counts().vertices, 9u);
  EXPECT_EQ(simulation.body().counts().edges, 7u);
  EXPECT_EQ(simulation.body().counts().components, 2u);
  EXPECT_EQ(simulation.body().system().springs[2].stiffness, 50.0);
  EXPECT_EQ(simulation.body().system().springs[3].stiffness, 90.0);
  EXPECT_DOUBLE_EQ(simulation.body().mass(), 1000 * 0.3 + 2 * 0.8);
  const Frame frame = simulation.frame();
  EXPECT_EQ(frame.component, (std::vector<std::uint32_t>{0, 0, 0, 1, 1, 1, 1}));
}

}  // namespace
}  // namespace dartboard::bodies_of_dimensions_test
