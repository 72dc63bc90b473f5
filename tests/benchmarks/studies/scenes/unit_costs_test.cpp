// From unit costs to the times of a plan: the number of times that each thing happens.

#include "benchmarks/studies/scenes/unit_costs.h"
#include "core/scene/file/scene_problem.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/statistics.h"
#include "core/scene/plan/system_arrays.h"
#include "core/time/system/accelerations.h"
#include "tests/support/moving_box.h"

namespace dartboard::unit_costs_test {
namespace {

using namespace moving;

double ns_of(const ScenePlan& plan, Part part) { return std::ranges::find(plan.items, part, &PlanItem::part)->ns; }

ScenePlan timed(const Json& json, const UnitCosts& costs) {
  const SceneFile scene = parse(json);
  ScenePlan plan = plan_scene(scene, make_problem(scene));
  add_times(plan, scene, costs);
  return plan;
}

TEST(UnitCosts, ChargeAForceEvaluationForEachStage) {
  const ScenePlan plan =
      timed(moving_box(), {.force = 10, .evaluations = 4, .damping = 3, .viscosity = 2, .stages = 5});
  EXPECT_EQ(ns_of(plan, Part::springs), 40);
  EXPECT_EQ(ns_of(plan, Part::damping), 3);
  EXPECT_EQ(ns_of(plan, Part::viscosity), 2);
  EXPECT_EQ(ns_of(plan, Part::integrator), 5);
  EXPECT_EQ(plan.ns(), 50);
}

TEST(UnitCosts, OfTermsThatNoiseHidesAreNotBelowZero) {
  // forces, the bare step, with viscosity, with damping: viscosity seems to save 5
  std::vector<double> ns{40, 52, 47, 60};
  EXPECT_EQ(make_ascending(ns), 5);
  EXPECT_EQ(ns, (std::vector<double>{40, 47, 47, 60}));
  std::vector<double> forces_alone{50, 48};
  EXPECT_EQ(make_ascending(forces_alone), 2);
  EXPECT_EQ(forces_alone, (std::vector<double>{48, 48}));
  const ScenePlan plan =
      timed(moving_box(), {.force = 10, .evaluations = 4, .damping = 13, .viscosity = 0, .stages = 7, .noise = 5});
  const auto item = std::ranges::find(plan.items, Part::viscosity, &PlanItem::part);
  EXPECT_EQ(item->ns, 0);
  EXPECT_EQ(item->ns_below, 5);
  EXPECT_EQ(std::ranges::find(plan.items, Part::damping, &PlanItem::part)->ns_below, 0);
  EXPECT_EQ(plan.ns(), 60);  // the time of a whole step is still known
}

TEST(UnitCosts, OfAStepAreWhatEachTermAddsToIt) {
  double UnitCosts::*const terms[]{&UnitCosts::fixed, &UnitCosts::damping};
  // four evaluations of 10, 20 for the rest of the step, then 3 for fixed vertices and 12 for damping
  const UnitCosts costs = step_costs(4, {10, 60, 63, 75}, terms);
  EXPECT_EQ(costs.evaluations, 4);
  EXPECT_EQ(costs.force, 10);
  EXPECT_EQ(costs.stages, 20);
  EXPECT_EQ(costs.fixed, 3);
  EXPECT_EQ(costs.damping, 12);
  EXPECT_EQ(costs.viscosity, 0);
  EXPECT_EQ(costs.noise, 0);
}

// Compared with the same evaluations timed here; a busy machine may take three times as long at one time as at another.
TEST(UnitCosts, OfAForceEvaluationAreItsTime) {
  const SceneFile scene = parse(moving_box());
  const Problem problem = make_problem(scene);
  const ScenePlan plan = plan_scene(scene, problem);
  const SystemArrays arrays(problem);
  std::vector<Eigen::Vector3d> a(arrays.x.size());
  std::vector<double> ns;
  for (int run = 0; run < 21; ++run) {
    const std::int64_t start = thread_cpu_ns();
    for (int k = 0; k < 100; ++k) accelerations(arrays.system(), {}, arrays.x, arrays.v, a);
    ns.push_back(static_cast<double>(thread_cpu_ns() - start) / 100);
  }
  const double ratio = measure_unit_costs(scene, problem, plan).force / median(ns);
  EXPECT_GT(ratio, 1.0 / 3.0);
  EXPECT_LT(ratio, 3.0);
}

TEST(UnitCosts, ChargeOutputAsOftenAsItIsDue) {
  Json scene = moving_box();  // ten steps
  scene["output"] = Json::parse(R"({"frames_every": {"steps": 4}})");
  const ScenePlan plan = timed(scene, {.frame = 100, .row = 10});
  EXPECT_EQ(ns_of(plan, Part::frames), 100 * 4 / 10.0);      // at 0, 4, 8 and 10
  EXPECT_EQ(ns_of(plan, Part::diagnostics), 10 * 2 / 10.0);  // at 0 and 10
}

TEST(UnitCosts, ChargeEventsByTheirTimesAndOperations) {
  // at 0, 4 and 8 of ten steps, 3 cells each
  const Json scene = with_events(moving_box(), R"([{"every": 0.004, "remove": {"random": {"count": 3}}}])");
  const ScenePlan plan = timed(scene, {.look = 50, .by_lot = 7, .remove = 20});
  const double cells = plan.mean.cells, springs = plan.mean.springs;
  EXPECT_DOUBLE_EQ(cells, (4 * 45 + 4 * 42 + 2 * 39) / 480.0);
  EXPECT_DOUBLE_EQ(ns_of(plan, Part::event), (3 * cells * 7 + 9 * 20) / 10.0);
  EXPECT_DOUBLE_EQ(ns_of(plan, Part::step_check), 3 / 10.0 * springs * 50);
}

TEST(UnitCosts, ChargeAWatchOnStressInEveryStep) {
  const ScenePlan plan =
      timed(with_events(moving_box(), R"([{"tear_where_stressed": {"threshold": 1}}])"), {.stress = 8});
  EXPECT_EQ(ns_of(plan, Part::event), 8 * 11 / 10.0);  // at the start and after each of ten steps
}

TEST(UnitCosts, AreMeasuredForWhatASceneHas) {
  for (const char* integrator : {"rk4", "verlet", "backward-euler"}) {
    Json json = with_events(moving_box(), R"([{"tear_where_stressed": {"threshold": 1e9}},
        {"at": 0.001, "remove": {"ids": [1]}}, {"at": 0.001, "tear": {"vertex": 13, "direction": [1, 0, 0]}},
        {"at": 0.002, "refine": {"cells": {"ids": [2]}}},
        {"at": 0.002, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}}])");
    json["integrator"] = integrator;
    const SceneFile scene = parse(json);
    const Problem problem = make_problem(scene);
    const UnitCosts costs = measure_unit_costs(scene, problem, plan_scene(scene, problem));
    // an implicit method has a cost as a whole
    for (const double cost :
         {costs.force + costs.solver, costs.detector, costs.speed_check, costs.look, costs.stress, costs.by_place,
          costs.across, costs.dissociate, costs.remove, costs.tear, costs.refine, costs.frame, costs.row})
      EXPECT_GT(cost, 0.0) << integrator;
  }
}

}  // namespace
}  // namespace dartboard::unit_costs_test
