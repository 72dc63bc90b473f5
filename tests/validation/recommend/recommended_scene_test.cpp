// What is recommended is a scene: its run, by the road of `simulate`, has the error that was asked for.

#include "validation/recommend/recommended_scene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "benchmarks/checkout/source_folder.h"
#include "core/plain/error.h"
#include "core/scene/file/step_times.h"
#include "core/scene/recorded_run.h"
#include "core/time/integrators.h"
#include "tests/support/folder_for_tests.h"
#include "tests/support/moving_box.h"
#include "validation/scenes/scene_of_file.h"

namespace dartboard::recommended_scene_test {
namespace {

using namespace moving;

/// A beam that is held at both ends, sags, and is cut at a time that few steps meet: that of the first page, smaller.
Json beam() {
  return Json::parse(R"({
    "name": "beam", "body": {"generate": {"box": {"cells": [12, 3, 3], "spacing": 0.02}}},
    "material": {"density": 1000, "stiffness": 60, "damping": 0.02, "viscosity": 1},
    "fixed": [{"plane": {"point": [0.001, 0, 0], "normal": [-1, 0, 0]}},
              {"plane": {"point": [0.239, 0, 0], "normal": [1, 0, 0]}}],
    "step": 0.0004, "duration": 0.36,
    "events": [{"at": 0.1, "dissociate": {"plane": {"point": [0.14, 0, 0.03], "normal": [1, 0, 0.7]}}}]})");
}

/// A clock that advances by a millisecond at each reading: pilots are few, and the same on every machine.
CpuClock ticking() {
  return [t = std::int64_t{0}]() mutable { return t += 1'000'000; };
}

Recommendation recommended(const TradeoffScene& scene, double error) { return recommend(scene, error, ticking()); }

/// [edges] The distance of the ends of two runs, as errors are measured.
double distance(const SimulatedBody& a, const SimulatedBody& b, double edge) {
  const VertexColumns &v = a.vertices(), &w = b.vertices();
  EXPECT_EQ(v.size(), w.size());
  double sum = 0.0, mass = 0.0;
  for (std::size_t k = 0; k < std::min(v.size(), w.size()); ++k) {
    sum += v.mass[k] * (v.position[k] - w.position[k]).squaredNorm();
    mass += v.mass[k];
  }
  return std::sqrt(sum / mass) / edge;
}

/// The end of a run with a step far below those that are recommended, events at their times.
double distance_from_truth(const Simulation& simulation, const SceneFile& scene, double edge, int steps) {
  SceneFile fine = scene;
  fine.integrator = "blanes-moan-4";
  fine.step = scene.duration / steps;
  Simulation truth(fine);
  run(truth);
  return distance(simulation.body(), truth.body(), edge);
}

class WrittenScene : public FolderTest {};

TEST_F(WrittenScene, HasTheErrorThatWasAskedForThroughACut) {
  const TradeoffScene scene = scene_of_file(parse(beam()));
  for (const double error : {1e-2, 1e-3}) {
    Recommendation r = recommended(scene, error);
    const RecommendedScene made = recommended_scene(scene, r);
    EXPECT_EQ(made.trouble, "");
    const auto file = folder_ / (std::to_string(error) + ".json");
    write_scene(made, file);
    RecordedRun recorded(read_scene(file));
    recorded.run();
    const Simulation& simulation = recorded.simulation();
    EXPECT_EQ(simulation.steps_done(), r.pick()->steps);
    EXPECT_EQ(static_cast<double>(r.pick()->steps) * simulation.step(), 0.36);
    EXPECT_LE(distance_from_truth(simulation, read_scene(file), scene.edge, 3600), error) << contents(file);
    // so it is that run that is judged, and not the setting: with its event a part of a step late it misses
    SceneReference reference;
    reference.states = run_timed(scene, *make_integrator("blanes-moan-4"), {.steps = 3600}, no_clock).states;
    EXPECT_LE(errors_of(made, scene, reference).x, error);
    EXPECT_GT(errors_of(made, scene, reference).x_largest, errors_of(made, scene, reference).x);
    RecommendedScene late = made;
    late.file.exact_events = false;
    if (error < 5e-3 && !step_at(0.1, late.file.step)) {
      EXPECT_GT(errors_of(late, scene, reference).x, error);
    }
  }
}

TEST_F(WrittenScene, IsNeverWrittenOverAnything) {
  const TradeoffScene scene = scene_of_file(parse(moving_box()));
  Recommendation r = recommended(scene, 1e-2);
  const RecommendedScene made = recommended_scene(scene, r);
  const auto file = folder_ / "scene.json";
  std::ofstream(file) << "precious";
  EXPECT_THROW(write_scene(made, file), IoError);
  EXPECT_EQ(text("scene.json"), "precious");
  EXPECT_THROW(write_scene(made, folder_), IoError);
  EXPECT_THROW(write_scene(made, folder_ / "no such folder" / "scene.json"), IoError);
}

TEST_F(WrittenScene, FindsItsMeshFromAnotherFolder) {
  namespace fs = std::filesystem;
  fs::create_directories(folder_ / "first" / "meshes");
  fs::create_directories(folder_ / "second");
  fs::copy(source_folder() / "benchmarks/meshes/liver564.mesh", folder_ / "first/meshes/liver.mesh");
  std::ofstream(folder_ / "first/scene.json") << R"({"name": "liver", "body": {"mesh": "meshes/liver.mesh"},
    "material": {"density": 1000, "stiffness": 5}, "step": 0.001, "duration": 0.01})";
  const TradeoffScene scene = scene_of_file(read_scene(folder_ / "first/scene.json"));
  Recommendation r = recommended(scene, 1e-2);
  write_scene(recommended_scene(scene, r), folder_ / "second/scene.json");
  EXPECT_EQ(Simulation(read_scene(folder_ / "second/scene.json")).body().counts().vertices, 564u);
}

TEST_F(WrittenScene, KeepsWhatElseTheSceneSaysButNoHash) {
  Json json = moving_box();
  json["about"] = "kept";
  json["integrator"] = "backward-euler";
  json["solver"] = "conjugate-gradients";
  ASSERT_EQ(refusal(json), "accepted");
  json["output"] = Json::parse(R"({"frames_every": {"steps": 5}, "diagnostics_every": 0.005})");
  json["expect"] = Json::parse(R"({"cells": 48, "hash": "0123456789abcdef"})");
  const TradeoffScene scene = scene_of_file(parse(json));
  Recommendation r = recommended(scene, 1e-2);
  write_scene(recommended_scene(scene, r), folder_ / "scene.json");
  const Json written = Json::parse(text("scene.json"));
  EXPECT_EQ(written.at("about"), "kept");
  EXPECT_EQ(written.at("body"), json.at("body"));
  EXPECT_EQ(written.at("integrator"), r.pick()->contender);
  EXPECT_FALSE(written.contains("solver"));
  EXPECT_FALSE(written.contains("accuracy"));
  EXPECT_EQ(written.at("output").at("frames_every"), 0.005);  // five steps of a millisecond
  EXPECT_EQ(written.at("expect"), Json::parse(R"({"cells": 48})"));
  EXPECT_EQ(refusal(written), "accepted");
}

// ---- what events choose

/// A recommendation of a few steps of an inaccurate method.
Recommendation coarse(double duration, std::uint64_t steps) {
  Recommendation r;
  r.error = 1.0;
  Candidate pick;
  pick.contender = "symplectic-euler";
  pick.steps = steps;
  pick.h = pick.pilot_h = duration / static_cast<double>(steps);
  pick.error_at_pilot = pick.predicted_error = 0.5;
  pick.predicted_s = pick.predicted_cost = pick.predicted_evaluations = 1.0;
  r.candidates = {pick};
  return r;
}

std::vector<double> middles(const Simulation& simulation) {
  std::vector<double> x;
  const Frame frame = simulation.body().frame({});
  for (std::size_t c = 0; c < frame.mesh.cell_count(); ++c) {
    x.push_back(0.0);
    for (const std::uint32_t k : frame.mesh.cell(c)) x.back() += frame.mesh.points[k].x() / 4.0;
  }
  return x;
}

/// A box that is cut by a plane between the places that a cell has by an accurate run and by eight steps.
Json cut_between_places() {
  Json json = moving_box();
  json["duration"] = 0.1;
  const auto places = [&](const char* integrator, double step) {
    Json one = json;
    one["integrator"] = integrator;
    one["step"] = step;
    one["duration"] = 0.05;
    Simulation simulation(parse(one));
    run(simulation);
    return middles(simulation);
  };
  const std::vector<double> exact = places("rk4", 0.0005), rough = places("symplectic-euler", 0.0125);
  std::size_t farthest = 0;
  for (std::size_t c = 0; c < exact.size(); ++c)
    if (std::abs(exact[c] - rough[c]) > std::abs(exact[farthest] - rough[farthest])) farthest = c;
  Json event = Json::parse(R"({"at": 0.05, "dissociate": {"plane": {"normal": [1, 0, 0]}}})");
  event["dissociate"]["plane"]["point"] = {0.5 * (exact[farthest] + rough[farthest]), 0, 0};
  json["events"] = Json::array({event});
  return json;
}

TEST(RecommendedScene, NamesTheCellsWhereItsStepWouldChooseOthers) {
  const Json json = cut_between_places();
  const TradeoffScene scene = scene_of_file(parse(json));
  Recommendation r = coarse(0.1, 8);
  const RecommendedScene made = recommended_scene(scene, r);
  EXPECT_TRUE(made.names_cells) << made.trouble;
  EXPECT_EQ(made.trouble, "");
  EXPECT_NE(made.choice.find("other cells"), std::string::npos) << made.choice;
  ASSERT_EQ(made.json.at("events").size(), 1u);
  EXPECT_TRUE(made.json["events"][0].at("dissociate").contains("points")) << made.json;
  Json accurate = json;
  accurate["integrator"] = "rk4";
  accurate["step"] = 0.0005;
  Simulation named(made.file), certain(parse(accurate));
  run(named);
  run(certain);
  EXPECT_EQ(named.operations(), certain.operations());
  EXPECT_EQ(named.body().counts().vertices, certain.body().counts().vertices);
  // the same corners of the same cells are one vertex
  const Frame a = named.body().frame({}), b = certain.body().frame({});
  ASSERT_EQ(a.mesh_cell, b.mesh_cell);
  for (std::size_t i = 0; i < a.mesh.nodes.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
      ASSERT_EQ(a.mesh.nodes[i] == a.mesh.nodes[j], b.mesh.nodes[i] == b.mesh.nodes[j]) << i << " " << j;
}

TEST(RecommendedScene, KeepsEventsThatChooseWhatAnAccurateRunChooses) {
  const TradeoffScene scene = scene_of_file(parse(cut_between_places()));
  Recommendation r = recommended(scene, 1e-6);
  const RecommendedScene made = recommended_scene(scene, r);
  EXPECT_FALSE(made.names_cells);
  EXPECT_EQ(made.trouble, "");
  EXPECT_NE(made.choice.find("the cells of the accurate run"), std::string::npos) << made.choice;
  EXPECT_TRUE(made.json.at("events")[0].at("dissociate").contains("plane"));
}

TEST(RecommendedScene, NamesRemovedCellsAndEventsOfEveryStep) {
  Json json = moving_box();
  json["duration"] = 0.1;
  json["initial_velocity"] = {1, 0, 0};  // all of it goes through a box, in which it is removed in each millisecond
  json["gravity"] = {0, 0, 0};
  json["events"] =
      Json::parse(R"([{"from": 0.001, "until": 0.08, "remove": {"box": {"min": [0.25, -1, -1], "max": [1, 1, 1]}}}])");
  const TradeoffScene scene = scene_of_file(parse(json));
  Recommendation r = coarse(0.1, 8);
  const RecommendedScene made = recommended_scene(scene, r);
  EXPECT_TRUE(made.names_cells) << made.trouble;
  Simulation named(made.file), first(parse(json));
  run(named);
  run(first);
  EXPECT_GT(named.operations(), 0u);
  EXPECT_EQ(named.operations(), first.operations());
}

TEST(RecommendedScene, SaysWhereNoSceneCanNameTheCells) {
  Json json = cut_between_places();
  json["events"].push_back(Json::parse(R"({"at": 0.0375, "refine": {"cells": {"ids": [3]}}})"));
  ASSERT_EQ(refusal(json), "accepted");
  const TradeoffScene scene = scene_of_file(parse(json));
  Recommendation r = coarse(0.1, 8);
  const RecommendedScene made = recommended_scene(scene, r);
  EXPECT_FALSE(made.names_cells);
  EXPECT_NE(made.trouble.find("No scene can name the cells"), std::string::npos) << made.trouble << made.choice;
}

// A simulation shows what an event at the time of a checkpoint has left; all of these checkpoints have one.
TEST(RecommendedScene, IsFollowedThroughEventsAtEveryCheckpoint) {
  Json json = moving_box();
  json["duration"] = 0.1;
  json["events"] = Json::parse(
      R"([{"from": 0.0125, "every": 0.0125, "until": 0.08, "remove": {"random": {"count": 6, "seed": 2}}},
          {"at": 0.0875, "dissociate": {"points": [[0, 1, 4]]}}, {"at": 0.1, "remove": {"random": {"count": 12}}}])");
  if (refusal(json) != "accepted") json["events"].erase(1);
  const TradeoffScene scene = scene_of_file(parse(json));
  SceneReference reference;
  reference.states = run_timed(scene, *make_integrator("blanes-moan-4"), {.steps = 800}, no_clock).states;
  Recommendation rough = coarse(0.1, 8), fine = recommended(scene, 1e-6);
  const RecommendedScene by_few = recommended_scene(scene, rough), by_many = recommended_scene(scene, fine);
  const TimedRun same_steps =
      run_timed(scene, *make_integrator("symplectic-euler"), {.steps = rough.pick()->steps}, no_clock);
  const double expected = reference::motion_errors(scene.motion, same_steps.states, reference.states).x;
  EXPECT_GT(expected, 1e-3);
  const double found = errors_of(by_few, scene, reference).x;  // at those checkpoints that are step boundaries
  EXPECT_GT(found, 0.1 * expected);
  EXPECT_LT(found, 1.5 * expected);
  EXPECT_LE(errors_of(by_many, scene, reference).x, 1e-6);
}

// ---- times

TEST(RecommendedScene, DividesItsStepsWhereLoadsBeginAndEnd) {
  for (const double from : {0.013, 0.0131415926535}) {
    Json json = moving_box();
    json["duration"] = 0.1;
    json["forces"] = Json::parse(R"([{"ids": [0, 1, 2], "force": [20, 0, 0], "until": 0.056}])");
    json["forces"][0]["from"] = from;
    const TradeoffScene scene = scene_of_file(parse(json));
    Recommendation r = recommended(scene, 1e-3);
    const RecommendedScene made = recommended_scene(scene, r);
    EXPECT_EQ(made.trouble, "");
    EXPECT_EQ(made.json.at("event_times"), "exact");
    EXPECT_FALSE(step_at(from, made.file.step) && step_at(0.056, made.file.step)) << from;
    Simulation simulation(made.file);
    run(simulation);
    EXPECT_EQ(static_cast<double>(simulation.step_count()) * simulation.step(), 0.1);
    EXPECT_LE(distance_from_truth(simulation, made.file, scene.edge, 4000), 1e-3) << from;
  }
}

// An event that repeats after less than a step would happen at every step.
TEST(RecommendedScene, HasShorterStepsThanItsEventsRepeatAfter) {
  Json json = moving_box();
  json["duration"] = 0.1;
  json["events"] =
      Json::parse(R"([{"from": 0.001, "every": 0.007, "until": 0.09, "remove": {"random": {"count": 1}}}])");
  const TradeoffScene scene = scene_of_file(parse(json));
  Recommendation r = coarse(0.1, 8);
  const RecommendedScene made = recommended_scene(scene, r);
  Simulation simulation(made.file);
  run(simulation);
  EXPECT_EQ(simulation.operations(), 13u);  // at 0.001, 0.008, ... 0.085
}

TEST(RecommendedScene, IsWhatAnAccuracySettlesOn) {
  Json json = beam();
  const TradeoffScene scene = scene_of_file(parse(json));
  Recommendation r = coarse(0.36, 40);
  const RecommendedScene made = recommended_scene(scene, r);
  json.erase("step");
  json["accuracy"] = 1.0;
  SceneFile asked = parse(json);
  const FittedPick fitted = fit_pick(asked, *r.pick(), r.features);
  EXPECT_EQ(asked.step, made.file.step);
  EXPECT_EQ(fitted.step, asked.step);
  EXPECT_EQ(asked.integrator, made.file.integrator);
  EXPECT_TRUE(asked.exact_events);
  EXPECT_TRUE(made.file.exact_events);
}

}  // namespace
}  // namespace dartboard::recommended_scene_test
