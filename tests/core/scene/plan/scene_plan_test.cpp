// The plan of a scene compared with the scene itself: every part that takes memory is planned, with its exact memory.

#include "core/scene/plan/scene_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "core/scene/file/scene_problem.h"
#include "core/scene/run/scene_run.h"
#include "core/time/integrators.h"
#include "tests/support/moving_box.h"
#include "tests/support/plan_memory.h"

namespace dartboard::scene_plan_test {
namespace {

using namespace moving;

const char* const one_removal = R"([{"at": 0.005, "remove": {"ids": [3, 1, 3]}}])";

void expect_exact(const Json& json, const std::string& what) {
  const SceneFile scene = parse(json);
  const Problem problem = make_problem(scene);
  const ScenePlan planned = plan_scene(scene);
  for (const PlanItem& item : planned.items)
    EXPECT_EQ(item.bytes, memory::predicted_bytes(scene, problem, planned, item)) << what << ": " << name(item.part);
  for (const MemoryItem& item : planned.unplanned) ADD_FAILURE() << what << ": not planned: " << name(item.part);
}

const PlanItem* item(const ScenePlan& plan, Part part) {
  const auto found = std::ranges::find(plan.items, part, &PlanItem::part);
  return found == plan.items.end() ? nullptr : &*found;
}

bool leaves_out(const ScenePlan& plan, const std::string& what, const std::string& because) {
  return std::ranges::any_of(plan.left_out, [&](const LeftOut& l) {
    return l.what.find(what) != std::string::npos && l.why.find(because) != std::string::npos;
  });
}

struct Body {
  const char *name, *json;
};
const Body bodies[] = {
    {"tetrahedra", R"({"box": {"cells": [3, 2, 2], "spacing": 0.125, "jitter": 0.2}})"},
    {"hexahedra", R"({"box": {"cells": [2, 3, 2], "spacing": 0.125, "kind": "hexahedra"}})"},
    {"all kinds", R"({"box": {"cells": [2, 2, 2], "spacing": 0.125, "kind": "mixed"}})"},
    {"ball", R"({"ball": {"layers": 2, "radius": 0.25}})"},
    {"triangles", R"({"sheet": {"cells": [3, 4], "spacing": 0.125}})"},
    {"quadrilaterals", R"({"sheet": {"cells": [4, 3], "spacing": 0.125, "kind": "quadrilaterals"}})"},
};

Json with_body(Json scene, const Body& body) {
  scene["body"]["generate"] = Json::parse(body.json);
  return scene;
}

TEST(ScenePlan, IsExactInBytesForEveryKindOfBodyWithAndWithoutAMap) {
  for (const Body& body : bodies) {
    expect_exact(with_body(moving_box(), body), std::string(body.name) + " without a map");
    expect_exact(with_body(with_events(moving_box(), one_removal), body), std::string(body.name) + " on a map");
  }
}

TEST(ScenePlan, IsExactInBytesWithSleep) {
  Json scene = moving_box();
  scene["sleep"] = {{"speed", 1e-3}, {"time", 0.005}};
  expect_exact(scene, "without forces");
  scene["forces"] = Json::parse(R"([{"sphere": {"centre": [0, 0, 0], "radius": 0.01}, "force": [0, 0, 1]}])");
  expect_exact(scene, "with forces");
}

TEST(ScenePlan, IsExactInBytesForAChain) {
  Json scene = with_body(moving_box(), {"chain", R"({"chain": {"links": 12, "spacing": 0.125}})"});
  expect_exact(scene, "a chain");
  scene["fixed"] = Json::parse(R"([{"ids": [0]}])");
  scene["material"]["viscosity"] = 0;
  scene["integrator"] = "backward-euler";
  expect_exact(scene, "a chain that hangs, by an implicit method");
}

TEST(ScenePlan, IsExactInBytesForDrivenVerticesAndProbes) {
  Json scene = moving_box();
  scene["driven"] = Json::parse(R"([{"ids": [0, 1, 2], "velocity": [0.5, 0, 0]},
                                    {"ids": [5], "velocity": [0, 1, 0], "from": 0.005}])");
  scene["output"]["probes"] = Json::parse(R"([{"name": "a", "vertex": 3}, {"name": "b", "near": [0, 0, 0]}])");
  expect_exact(scene, "without a map");
  expect_exact(with_events(scene, one_removal), "on a map");
  EXPECT_GT(item(plan_scene(parse(scene)), Part::driven)->bytes, 0u);
  EXPECT_EQ(item(plan_scene(parse(scene)), Part::probes)->bytes, 8u);
}

TEST(ScenePlan, IsExactInBytesForFramesOfDisplacements) {
  for (const Body& body : bodies) {
    Json scene = with_body(moving_box(), body);
    scene["output"]["fields"] = {"displacement", "springs"};
    expect_exact(scene, std::string(body.name) + " without a map");
    expect_exact(with_events(scene, one_removal), std::string(body.name) + " on a map");
    const ScenePlan planned = plan_scene(parse(scene));
    EXPECT_EQ(item(planned, Part::rest)->bytes, 24 * planned.counts.vertices) << body.name;
    EXPECT_EQ(item(planned, Part::rest)->why, "/output/fields: frames show 'displacement'");
    EXPECT_EQ(item(planned, Part::frames)->what, "the cells where they are, displacements, springs");
  }
}

TEST(ScenePlan, IsExactInBytesForEveryIntegratorAndEveryTerm) {
  for (const IntegratorEntry& entry : integrators())
    for (const bool fixed : {false, true})
      for (const bool damping : {false, true})
        for (const bool viscosity : {false, true}) {
          Json scene = moving_box();
          scene["integrator"] = entry.name;
          scene["step"] = 1e-4;
          if (fixed) scene["fixed"] = Json::parse(R"([{"ids": [0, 1, 2, 3]}])");
          scene["material"]["damping"] = damping ? 0.25 : 0.0;
          scene["material"]["viscosity"] = viscosity ? 0.5 : 0.0;
          expect_exact(scene, std::string(entry.name) + (fixed ? " fixed" : "") + (damping ? " damped" : "") +
                                  (viscosity ? " viscous" : ""));
        }
}

TEST(ScenePlan, IsExactInBytesForEveryEvent) {
  for (const char* events :
       {R"([{"at": 0.005, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}])",
        R"([{"at": 0, "dissociate": {"points": [[0, 1, 13]]}}])",
        R"([{"every": 0.002, "remove": {"random": {"count": 3}}, "until": 0.01}])",
        R"([{"at": 0, "remove": {"sphere": {"centre": [0, 0, 0], "radius": 0.1}}}])",
        R"([{"at": 0.001, "tear": {"vertex": 13, "direction": [1, 0, 0]}}])",
        R"([{"tear_where_stressed": {"threshold": 1}}])",
        R"([{"tear_where_stressed": {"threshold": 1, "plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}])",
        R"([{"at": 0.002, "refine": {"cells": {"ids": [0, 5]}}}, {"at": 0.003, "remove": {"ids": [7]}}])"})
    expect_exact(with_events(moving_box(), events), events);
}

// ---- why

TEST(ScenePlan, NamesTheKeyThatAskedForEachThing) {
  Json scene = with_events(moving_box(), R"([{"at": 0.001, "tear": {"vertex": 0, "direction": [1, 0, 0]}}])");
  scene["fixed"] = Json::parse(R"([{"ids": [0, 1]}])");
  const ScenePlan planned = plan_scene(parse(scene));
  const auto why = [&planned](Part part) { return item(planned, part) ? item(planned, part)->why : ""; };
  EXPECT_NE(why(Part::map).find("/events/0/tear"), std::string::npos) << why(Part::map);
  EXPECT_NE(why(Part::map).find("tetrahedra alone"), std::string::npos) << why(Part::map);
  EXPECT_EQ(why(Part::damping), "/material/damping: 0.25");
  EXPECT_EQ(why(Part::viscosity), "/material/viscosity: 0.5");
  EXPECT_NE(why(Part::fixed).find("/fixed"), std::string::npos);
  EXPECT_EQ(why(Part::integrator), "/integrator: rk4 (the default)");
  EXPECT_EQ(why(Part::gravity), "/gravity: [0.0,0.0,-9.81] (the default)");
  EXPECT_EQ(why(Part::event), "/events/0/tear");
  scene["gravity"] = {1.5, -2.5, 3.5};
  EXPECT_EQ(item(plan_scene(parse(scene)), Part::gravity)->why, "/gravity: [1.5,-2.5,3.5]");
  for (const PlanItem& i : planned.items)
    EXPECT_TRUE(i.why.starts_with("/") || i.why.starts_with("always") || i.why.starts_with("changes of the map"))
        << name(i.part) << ": " << i.why;
}

TEST(ScenePlan, LeavesOutWhatNoKeyNeeds) {
  Json scene = moving_box();
  scene["material"]["damping"] = 0;
  scene["material"]["viscosity"] = 0;
  const ScenePlan bare = plan_scene(parse(scene));
  EXPECT_EQ(bare.map, "no map");
  EXPECT_TRUE(leaves_out(bare, "map", "/events: no event changes the topology"));
  EXPECT_TRUE(leaves_out(bare, "damping", "/material/damping: 0"));
  EXPECT_TRUE(leaves_out(bare, "viscosity", "/material/viscosity: 0"));
  EXPECT_TRUE(leaves_out(bare, "fixed", "/fixed: not given"));
  EXPECT_TRUE(leaves_out(bare, "Jacobian", "rk4 (the default) is explicit"));
  EXPECT_TRUE(leaves_out(bare, "stresses", "/events"));
  EXPECT_TRUE(leaves_out(bare, "places at rest", "/output/fields: without 'displacement'"));
  for (const Part part : {Part::map, Part::marks, Part::embeddings, Part::cell_darts, Part::viscosity, Part::fixed,
                          Part::rest, Part::damping, Part::solver, Part::event})
    EXPECT_EQ(item(bare, part), nullptr) << name(part);

  const ScenePlan cut = plan_scene(parse(with_events(moving_box(), one_removal)));
  EXPECT_TRUE(leaves_out(cut, "refinement", "/events: no event refines"));
  EXPECT_FALSE(leaves_out(cut, "map, marks", ""));
}

TEST(ScenePlan, ForeseesHowManyCellsAreRemoved) {
  const ScenePlan planned = plan_scene(parse(
      with_events(moving_box(), R"([{"every": 0.002, "from": 0.002, "until": 0.006, "remove": {"random": {"count": 4}}},
                        {"at": 0.01, "remove": {"plane": {"point": [0.125, 0, 0], "normal": [-1, 0, 0]}}}])")));
  EXPECT_EQ(planned.events[0].times, 3u);
  EXPECT_EQ(planned.events[0].operations, 12.0);
  EXPECT_EQ(planned.events[1].times, 1u);
  EXPECT_EQ(planned.events[1].operations, 24.0);  // half of the 48
}

// A vertex is torn off at every time of the event, a plane is cut at the first.
TEST(ScenePlan, ForeseesHowOftenAnEventDoesSomething) {
  const ScenePlan planned = plan_scene(parse(with_events(
      moving_box(), R"([{"every": 0.002, "from": 0.002, "until": 0.006, "tear": {"vertex": 0, "direction": [1, 0, 0]}},
                        {"every": 0.002, "from": 0.002, "until": 0.006, "remove": {"random": {"count": 4}}},
                        {"every": 0.002, "from": 0.002, "until": 0.006, "remove": {"ids": [3, 5]}}])")));
  EXPECT_EQ(planned.events[0].operations, 3.0);
  EXPECT_EQ(planned.events[1].operations, 12.0);
  EXPECT_EQ(planned.events[2].operations, 2.0);
}

// At every step from 0 on, and counted without iterating over them: there are too many times for that.
TEST(ScenePlan, CountsTheTimesOfAnEventWithoutEnd) {
  const std::uint64_t steps = std::uint64_t{1} << 42;
  SceneFile scene = parse(with_events(moving_box(), R"([{"from": 0, "until": 0.01, "remove": {"ids": [3]}}])"));
  scene.step = 0x1p-10;
  scene.duration = static_cast<double>(steps) * scene.step;
  scene.events[0].until = scene.duration;
  EXPECT_EQ(forecast_events(scene, {}, 48).at(0).times, steps + 1);
}

TEST(ScenePlan, CountsOneThingInTheSingular) {
  Json scene = with_events(moving_box(), R"([{"at": 0.005, "remove": {"ids": [3]}}])");
  scene["fixed"] = Json::parse(R"([{"ids": [0]}])");
  scene["driven"] = Json::parse(R"([{"ids": [26], "velocity": [0, 0, 1]}])");
  scene["output"] = Json::parse(R"({"probes": [{"name": "p", "vertex": 5}], "frames_every": {"steps": 1},
                                    "diagnostics_every": {"steps": 2}})");
  const ScenePlan planned = plan_scene(parse(scene));
  EXPECT_EQ(item(planned, Part::fixed)->why, "/fixed: 1 selection; /driven: 1");
  EXPECT_TRUE(item(planned, Part::driven)->what.starts_with("paths of 1 vertex, and "))
      << item(planned, Part::driven)->what;
  EXPECT_EQ(item(planned, Part::driven)->why, "/driven: 1 selection");
  EXPECT_EQ(item(planned, Part::event)->what, "remove, 1 time, some 1 operation");
  EXPECT_EQ(item(planned, Part::probes)->what, "1 vertex followed");
  EXPECT_EQ(item(planned, Part::frames)->why, "/output/frames_every: every step, the first and the last state");
  EXPECT_EQ(item(planned, Part::diagnostics)->why,
            "/output/diagnostics_every: every 2 steps, the first and the last state");
}

// ---- memory that no item plans

TEST(ScenePlan, TellsApartWhatNoItemPlans) {
  const SceneFile scene = parse(with_events(moving_box(), one_removal));
  const ScenePlan whole = plan_scene(scene);
  ScenePlan planned = whole;
  std::erase_if(planned.items, [](const PlanItem& i) { return i.part == Part::map; });
  for (PlanItem& item : planned.items) item.bytes = 0;
  add_bytes(planned, measured_memory(scene));
  EXPECT_EQ(planned.items[0].bytes, whole.items[1].bytes);
  ASSERT_EQ(planned.unplanned.size(), 1u);
  EXPECT_EQ(planned.unplanned[0].part, Part::map);
  EXPECT_EQ(planned.unplanned[0].bytes, whole.items[0].bytes);
  EXPECT_EQ(planned.bytes(), whole.bytes());
}

// ---- the same bits

TEST(ScenePlan, ChangesNoBitOfTheTrajectory) {
  const SceneFile scene = parse(with_events(moving_box(), R"([{"every": 0.003, "remove": {"random": {"count": 3}}}])"));
  const auto hash = [&scene](bool explained) {
    if (explained) plan_scene(scene);
    Simulation simulation(scene);
    while (simulation.steps_done() < simulation.step_count()) {
      simulation.advance();
      if (explained) simulation.memory();
    }
    return simulation.body().state_hash();
  };
  EXPECT_EQ(hash(false), hash(true));
}

TEST(ScenePlan, MovesABodyWithoutZeroColumnsWithTheBitsOfOneWithThem) {
  Json scene = moving_box();
  scene["material"]["damping"] = 0;
  scene["material"]["viscosity"] = 0;
  for (const IntegratorEntry& entry : integrators()) {
    const Problem problem = make_problem(parse(scene));
    const auto body = make_simulated_body(problem, false);
    ASSERT_TRUE(body->system().viscosity.empty());
    ASSERT_TRUE(body->system().fixed.empty());
    ASSERT_TRUE(body->system().springs.damped().empty());
    SpringSystem with_columns = body->system();
    const std::vector<double> viscosity(with_columns.vertex_count(), 0.0);
    const std::vector<std::uint8_t> fixed(with_columns.vertex_count(), 0);
    with_columns.viscosity = viscosity;
    with_columns.fixed = fixed;
    const std::vector<Spring> springs(body->system().springs.begin(), body->system().springs.end());
    with_columns.springs = springs;
    auto x = body->vertices().position, v = body->vertices().velocity;
    const auto bare = entry.make(), full = entry.make();
    for (int k = 0; k < 10; ++k) {
      ASSERT_TRUE(bare->step(body->system(), body->motion(), 1e-3).ok()) << entry.name;
      ASSERT_TRUE(full->step(with_columns, {x, v}, 1e-3).ok()) << entry.name;
    }
    EXPECT_EQ(x, body->vertices().position) << entry.name;
    EXPECT_EQ(v, body->vertices().velocity) << entry.name;
  }
}

}  // namespace
}  // namespace dartboard::scene_plan_test
