// Scenes whose body is made of elements.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/scene/file/scene_problem.h"
#include "core/scene/plan/measured_plan.h"
#include "core/scene/plan/scene_plan.h"
#include "core/scene/run/scene_warnings.h"
#include "core/time/integrators.h"
#include "core/time/system/energy.h"
#include "tests/support/moving_box.h"
#include "tests/support/plan_memory.h"

namespace dartboard {
namespace {

using namespace moving;

// the same box of hexahedra, or of all kinds of cell
Json in_cells(Json scene, const char* kind) {
  scene["body"]["generate"]["box"]["kind"] = kind;
  return scene;
}

Json of_elements(const char* model = nullptr) {
  Json scene = moving_box();
  scene["material"] = Json::parse(R"({"density": 768, "young": 2e4, "poisson": 0.3, "viscosity": 0.5})");
  if (model) scene["material"]["model"] = model;
  return scene;
}
constexpr const char* models[] = {"neo-hookean", "corotational", "stvk"};

TEST(ElementScene, IsNeoHookeanUnlessItSaysOtherwise) {
  EXPECT_EQ(parse(of_elements()).material.model, Model::neo_hookean);
  EXPECT_EQ(parse(of_elements()).material.stiffness, 0.0);  // not what springs have by default
  EXPECT_EQ(parse(of_elements()).material.damping, 0.0);
  EXPECT_EQ(parse(of_elements("corotational")).material.model, Model::corotational);
  EXPECT_EQ(parse(of_elements("stvk")).material.model, Model::stvk);
  EXPECT_EQ(parse(moving_box()).material.model, Model::springs);
  Json springs = moving_box();
  springs["material"]["model"] = "springs";
  EXPECT_EQ(parse(springs).material.model, Model::springs);
  EXPECT_EQ(parse(springs).material.stiffness, 64.0);
}

TEST(ElementScene, NamesTheKeyOfAMaterialThatIsNone) {
  const auto with = [](const char* key, const Json& value) {
    Json scene = of_elements();
    scene["material"][key] = value;
    return refusal(scene);
  };
  EXPECT_EQ(with("poisson", 0.5), "file: /material/poisson: is 0.5; expected a number >= -0.99 and <= 0.4999");
  EXPECT_EQ(
      with("model", "springs"),
      "file: /material/poisson: stands beside the model \"springs\", which have a ratio of 1/4, or 1/3 in a surface; "
      "expected another model, or no 'poisson'");
  EXPECT_EQ(with("stiffness", 3), "file: /material: has 'stiffness', 'young'; expected at most one of them");
  EXPECT_EQ(with("damping", 3), "file: /material: has 'poisson', 'damping'; expected 'poisson' without the others");
  Json scene = of_elements();
  scene["material"].erase("young");
  EXPECT_EQ(refusal(scene), "file: /material/poisson: stands beside no 'young'; expected Young's modulus beside it");
  scene = of_elements("stvk");
  scene["material"].erase("poisson");
  EXPECT_EQ(refusal(scene),
            "file: /material/model: is \"stvk\" beside no 'poisson'; expected 'young' and 'poisson' beside it");
  scene = of_elements();
  scene["body"] = Json::parse(R"({"generate": {"sheet": {"cells": [2, 2], "spacing": 1}}})");
  EXPECT_EQ(refusal(scene), "file: /material/poisson: stands beside /body/generate/sheet; expected solid cells");
  scene = of_elements();
  scene.erase("step");
  scene["accuracy"] = 1e-3;
  EXPECT_EQ(refusal(scene),
            "file: /accuracy: stands beside /material/poisson: the codes it compares with know springs "
            "alone; expected 'step' in its place");
}

// The view and the columns are two ways to hold one body.
TEST(ElementScene, MovesABodyWithTheSameBitsOnAMapAndWithout) {
  for (const Json& scene : {of_elements("neo-hookean"), of_elements("corotational"), of_elements("stvk"),
                            in_cells(of_elements(), "hexahedra"), in_cells(of_elements("corotational"), "mixed")}) {
    const std::string model = scene.dump();
    Simulation still(parse(scene)), on_map(parse(with_events(scene, R"([{"at": 0.01, "remove": {"ids": [3]}}])")));
    for (int n = 0; n < 9; ++n) {
      ASSERT_FALSE(still.advance());
      ASSERT_FALSE(on_map.advance());
    }
    EXPECT_EQ(still.body().map_name(), "no map");
    EXPECT_EQ(still.body().state_hash(), on_map.body().state_hash()) << model;
    EXPECT_EQ(still.body().largest_stress(), on_map.body().largest_stress()) << model;
  }
}

// Let go at once, a bar that hangs by its top sinks until a wave has come back from there: its foot is lowest after
// 2 L / c, by rho g L^2 / E, twice what it hangs by at rest. Poisson's ratio 0 makes it one-dimensional.
TEST(ElementScene, LetsABarSinkAsTheWaveInItHasIt) {
  const double young = 1e6, length = 1.0, speed = std::sqrt(young / 1000.0);
  for (const char* model : models) {
    Json scene = Json::parse(R"({"name": "bar", "gravity": [0, 0, -9.81], "integrator": "blanes-moan-4",
      "body": {"generate": {"box": {"cells": [1, 1, 20], "spacing": 0.05}}},
      "fixed": [{"plane": {"point": [0, 0, 0.999], "normal": [0, 0, 1]}}],
      "material": {"density": 1000, "young": 1e6, "poisson": 0, "viscosity": 0}})");
    scene["material"]["model"] = model;
    scene["step"] = 2.0 * length / speed / 2000;
    scene["duration"] = 2.0 * length / speed;
    Simulation simulation(parse(scene));
    run(simulation);
    double foot = 0.0;
    for (const Eigen::Vector3d& x : simulation.body().vertices().position) foot = std::min(foot, x[2]);
    const double sinks = 1000.0 * 9.81 * length * length / young;
    // twenty elements along the wave, and strains of 1 %
    EXPECT_NEAR(foot / -sinks, 1.0, 0.01) << model;
  }
}

TEST(ElementScene, CarriesOnThroughEveryEventAndEveryIntegrator) {
  const char* events = R"([{"at": 0.002, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}},
    {"at": 0.003, "tear": {"vertex": 13, "direction": [0, 1, 0]}}, {"at": 0.004, "remove": {"random": {"count": 3}}},
    {"at": 0.005, "refine": {"cells": {"random": {"count": 2}}}}, {"from": 0.006, "tear_where_stressed": {"threshold": 100}}])";
  for (const char* model : models)
    for (const IntegratorEntry& entry : integrators()) {
      Json scene = with_events(of_elements(model), events);
      scene["integrator"] = entry.name;
      scene["step"] = entry.name == std::string("euler") ? 1e-5 : 2e-4;
      Simulation simulation(parse(scene));
      const double before = simulation.body().mass();
      while (simulation.steps_done() < simulation.step_count()) {
        const auto stopped = simulation.advance();
        ASSERT_FALSE(stopped) << entry.name << ", " << model;
      }
      EXPECT_EQ(simulation.body().violation(), "");
      EXPECT_NEAR(simulation.body().mass() + simulation.body().removed_mass(), before, 1e-12 * before);
      EXPECT_GT(simulation.operations(), 10u);
    }
}

TEST(ElementScene, IsTornByTheStressOfItsElements) {
  for (const char* model : models) {
    const Json scene = with_events(of_elements(model), R"([{"tear_where_stressed": {"threshold": 50}}])");
    Simulation simulation(parse(scene));
    run(simulation);
    EXPECT_GT(simulation.operations(), 0u) << model;
  }
}

// Elements hold the shape of every kind of cell; springs on edges do not.
TEST(ElementScene, IsNotWarnedOfShapesThatSpringsDoNotHold) {
  const auto warnings = [](const Json& json) {
    const SceneFile scene = parse(json);
    return warnings_of(scene, Simulation(scene));
  };
  Json elements = in_cells(of_elements(), "hexahedra"), springs = in_cells(moving_box(), "hexahedra");
  const auto of_shape = [&](const Json& json) {
    return std::ranges::count_if(warnings(json),
                                 [](const std::string& w) { return w.find("change their shape") != w.npos; });
  };
  EXPECT_EQ(of_shape(springs), 1);
  EXPECT_EQ(of_shape(elements), 0);
}

TEST(ElementScene, IsPlannedToTheByte) {
  for (const char* events : {"[]", R"([{"at": 0.005, "remove": {"ids": [3]}}])"})
    for (const char* kind : {"tetrahedra", "mixed"}) {
      const char* integrator = "backward-euler";
      Json json = with_events(in_cells(of_elements(), kind), events);
      json["integrator"] = integrator;
      const SceneFile scene = parse(json);
      const Problem problem = make_problem(scene);
      ScenePlan plan = plan_scene(scene, problem);
      add_bytes(plan, measured_memory(scene));
      bool has_elements = false;
      for (const PlanItem& item : plan.items) {
        has_elements = has_elements || item.part == Part::elements;
        if (item.part == Part::elements || item.part == Part::springs || item.part == Part::cells) {
          EXPECT_EQ(item.bytes, memory::predicted_bytes(scene, problem, plan, item)) << name(item.part);
        }
      }
      EXPECT_TRUE(has_elements);
      EXPECT_TRUE(plan.unplanned.empty()) << name(plan.unplanned.front().part);
    }
}

}  // namespace
}  // namespace dartboard
