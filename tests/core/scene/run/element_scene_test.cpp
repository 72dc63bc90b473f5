// Scenes whose body is made of elements.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/scene/file/scene_problem.h"
#include "core/scene/plan/scene_plan.h"
#include "core/time/integrators.h"
#include "core/time/system/energy.h"
#include "tests/support/bodies/surveys_for_tests.h"
#include "tests/support/moving_box.h"
#include "tests/support/plan_memory.h"

namespace dartboard::element_scene_test {
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

// F = I + L / 2, det F = 1.11653: the largest eigenvalue of P F' / det F, by numpy.
TEST(ElementScene, HasCauchysStressInAUniformStrain) {
  const std::pair<const char*, double> expected[] = {
      {"neo-hookean", 16497.0}, {"corotational", 16929.0}, {"stvk", 20757.0}};
  for (const char* kind : {"tetrahedra", "hexahedra", "mixed"})
    for (const auto& [model, stress] : expected) {
      Json scene = in_cells(of_elements(model), kind);
      scene["material"]["young"] = 1e5;
      scene.erase("initial_velocity");
      scene["driven"] = Json::parse(R"([{"box": {"min": [-1, -1, -1], "max": [1, 1, 1]},
        "velocity": {"linear": [[0.2, 0.1, 0], [0.05, -0.1, 0.1], [0, 0.2, 0.15]]}}])");
      scene["step"] = 0.0625;
      scene["duration"] = 0.5;
      Simulation simulation(parse(scene));
      run(simulation);
      EXPECT_NEAR(simulation.body().largest_stress(), stress, 1.0) << kind << " " << model;
    }
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
      "file: /material/poisson: cannot be combined with the model \"springs\", which have a ratio of 1/4, or 1/3 in a "
      "surface; expected another model, or no 'poisson'");
  EXPECT_EQ(with("stiffness", 3), "file: /material: has 'stiffness', 'young'; expected at most one of them");
  EXPECT_EQ(with("damping", 3), "file: /material/damping: is 3 together with 'poisson'; expected an object (damping)");
  Json scene = of_elements();
  scene["material"].erase("young");
  EXPECT_EQ(refusal(scene),
            "file: /material/poisson: is given without 'young'; expected Young's modulus together with it");
  scene = of_elements("stvk");
  scene["material"].erase("poisson");
  EXPECT_EQ(refusal(scene),
            "file: /material/model: is \"stvk\" without 'poisson'; expected 'young' and 'poisson' together with it");
  scene = of_elements();
  scene["body"] = Json::parse(R"({"generate": {"chain": {"links": 2, "spacing": 1}}})");
  EXPECT_EQ(refusal(scene), "file: /material/poisson: cannot be combined with /body/generate/chain; expected cells");
}

Json damped(Json scene, double ratio = 0.05, double frequency = 4.0) {
  scene["material"]["damping"] = {{"ratio", ratio}, {"frequency", frequency}};
  return scene;
}

// tau = ratio / (pi f)
TEST(ElementScene, IsDampedByARatioAtAFrequency) {
  EXPECT_EQ(parse(of_elements()).material.damping_time, 0.0);
  EXPECT_DOUBLE_EQ(parse(damped(of_elements())).material.damping_time, 0.05 / (4.0 * std::acos(-1.0)));
  EXPECT_EQ(parse(damped(of_elements())).material.damping, 0.0);
  EXPECT_EQ(parse(moving_box()).material.damping_time, 0.0);
  const auto with = [](const char* damping) {
    Json scene = of_elements();
    scene["material"]["damping"] = Json::parse(damping);
    return refusal(scene);
  };
  EXPECT_EQ(with(R"({"ratio": 0, "frequency": 1})"), "accepted");
  EXPECT_EQ(with(R"({"ratio": 0.1})"), "file: /material/damping/frequency: is missing; expected a number > 0 [Hz]");
  EXPECT_EQ(with(R"({"ratio": -0.1, "frequency": 1})"),
            "file: /material/damping/ratio: is -0.1; expected a number >= 0");
  EXPECT_EQ(with(R"({"ratio": 1, "frequency": 1e-12})"),
            "file: /material/damping: has a ratio / (pi frequency) of 3.18e+11 s; expected at most 1e+09 s");
  EXPECT_EQ(with("\"much\""),
            "file: /material/damping: is \"much\" together with 'poisson'; expected an object (damping)");
  EXPECT_EQ(refusal(damped(moving_box())),
            "file: /material/damping: is an object with 2 keys without 'poisson'; expected a number of N s/m of each "
            "spring, or elements");
  Json scene = damped(of_elements());
  scene["material"]["viscosity"] = 0;
  scene["expect"]["energy_drift_at_most"] = 1e-3;
  EXPECT_EQ(refusal(scene),
            "file: /expect/energy_drift_at_most: cannot be combined with /material/damping, which changes the energy; "
            "expected damping and viscosity of 0, no driven vertices or events, and constant forces from start to end");
}

// Regions are of materials of their own, damped or not; the remaining energy shows it.
TEST(ElementScene, DampsEveryRegionAsItsMaterialSays) {
  const auto left = [](double ratio_of_all, double ratio_of_half) {
    Json scene = damped(of_elements(), ratio_of_all);
    scene["gravity"] = {0, 0, 0};
    scene["material"]["viscosity"] = 0;
    scene["step"] = 5e-4;
    Json half = scene["material"];
    half.erase("viscosity");
    half["damping"]["ratio"] = ratio_of_half;
    scene["regions"] =
        Json::array({{{"cells", {{"plane", {{"point", {0.125, 0, 0}}, {"normal", {1, 0, 0}}}}}}, {"material", half}}});
    Simulation simulation(parse(scene));
    run(simulation);
    const auto& vertices = simulation.body().vertices();
    return total_energy(simulation.body().system(), vertices.position, vertices.velocity);
  };
  const double none = left(0, 0), one = left(0.2, 0), other = left(0, 0.2), both = left(0.2, 0.2);
  EXPECT_LT(one, 0.97 * none);
  EXPECT_LT(other, 0.97 * none);
  EXPECT_LT(both, 0.98 * one);
  EXPECT_LT(both, 0.98 * other);
}

TEST(ElementScene, IsToldToBeDampedOrNot) {
  const auto plan = [](const Json& json) {
    const SceneFile scene = parse(json);
    return plan_scene(scene);
  };
  const ScenePlan with = plan(damped(of_elements(), 0.05, 2.0)), without = plan(of_elements()),
                  springs = plan(moving_box());
  const auto item = [](const ScenePlan& p) { return std::ranges::find(p.items, Part::cell_damping, &PlanItem::part); };
  ASSERT_NE(item(with), with.items.end());
  EXPECT_EQ(item(with)->why, "/material/damping: a ratio of 0.05 at 2 Hz");
  EXPECT_EQ(item(without), without.items.end());
  EXPECT_EQ(item(springs), springs.items.end());
  const auto left_out = [](const ScenePlan& p) {
    return std::ranges::count_if(p.left_out, [](const LeftOut& l) {
      return l.what == "damping of elements, its term or sweep" && l.why == "/material: without 'damping'";
    });
  };
  EXPECT_EQ(left_out(with), 0);
  EXPECT_EQ(left_out(without), 1);
  EXPECT_EQ(left_out(springs), 0);
}

// The view and the columns are two ways to hold one body.
TEST(ElementScene, MovesABodyWithTheSameBitsOnAMapAndWithout) {
  for (const Json& scene : {of_elements("neo-hookean"), of_elements("corotational"), of_elements("stvk"),
                            in_cells(of_elements(), "hexahedra"), in_cells(of_elements("corotational"), "mixed"),
                            damped(of_elements()), damped(in_cells(of_elements(), "mixed"))}) {
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

// Released at once, a bar that hangs by its top sinks until a wave has come back from there: its foot is lowest after 2
// L / c, by rho g L^2 / E, twice its extension at rest. Poisson's ratio 0 makes it one-dimensional.
TEST(ElementScene, LetsABarSinkAsTheWaveInItHasIt) {
  const double young = 1e6, length = 1.0, speed = std::sqrt(young / 1000.0);
  for (const char* model : models) {
    Json scene = Json::parse(R"({"name": "bar", "gravity": [0, 0, -9.81], "integrator": "blanes-moan-4",
      "body": {"generate": {"box": {"cells": [1, 1, 20], "spacing": 0.05, "pattern": "kuhn"}}},
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
  for (const char* model : {"neo-hookean", "corotational", "stvk", "damped"})
    for (const IntegratorEntry& entry : integrators()) {
      const bool is_damped = std::string(model) == "damped";
      Json scene = with_events(is_damped ? damped(of_elements()) : of_elements(model), events);
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
    return warnings_before_run(scene);
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
    for (const char* kind : {"tetrahedra", "mixed"})
      for (const char* integrator : {"backward-euler", "verlet"})
        for (const bool is_damped : {false, true}) {
          Json json = with_events(in_cells(of_elements(), kind), events);
          json["integrator"] = integrator;
          if (is_damped) json = damped(json);
          const SceneFile scene = parse(json);
          const Problem problem = make_problem(scene);
          ScenePlan plan = plan_scene(scene);
          bool has_elements = false;
          for (const PlanItem& item : plan.items) {
            has_elements = has_elements || item.part == Part::elements;
            const bool looked_at = item.part == Part::elements || item.part == Part::springs ||
                                   item.part == Part::cells || item.part == Part::cell_damping ||
                                   (item.part == Part::integrator && std::string(integrator) == "verlet");
            if (looked_at) {
              EXPECT_EQ(item.bytes, memory::predicted_bytes(scene, problem, plan, item)) << name(item.part);
            }
          }
          EXPECT_TRUE(has_elements);
          EXPECT_TRUE(plan.unplanned.empty()) << name(plan.unplanned.front().part);
        }
}

// 1e9 m from the origin the 0.125 m of an edge are rounded by 1.8e-6 of themselves: a warning before the first step.
TEST(ElementScene, IsToldWhereItsCoordinatesAreTooCoarse) {
  for (const char* kind : {"tetrahedra", "hexahedra", "mixed"}) {
    Json scene = in_cells(of_elements(), kind);
    scene.erase("initial_velocity");  // which turns it around where it was
    const auto warnings = [&] { return warnings_before_run(parse(scene)); };
    EXPECT_TRUE(warnings().empty()) << kind;
    scene["body"]["translate"] = {0, -1e9, 0};
    ASSERT_EQ(warnings().size(), 1u) << kind;
    EXPECT_NE(warnings()[0].find("coordinate y = -1e+09 m"), std::string::npos) << warnings()[0];
    EXPECT_NE(warnings()[0].find("of the shortest edge of an element next to it"), std::string::npos) << warnings()[0];
    EXPECT_NE(warnings()[0].find("move the body to the origin (/body/translate)"), std::string::npos) << warnings()[0];
  }
}

// In their centres, or in edges that no other cell has: of this box every edge of a tetrahedron is one of a prism or a
// pyramid, until its children have some of their own.
TEST(ElementScene, RefinesTetrahedraAmongOtherCells) {
  for (const Json& material : {of_elements()["material"], moving_box()["material"]}) {
    Json scene = in_cells(moving_box(), "mixed");
    scene["material"] = material;
    scene["body"]["generate"]["box"]["cells"] = {2, 2, 2};
    const std::string at_centre = R"({"at": 0, "refine": {"cells": {"box": {"min": [-1, -1, -1], "max": [1, 1, 1]}},
                                                          "at": "centre"}})";
    const SceneFile before = parse(scene);
    const Simulation whole(before);
    std::size_t tetrahedra = 0;
    const Mesh mesh = make_problem(before).mesh;
    for (const CellKind kind : mesh.kinds) tetrahedra += kind == CellKind::tetrahedron;
    ASSERT_GT(tetrahedra, 0u);
    Simulation refined(parse(with_events(scene, ("[" + at_centre + "]").c_str())));
    EXPECT_EQ(cells(refined), mesh.cell_count() + 3 * tetrahedra);
    EXPECT_NEAR(refined.body().mass(), whole.body().mass(), 1e-12 * whole.body().mass());
    EXPECT_EQ(refined.body().violation(), "");
    run(refined);
    const std::string longest = refusal(
        with_events(scene, R"([{"at": 0, "refine": {"cells": {"box": {"min": [-1, -1, -1], "max": [1, 1, 1]}}}}])"));
    EXPECT_TRUE(longest.starts_with("file: /events/0/refine/at: is \"longest edge\", and that of cell ")) << longest;
    EXPECT_TRUE(
        longest.ends_with("belongs to a cell that is no tetrahedron, too; expected \"centre\", or cells whose "
                          "longest edge tetrahedra alone have"))
        << longest;
  }
}

TEST(ElementScene, NamesTheFileAndTheEventThatIsRefusedWhenItIsDue) {
  Json scene = in_cells(moving_box(), "mixed");
  scene["body"]["generate"]["box"]["cells"] = {2, 2, 2};
  Simulation simulation(parse(
      with_events(scene, R"([{"at": 0.002, "refine": {"cells": {"box": {"min": [-1, -1, -1], "max": [1, 1, 1]}}}}])")));
  EXPECT_FALSE(simulation.advance());
  try {
    (void)simulation.advance();
    ADD_FAILURE() << "taken";
  } catch (const InputError& error) {
    EXPECT_TRUE(std::string_view(error.what()).starts_with("file: /events/0/refine/at: is \"longest edge\""))
        << error.what();
  }
}

// Two bodies, one of tetrahedra and one of hexahedra: the first has edges of its own.
TEST(ElementScene, RefinesABodyOfTetrahedraBesideOneOfHexahedra) {
  Json scene = of_elements();
  const Json box = scene["body"];
  scene.erase("body");
  Json other = in_cells(of_elements(), "hexahedra")["body"];
  other["translate"] = {1, 0, 0};
  scene["bodies"] = {box, other};
  const std::size_t before = cells(Simulation(parse(scene)));
  Simulation refined(parse(
      with_events(scene, R"([{"at": 0, "refine": {"cells": {"box": {"min": [-1, -1, -1], "max": [9, 9, 9]}}}}])")));
  EXPECT_EQ(before, 48u + 8u);
  EXPECT_GE(cells(refined), 2 * 48u + 8u);  // each tetrahedron was halved, itself or with a neighbour
  EXPECT_EQ(refined.body().violation(), "");
  run(refined);
}

}  // namespace
}  // namespace dartboard::element_scene_test
