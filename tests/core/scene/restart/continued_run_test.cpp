// A run that is interrupted and continued ends in the bits of one that is not, with the same output.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/time/integrators.h"
#include "core/time/solve/stop_request.h"
#include "tests/support/moving_box.h"
#include "tests/support/run_in_memory.h"

namespace dartboard::continued_run_test {
namespace {

using namespace moving;
using namespace recorded;

Json recorded_scene(Json scene) {
  scene["output"] = Json::parse(R"({
    "frames_every": {"steps": 3}, "diagnostics_every": {"steps": 2}, "probes_every": {"steps": 1},
    "fields": ["held", "stress", "displacement", "springs"],
    "probes": [{"name": "corner", "vertex": 0}, {"name": "inside", "near": [0.125, 0.125, 0.125]}]})");
  return scene;
}

Json with_body(Json scene, const char* generate) {
  scene["body"] = {{"generate", Json::parse(generate)}};
  return scene;
}

/// Interrupts after every step but the last.
void expect_same_wherever_interrupted(const Json& json, bool of_elements = false) {
  Json recorded = recorded_scene(json);
  if (of_elements) recorded["output"]["fields"] = {"held", "stress", "displacement"};  // there are no springs
  const SceneFile scene = parse(recorded);
  const RunInMemory one = whole(scene);
  for (std::uint64_t n = 1; n < one.simulation->step_count(); ++n) {
    SCOPED_TRACE("interrupted after " + std::to_string(n));
    expect_same(in_two(scene, n), one);
    if (testing::Test::HasFailure()) return;
  }
}

// Cuts, tears, and cells drawn at random; refinement uses slots of removed cells again.
const char* const eventful = R"([
  {"at": 0, "remove": {"ids": [7]}},
  {"at": 0.002, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}},
  {"every": 0.003, "from": 0.001, "until": 0.009, "remove": {"random": {"count": 2, "seed": 5}}},
  {"at": 0.004, "tear": {"vertex": 13, "direction": [1, 0, 0]}},
  {"every": 0.0025, "until": 0.01, "refine": {"cells": {"random": {"count": 2, "seed": 9}}}},
  {"at": 0.008, "dissociate": {"points": [[0, 1, 13], [13, 14, 26]]}},
  {"at": 0.006, "remove": {"box": {"min": [5, 5, 5], "max": [6, 6, 6]}}},
  {"every": 0.002, "from": 0.003, "tear_where_stressed": {"threshold": 30}}])";

TEST(ContinuedRun, OfABodyWithoutAMapIsTheSame) { expect_same_wherever_interrupted(moving_box()); }

TEST(ContinuedRun, OfABodyOfElementsIsTheSame) {
  for (const char* integrator : {"verlet", "backward-euler", "energy-momentum"})
    for (const bool damped : {false, true}) {
      Json scene = with_events(moving_box(), eventful);
      scene["material"] = Json::parse(R"({"density": 768, "young": 2e4, "poisson": 0.3})");
      if (damped) scene["material"]["damping"] = Json::parse(R"({"ratio": 0.05, "frequency": 4})");
      scene["integrator"] = integrator;
      expect_same_wherever_interrupted(scene, true);
    }
}

TEST(ContinuedRun, OfABodyThatIsCutTornErodedAndRefinedIsTheSame) {
  // conditions without which the following tests would prove little
  const RunInMemory one = whole(parse(recorded_scene(with_events(moving_box(), eventful))));
  ASSERT_FALSE(one.result.divergence);
  ASSERT_GT(one.simulation->operations(), 20u);
  ASSERT_GT(one.simulation->body().removed_mass(), 0.0);
  ASSERT_EQ(one.simulation->idle_events(), std::vector<std::string>{"/events/6"});
  expect_same_wherever_interrupted(with_events(moving_box(), eventful));
}

TEST(ContinuedRun, OfEventsAtTheirVeryTimesIsTheSame) {
  Json scene = with_events(moving_box(), eventful);
  scene["event_times"] = "exact";
  for (Json& event : scene["events"])
    for (const char* key : {"at", "from"})
      if (event.contains(key)) event[key] = event[key].get<double>() + 0.0003;
  expect_same_wherever_interrupted(scene);
}

TEST(ContinuedRun, OfMixedCellsIsTheSame) {
  expect_same_wherever_interrupted(with_body(with_events(moving_box(), R"([
    {"at": 0.002, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}},
    {"every": 0.002, "from": 0.001, "until": 0.01, "remove": {"random": {"count": 1}}},
    {"at": 0.005, "tear": {"near": [0.125, 0.125, 0.125], "direction": [0, 1, 0]}}])"),
                                             R"({"box": {"cells": [3, 3, 3], "spacing": 0.125, "kind": "mixed"}})"));
}

TEST(ContinuedRun, OfASurfaceIsTheSame) {
  expect_same_wherever_interrupted(with_body(with_events(moving_box(), R"([
    {"at": 0.003, "dissociate": {"plane": {"point": [0.2, 0, 0], "normal": [1, 0, 0]}}},
    {"every": 0.002, "until": 0.01, "remove": {"random": {"count": 1}}}])"),
                                             R"({"sheet": {"cells": [4, 4], "spacing": 0.125}})"));
}

// The last vertex gets the number of the corner that goes away with its cells.
TEST(ContinuedRun, OfAProbeWhoseVertexTakesAnotherNumberIsTheSame) {
  Json json = recorded_scene(with_body(with_events(moving_box(), R"([{"at": 0.003, "remove": {"ids": [0, 1]}}])"),
                                       R"({"sheet": {"cells": [4, 4], "spacing": 0.125}})"));
  json["output"]["probes"] = Json::parse(R"([{"name": "first", "vertex": 0}, {"name": "last", "vertex": 24}])");
  const SceneFile scene = parse(json);
  const RunInMemory one = whole(scene);
  const Simulation start(scene);
  const auto before = start.body().tracked(), after = one.simulation->body().tracked();
  ASSERT_FALSE(std::ranges::equal(before, after));
  for (std::uint64_t n = 1; n < 10; ++n) expect_same(in_two(scene, n), one);
}

TEST(ContinuedRun, OfAChainIsTheSame) {
  Json scene = with_body(moving_box(), R"({"chain": {"links": 6, "spacing": 0.1}})");
  scene["fixed"] = Json::parse(R"([{"ids": [0, 6]}])");
  scene["events"] = Json::parse(R"([{"at": 0.005, "release": {"ids": [6]}}])");
  expect_same_wherever_interrupted(scene);
}

TEST(ContinuedRun, OfDrivenAndReleasedVerticesIsTheSame) {
  Json scene = moving_box();
  scene["driven"] = Json::parse(R"([
    {"plane": {"point": [0, 0, 0.25], "normal": [0, 0, 1]}, "velocity": [0, 0, 2], "from": 0.001, "until": 0.008,
     "reverse_every": 0.002},
    {"box": {"min": [-0.01, -0.01, 0.12], "max": [0.01, 0.3, 0.13]}, "velocity": [0.5, 0, 0], "from": 0.0035,
     "until": 0.006}])");
  scene["fixed"] = Json::parse(R"([{"plane": {"point": [0, 0, 0], "normal": [0, 0, -1]}}])");
  scene["events"] = Json::parse(R"([
    {"at": 0.006, "release": {"plane": {"point": [0, 0, 0], "normal": [0, 0, -1]}}},
    {"every": 0.002, "until": 0.01, "remove": {"random": {"count": 1}}}])");
  expect_same_wherever_interrupted(scene);
}

TEST(ContinuedRun, OfADividedStepIsTheSame) {
  Json scene = with_events(moving_box(), eventful);
  scene["unstable_step"] = "substep";
  scene["material"]["stiffness"] = 1e6;
  ASSERT_GT(Simulation(parse(scene)).step_warning()->parts, 1u);
  expect_same_wherever_interrupted(scene);
}

TEST(ContinuedRun, WhateverSolvesItsEquationsIsTheSame) {
  Json scene = with_events(moving_box(), eventful);
  scene["integrator"] = "sdirk2";
  for (const SolverEntry& entry : linear_solvers()) {
    SCOPED_TRACE(entry.name);
    scene["solver"] = entry.name;
    expect_same_wherever_interrupted(scene);
  }
}

struct ContinuedRunBy : testing::TestWithParam<std::string_view> {};

TEST_P(ContinuedRunBy, IsTheSame) {
  Json scene = moving_box();
  scene["integrator"] = GetParam();
  expect_same_wherever_interrupted(scene);
}

// The factors are updated: their bits differ from those of fresh ones.
TEST_P(ContinuedRunBy, OfABodyThatIsCutIsTheSame) {
  Json scene = with_events(moving_box(), eventful);
  scene["integrator"] = GetParam();
  scene["fixed"] = Json::parse(R"([{"plane": {"point": [0, 0, 0], "normal": [0, 0, -1]}}])");
  expect_same_wherever_interrupted(scene);
}

std::vector<std::string_view> all_names() {
  std::vector<std::string_view> names;
  for (const IntegratorEntry& entry : integrators()) names.push_back(entry.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(Every, ContinuedRunBy, testing::ValuesIn(all_names()));

// ---- within a step

int looks_left = 0;
bool after_some_looks() { return --looks_left < 0; }

/// Stopped at each number of calls of the check; returns how many of the runs left a checkpoint.
int expect_same_wherever_stopped(const Json& json) {
  const SceneFile scene = parse(recorded_scene(json));
  const RunInMemory one = whole(scene);
  int continued_runs = 0;
  for (int looks = 0; looks < 60; ++looks) {
    Simulation stopped(scene);
    stopped.watch_events(true);
    Record record;
    looks_left = looks;
    {
      const StopRequest request(after_some_looks);
      if (!run_scene(stopped, scene.output, record).interrupted) break;
    }
    // no checkpoint if the step could not be taken back
    if (!record.state) continue;
    EXPECT_EQ(record.checkpoints, std::vector<std::uint64_t>{stopped.steps_done()});
    ++continued_runs;
    expect_same(continued(scene, std::move(record)), one);
    if (testing::Test::HasFailure()) break;
  }
  return continued_runs;
}

TEST(ContinuedRun, IsTheSameWhereAStepWasGivenUp) {
  Json scene = with_events(moving_box(), eventful);
  scene["integrator"] = "bdf2";
  EXPECT_GT(expect_same_wherever_stopped(scene), 10);
}

TEST(ContinuedRun, IsTheSameWhereAStepWithEventsWithinItWasGivenUp) {
  Json scene = with_events(moving_box(), R"([
    {"at": 0.0014, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}},
    {"every": 0.0007, "until": 0.01, "remove": {"random": {"count": 1}}}])");
  scene["integrator"] = "backward-euler";
  scene["event_times"] = "exact";
  EXPECT_GT(expect_same_wherever_stopped(scene), 3);
}

// ---- a run that diverges after it was continued

TEST(ContinuedRun, GoesBackToTheStateThatTheWholeOneDoes) {
  Json json = moving_box();
  json["step"] = 1.01 * Simulation(parse(json)).step_limit().stable;
  json["duration"] = 1e4 * json["step"].get<double>();
  const SceneFile scene = parse(json);
  const RunInMemory one = whole(scene);
  ASSERT_TRUE(one.result.divergence);
  ASSERT_GT(one.result.divergence->taken_back, 0u);
  for (const std::uint64_t before : {1u, 2u, 7u, 40u, 100u})
    expect_same(in_two(scene, one.result.divergence->step - before), one);
}

// ---- when checkpoints are left

std::vector<std::uint64_t> checkpoints_of(const Json& output, std::optional<std::uint64_t> most_steps = {}) {
  Json json = moving_box();
  json["output"] = output;
  const SceneFile scene = parse(json);
  Simulation simulation(scene);
  Record record;
  run_scene(simulation, scene.output, record, most_steps);
  return record.checkpoints;
}
using Steps = std::vector<std::uint64_t>;

TEST(Checkpoints, AreLeftAtMultiplesOfTheKeyAndAtTheEnd) {
  EXPECT_EQ(checkpoints_of({{"checkpoint", 0.003}}), (Steps{3, 6, 9, 10}));
  EXPECT_EQ(checkpoints_of({{"checkpoint", 0.005}}), (Steps{5, 10}));
  EXPECT_EQ(checkpoints_of({{"checkpoint", 0.003}}, 4), (Steps{3, 4}));
  EXPECT_EQ(checkpoints_of({{"checkpoint", 1.0}}), Steps{10});
}

TEST(Checkpoints, AreLeftWithoutTheKeyByARunThatIsCutShort) {
  EXPECT_EQ(checkpoints_of(Json::object()), Steps{});
  EXPECT_EQ(checkpoints_of(Json::object(), 4), Steps{4});
}

// Events that last to the end of the run last to its new end.
TEST(ContinuedRun, ForLongerIsThatOfALongerRun) {
  Json longer = recorded_scene(with_events(moving_box(), R"([
    {"every": 0.002, "from": 0.001, "remove": {"random": {"count": 2, "seed": 5}}},
    {"every": 0.0001, "from": 0.001, "remove": {"random": {"count": 1, "seed": 6}}},
    {"tear_where_stressed": {"threshold": 30}}])"));
  longer["driven"] = Json::parse(
      R"([{"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]}, "velocity": [1, 0, 0], "reverse_every": 0.002}])");
  longer["output"]["checkpoint"] = 0.003;
  const RunInMemory whole_run = whole(parse(longer));
  for (const double duration : {0.004, 0.005}) {
    Json shorter = longer;
    shorter["duration"] = duration;
    const SceneFile scene = parse(shorter);
    Simulation first(scene);
    first.watch_events(true);
    Record record;
    run_scene(first, scene.output, record);
    const RunInMemory rest = continued(parse(longer), std::move(record));
    EXPECT_EQ(rest.simulation->body().state_hash(), whole_run.simulation->body().state_hash()) << duration;
    EXPECT_EQ(rest.simulation->operations(), whole_run.simulation->operations()) << duration;
  }
}

TEST(ContinuedRun, FromACheckpointOfTheKeyOrOfARunThatIsCutShortIsTheSame) {
  Json json = recorded_scene(with_events(moving_box(), eventful));
  for (const bool has_key : {true, false}) {
    if (has_key) json["output"]["checkpoint"] = 0.003;
    if (!has_key) json["output"].erase("checkpoint");
    const SceneFile scene = parse(json);
    const RunInMemory one = whole(scene);
    for (const std::uint64_t most : {3u, 4u, 7u, 9u}) {
      Simulation first(scene);
      first.watch_events(true);
      Record record;
      run_scene(first, scene.output, record, most);
      expect_same(continued(scene, std::move(record)), one);
    }
  }
}

}  // namespace
}  // namespace dartboard::continued_run_test
