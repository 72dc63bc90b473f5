// Every key of a scene, each with a value of its own, and the member that stores it.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/scene/file/scene_file.h"
#include "core/scene/file/scene_problem.h"

namespace dartboard::scene_reading_test {
namespace {

using Json = nlohmann::json;
using Eigen::Vector3d;

Json least_scene() {
  return Json::parse(R"({"name": "x", "step": 0.25, "duration": 100,
                         "body": {"generate": {"box": {"cells": [2, 3, 4], "spacing": 0.5}}}})");
}
SceneFile read(const Json& json) { return parse_scene(json.dump(), "file", "folder"); }
SceneFile with(const char* key, const char* value) {
  Json json = least_scene();
  json[key] = Json::parse(value);
  return read(json);
}

TEST(SceneReading, OfWhatASceneIsAndWhatItsBodyIsMadeOf) {
  Json json = least_scene();
  json["about"] = "a sentence";
  json["material"] = Json::parse(R"({"density": 1, "stiffness": 2, "damping": 3, "viscosity": 4})");
  json["gravity"] = {5, 6, 7};
  json["integrator"] = "verlet";
  const SceneFile scene = read(json);
  EXPECT_EQ(scene.name, "x");
  EXPECT_EQ(scene.about, "a sentence");
  EXPECT_EQ(scene.step, 0.25);
  EXPECT_EQ(scene.duration, 100.0);
  EXPECT_EQ(scene.material.density, 1.0);
  EXPECT_EQ(scene.material.stiffness, 2.0);
  EXPECT_EQ(scene.material.damping, 3.0);
  EXPECT_EQ(scene.material.viscosity, 4.0);
  EXPECT_EQ(scene.gravity, Vector3d(5, 6, 7));
  EXPECT_EQ(scene.integrator, "verlet");
}

TEST(SceneReading, OfTheStepThatIsTooLong) {
  EXPECT_EQ(with("unstable_step", "\"warn\"").unstable_step, UnstableStep::warn);
  EXPECT_EQ(with("unstable_step", "\"refuse\"").unstable_step, UnstableStep::refuse);
  EXPECT_EQ(with("unstable_step", "\"substep\"").unstable_step, UnstableStep::substep);
}

TEST(SceneReading, OfWhenComponentsAreNoLongerStepped) {
  const SceneFile scene = with("sleep", R"({"speed": 0.125, "time": 3})");
  ASSERT_TRUE(scene.sleep);
  EXPECT_EQ(scene.sleep->speed, 0.125);
  EXPECT_EQ(scene.sleep->time, 3.0);
  EXPECT_FALSE(read(least_scene()).sleep);
}

TEST(SceneReading, OfBodies) {
  const SceneFile file = with("body", R"({"mesh": "a.mesh", "scale": 2, "translate": [3, 4, 5]})");
  EXPECT_EQ(std::get<std::filesystem::path>(file.body.mesh), "folder/a.mesh");
  EXPECT_EQ(file.body.scale, 2.0);
  EXPECT_EQ(file.body.translate, Vector3d(3, 4, 5));
  const auto box = std::get<BoxMesh>(
      with("body", R"({"generate": {"box": {"cells": [2, 3, 4], "spacing": 5, "jitter": 0.25, "seed": 7}}})")
          .body.mesh);
  EXPECT_EQ(box.cells, (std::array{2, 3, 4}));
  EXPECT_EQ(box.spacing, 5.0);
  EXPECT_EQ(box.kind, "tetrahedra");
  EXPECT_EQ(box.jitter, 0.25);
  EXPECT_EQ(box.seed, 7u);
  const auto sheet = std::get<SheetMesh>(
      with("body", R"({"generate": {"sheet": {"cells": [2, 3], "spacing": 4, "kind": "quadrilaterals"}}})").body.mesh);
  EXPECT_EQ(sheet.cells, (std::array{2, 3}));
  EXPECT_EQ(sheet.spacing, 4.0);
  EXPECT_EQ(sheet.kind, "quadrilaterals");
  const auto ball = std::get<BallMesh>(with("body", R"({"generate": {"ball": {"layers": 2, "radius": 3}}})").body.mesh);
  EXPECT_EQ(ball.layers, 2);
  EXPECT_EQ(ball.radius, 3.0);
  const auto chain =
      std::get<ChainMesh>(with("body", R"({"generate": {"chain": {"links": 2, "spacing": 3}}})").body.mesh);
  EXPECT_EQ(chain.links, 2);
  EXPECT_EQ(chain.spacing, 3.0);
}

TEST(SceneReading, OfMeshesMadeOnTheSpot) {
  const auto size = [](const char* generate) {
    Json json = least_scene();
    json["body"]["generate"] = Json::parse(generate);
    const Mesh mesh = make_mesh(read(json));
    return std::pair(mesh.points.size(), mesh.cell_count());
  };
  EXPECT_EQ(size(R"({"box": {"cells": [1, 2, 3], "spacing": 1}})"), std::pair(std::size_t{24}, std::size_t{36}));
  EXPECT_EQ(size(R"({"box": {"cells": [1, 2, 3], "spacing": 1, "kind": "hexahedra"}})"),
            std::pair(std::size_t{24}, std::size_t{6}));
  EXPECT_EQ(size(R"({"sheet": {"cells": [2, 3], "spacing": 1}})"), std::pair(std::size_t{12}, std::size_t{12}));
  EXPECT_EQ(size(R"({"sheet": {"cells": [2, 3], "spacing": 1, "kind": "quadrilaterals"}})"),
            std::pair(std::size_t{12}, std::size_t{6}));
  EXPECT_EQ(size(R"({"chain": {"links": 4, "spacing": 1}})"), std::pair(std::size_t{5}, std::size_t{0}));
  EXPECT_EQ(size(R"({"ball": {"layers": 2, "radius": 1}})").second, 8u * 8u);  // 8 layers^3
}

TEST(SceneReading, OfVelocitiesRowByRow) {
  EXPECT_EQ(with("initial_velocity", "[1, 2, 3]").initial_velocity.at({7, 8, 9}), Vector3d(1, 2, 3));
  const InitialVelocity v = with("initial_velocity", R"({"constant": [1, 2, 3], "centre": [4, 5, 6],
      "linear": [[10, 20, 30], [40, 50, 60], [70, 80, 90]]})")
                                .initial_velocity;
  EXPECT_EQ(v.at({4, 5, 6}), Vector3d(1, 2, 3));
  EXPECT_EQ(v.at({5, 5, 6}), Vector3d(11, 42, 73));
  EXPECT_EQ(v.at({4, 6, 6}), Vector3d(21, 52, 83));
  EXPECT_EQ(v.at({4, 5, 7}), Vector3d(31, 62, 93));
}

TEST(SceneReading, OfVerticesHeldAndDriven) {
  const SceneFile fixed = with("fixed", R"([{"ids": [1, 2]}, {"box": {"min": [1, 2, 3], "max": [4, 5, 6]}},
      {"plane": {"point": [1, 2, 3], "normal": [0, -4, 0]}}, {"sphere": {"centre": [1, 2, 3], "radius": 4}},
      {"around": {"path": [[1, 2, 3], [4, 5, 6]], "depth": [7, 8, 9], "distance": 0.5}}])");
  EXPECT_EQ(std::get<IdSelection>(fixed.fixed[0].vertices).ids, (std::vector<std::uint32_t>{1, 2}));
  EXPECT_EQ(std::get<BoxSelection>(fixed.fixed[1].vertices).min, Vector3d(1, 2, 3));
  EXPECT_EQ(std::get<BoxSelection>(fixed.fixed[1].vertices).max, Vector3d(4, 5, 6));
  EXPECT_EQ(std::get<PlaneSelection>(fixed.fixed[2].vertices).point, Vector3d(1, 2, 3));
  EXPECT_EQ(std::get<PlaneSelection>(fixed.fixed[2].vertices).normal, Vector3d(0, -1, 0));  // of length 1
  EXPECT_EQ(std::get<SphereSelection>(fixed.fixed[3].vertices).centre, Vector3d(1, 2, 3));
  EXPECT_EQ(std::get<SphereSelection>(fixed.fixed[3].vertices).radius, 4.0);
  const auto& around = std::get<AroundSelection>(fixed.fixed[4].vertices);
  EXPECT_EQ(around.sweep.path, (std::vector<Vector3d>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(around.sweep.depth, Vector3d(7, 8, 9));
  EXPECT_EQ(around.distance, 0.5);

  const SceneDrive drive = with("driven", R"([{"ids": [5], "velocity": [1, 2, 3], "from": 4, "until": 6,
      "reverse_every": 0.5}])")
                               .driven.at(0);
  EXPECT_EQ(std::get<IdSelection>(drive.vertices).ids, std::vector<std::uint32_t>{5});
  EXPECT_EQ(drive.velocity.constant, Vector3d(1, 2, 3));
  EXPECT_EQ(drive.from, 4.0);
  EXPECT_EQ(drive.until, 6.0);
  EXPECT_EQ(drive.reverse_every, 0.5);
  EXPECT_EQ(drive.path, "/driven/0");
}

TEST(SceneReading, OfEvents) {
  const auto events = with("events", R"([
      {"at": 1, "dissociate": {"points": [[1, 2, 3], [4, 5, 6]]}},
      {"at": 2, "dissociate": {"plane": {"point": [1, 2, 3], "normal": [0, 0, 5]}}},
      {"every": 0.5, "from": 3, "until": 4, "remove": {"random": {"count": 5, "seed": 6}}},
      {"at": 5, "tear": {"vertex": 7, "direction": [0, 2, 0]}},
      {"at": 6, "tear": {"near": [1, 2, 3], "direction": [3, 0, 0]}},
      {"at": 8, "remove": {"ids": [9]}}])")
                          .events;
  const auto& faces = std::get<0>(std::get<Dissociate>(events[0].action).faces);
  EXPECT_EQ(faces, (std::vector<std::vector<std::uint32_t>>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(events[0].from, 1.0);
  EXPECT_EQ(events[0].until, 1.0);
  EXPECT_FALSE(events[0].every);
  EXPECT_EQ(events[0].path, "/events/0");
  EXPECT_EQ(std::get<PlaneSelection>(std::get<Dissociate>(events[1].action).faces).normal, Vector3d(0, 0, 1));
  EXPECT_EQ(events[2].every, 0.5);
  EXPECT_EQ(events[2].from, 3.0);
  EXPECT_EQ(events[2].until, 4.0);
  const auto random = std::get<RandomSelection>(std::get<Remove>(events[2].action).cells);
  EXPECT_EQ(random.count, 5u);
  EXPECT_EQ(random.seed, 6u);
  EXPECT_EQ(std::get<std::uint32_t>(std::get<Tear>(events[3].action).vertex), 7u);
  EXPECT_EQ(std::get<Tear>(events[3].action).direction, Vector3d(0, 1, 0));
  EXPECT_EQ(std::get<Vector3d>(std::get<Tear>(events[4].action).vertex), Vector3d(1, 2, 3));
  EXPECT_EQ(std::get<IdSelection>(std::get<Remove>(events[5].action).cells).ids, std::vector<std::uint32_t>{9});
}

TEST(SceneReading, OfStressAndRefinement) {
  const auto stress = std::get<TearWhereStressed>(with("events", R"([{"tear_where_stressed": {"threshold": 1,
      "plane": {"point": [2, 3, 4], "normal": [1, 0, 0]}, "most_per_step": 5}}])")
                                                      .events.at(0)
                                                      .action);
  EXPECT_EQ(stress.threshold, 1.0);
  EXPECT_EQ(stress.seam->point, Vector3d(2, 3, 4));
  EXPECT_EQ(stress.most_per_step, 5u);
  const auto bare = with("events", R"([{"from": 2, "tear_where_stressed": {"threshold": 1}}])").events.at(0);
  EXPECT_FALSE(std::get<TearWhereStressed>(bare.action).seam);
  EXPECT_FALSE(std::get<TearWhereStressed>(bare.action).most_per_step);
  EXPECT_EQ(bare.from, 2.0);
  EXPECT_EQ(bare.until, 100.0);  // left out: the duration
  const auto refine = [](const char* at) {
    Json event = Json::parse(R"([{"at": 1, "refine": {"cells": {"ids": [2]}, "bracing": 3}}])");
    if (*at != 0) event[0]["refine"]["at"] = at;
    return std::get<Refine>(with("events", event.dump().c_str()).events.at(0).action);
  };
  EXPECT_EQ(std::get<IdSelection>(refine("").cells).ids, std::vector<std::uint32_t>{2});
  EXPECT_EQ(refine("").bracing, 3.0);
  EXPECT_FALSE(refine("").at_centre);
  EXPECT_FALSE(refine("longest edge").at_centre);
  EXPECT_TRUE(refine("centre").at_centre);
}

TEST(SceneReading, OfOutputAndProbes) {
  const SceneFile steps = with("output", R"({"frames_every": {"steps": 2}, "diagnostics_every": {"steps": 3},
      "probes_every": {"steps": 4}, "probes": [{"name": "a", "vertex": 5}, {"name": "b", "near": [6, 7, 8]}]})");
  EXPECT_EQ(steps.output.frame_steps, 2u);
  EXPECT_EQ(steps.output.diagnostic_steps, 3u);
  EXPECT_EQ(steps.output.probe_steps, 4u);
  EXPECT_EQ(steps.probes.at(0).name, "a");
  EXPECT_EQ(std::get<std::uint32_t>(steps.probes.at(0).vertex), 5u);
  EXPECT_EQ(std::get<Vector3d>(steps.probes.at(1).vertex), Vector3d(6, 7, 8));
  EXPECT_EQ(steps.probes.at(1).path, "/output/probes/1");
  // of a step of 0.25 s
  const SceneFile times =
      with("output", R"({"frames_every": 2, "diagnostics_every": 3, "probes_every": 4, "checkpoint": 5.1})");
  EXPECT_EQ(times.output.frame_steps, 8u);
  EXPECT_EQ(times.output.diagnostic_steps, 12u);
  EXPECT_EQ(times.output.probe_steps, 16u);
  EXPECT_EQ(times.output.checkpoint_steps, 21u);
  EXPECT_FALSE(steps.output.checkpoint_steps);
}

TEST(SceneReading, OfAYoungsModulusInPlaceOfAStiffness) {
  EXPECT_EQ(with("material", R"({"young": 7e3})").material.young, 7e3);
  EXPECT_EQ(with("material", R"({"stiffness": 7})").material.young, 0.0);
}

TEST(SceneReading, OfWhatFramesHold) {
  const auto fields = [](const char* words) {
    const FrameFields f = with("output", (R"({"fields": )" + std::string(words) + "}").c_str()).output.fields;
    return std::array{f.held, f.stress, f.displacement, f.springs};
  };
  EXPECT_EQ(fields("[]"), (std::array{false, false, false, false}));
  EXPECT_EQ(fields(R"(["held"])"), (std::array{true, false, false, false}));
  EXPECT_EQ(fields(R"(["stress"])"), (std::array{false, true, false, false}));
  EXPECT_EQ(fields(R"(["displacement"])"), (std::array{false, false, true, false}));
  EXPECT_EQ(fields(R"(["springs"])"), (std::array{false, false, false, true}));
  EXPECT_EQ(fields(R"(["springs", "held"])"), (std::array{true, false, false, true}));
  const FrameFields standard = with("output", "{}").output.fields;
  EXPECT_TRUE(standard.held && standard.stress && !standard.displacement && !standard.springs);
}

TEST(SceneReading, OfWhatIsExpected) {
  Json json = least_scene();
  json["material"] = {{"damping", 0}, {"viscosity", 0}};
  json["output"]["probes"] = Json::parse(R"([{"name": "a", "vertex": 0}, {"name": "b", "vertex": 1}])");
  json["expect"] = Json::parse(R"({"vertices": 1, "edges": 2, "faces": 3, "cells": 4, "components": 5,
      "operations": 6, "mass": 7, "kinetic_at_most": 8, "energy_drift_at_most": 9, "hash": "0123456789abcdef",
      "places": [{"probe": "b", "position": [10, 11, 12], "within": 13},
                 {"probe": "a", "position": [0, 0, 0], "within": 0, "of": "part", "why": "a reason"}]})");
  const Expectation e = read(json).expect;
  EXPECT_EQ(e.vertices, 1u);
  EXPECT_EQ(e.edges, 2u);
  EXPECT_EQ(e.faces, 3u);
  EXPECT_EQ(e.cells, 4u);
  EXPECT_EQ(e.components, 5u);
  EXPECT_FALSE(e.components_at_least);
  EXPECT_EQ(e.operations, 6u);
  EXPECT_EQ(e.mass, 7.0);
  EXPECT_EQ(e.kinetic_at_most, 8.0);
  EXPECT_EQ(e.energy_drift_at_most, 9.0);
  EXPECT_EQ(e.hash, 0x0123456789abcdefu);
  EXPECT_EQ(e.places.at(0).probe, 1u);
  EXPECT_EQ(e.places.at(0).position, Vector3d(10, 11, 12));
  EXPECT_EQ(e.places.at(0).within, 13.0);
  EXPECT_FALSE(e.places.at(0).of_part);
  EXPECT_TRUE(e.places.at(1).of_part);
  EXPECT_EQ(e.places.at(1).why, "a reason");
  EXPECT_EQ(with("expect", R"({"why": "so it is"})").expect.why, "so it is");
  EXPECT_EQ(with("expect", R"({"components_at_least": 3})").expect.components_at_least, 3u);
  for (const auto& [key, value] : json["expect"].items()) {
    Json one = json;
    one["expect"] = Json::object({{key, value}});
    EXPECT_FALSE(read(one).expect.empty()) << key;
  }
  EXPECT_FALSE(with("expect", R"({"components_at_least": 3})").expect.empty());
  EXPECT_TRUE(with("expect", "{}").expect.empty());
}

TEST(SceneReading, MakesAProblemOfWhatItSays) {
  Json json = least_scene();
  json["body"]["scale"] = 2;
  json["body"]["translate"] = {1, 2, 3};
  json["gravity"] = {4, 5, 6};
  json["initial_velocity"] = Json::parse(R"({"linear": [[1, 0, 0], [0, 2, 0], [0, 0, 3]]})");
  json["fixed"] = Json::parse(R"([{"ids": [7, 3]}, {"ids": [3]}])");
  json["driven"] = Json::parse(R"([{"ids": [5], "velocity": [1, 0, 0]}])");
  const Problem problem = make_problem(read(json));
  EXPECT_EQ(problem.mesh.points[0], Vector3d(1, 2, 3));
  EXPECT_EQ(problem.mesh.points[1], Vector3d(2, 2, 3));  // half a metre, twice as large
  EXPECT_EQ(problem.surroundings.gravity, Vector3d(4, 5, 6));
  EXPECT_EQ(problem.initial_velocity[1], Vector3d(2, 4, 9));  // at the place of the body
  EXPECT_EQ(problem.fixed, (std::vector<std::uint32_t>{3, 5, 7}));
  EXPECT_EQ(problem.h, 0.25);
}

}  // namespace
}  // namespace dartboard::scene_reading_test
