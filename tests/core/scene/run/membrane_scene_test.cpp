// Scenes whose body is a surface of membranes.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/mechanics/mass_spring_body.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/plan/scene_plan.h"
#include "core/time/integrators.h"
#include "tests/support/moving_box.h"
#include "tests/support/plan_memory.h"
#include "tests/support/run_in_memory.h"

namespace dartboard::membrane_scene_test {
namespace {

using namespace moving;
using namespace recorded;

/// A sheet of 4 x 3 squares that moves.
Json sheet(const char* kind,
           const char* material = R"({"density": 2, "young": 200, "poisson": 0.3, "viscosity": 0.5})") {
  Json scene = moving_box();
  scene["body"] = Json::parse(R"({"generate": {"sheet": {"cells": [4, 3], "spacing": 0.125}}})");
  scene["body"]["generate"]["sheet"]["kind"] = kind;
  scene["material"] = Json::parse(material);
  return scene;
}
Json with(Json scene, const char* key, const char* value) {
  scene[key] = Json::parse(value);
  return scene;
}
/// One half of membranes, one of springs.
Json half_of_springs(const char* kind) {
  return with(sheet(kind), "regions", R"([{"cells": {"box": {"min": [0, 0, -1], "max": [0.25, 1, 1]}},
                                           "material": {"density": 3, "stiffness": 20, "damping": 0.01}}])");
}
Json eventful(const Json& scene) {
  return with_events(scene, R"([
    {"at": 0.002, "dissociate": {"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]}}},
    {"at": 0.004, "remove": {"random": {"count": 3}}}])");
}
Json corotational(Json scene) {
  scene["material"]["model"] = "corotational";
  return scene;
}
/// Cells of both kinds, of either law, without loss of energy.
std::vector<Json> undamped() {
  const char* material = R"({"density": 2, "young": 200, "poisson": 0.3, "viscosity": 0})";
  return {sheet("triangles", material), sheet("quadrilaterals", material), corotational(sheet("triangles", material)),
          corotational(sheet("quadrilaterals", material))};
}
/// All models that a surface may have.
std::vector<Json> all_kinds() {
  return {sheet("triangles"),
          corotational(sheet("triangles")),
          corotational(half_of_springs("quadrilaterals")),
          sheet("quadrilaterals"),
          half_of_springs("triangles"),
          with(half_of_springs("quadrilaterals"), "diagonals", R"("faces")"),
          with(sheet("triangles"), "bending", R"({"rigidity": 0.25})"),
          with(sheet("quadrilaterals"), "bending", R"({"second_neighbours": 32})")};
}

TEST(MembraneScene, IsOfStVenantAndKirchhoffUnlessItIsOfSprings) {
  for (const char* kind : {"triangles", "quadrilaterals"}) {
    Json scene = sheet(kind);
    EXPECT_EQ(make_problem(parse(scene)).material.model, Model::stvk);
    EXPECT_EQ(Simulation(parse(scene)).body().system().springs.size(), 0u);
    scene["material"]["model"] = "stvk";
    EXPECT_EQ(make_problem(parse(scene)).material.model, Model::stvk);
    scene["material"]["model"] = "corotational";
    EXPECT_EQ(make_problem(parse(scene)).material.model, Model::corotational);
  }
  Json springs = sheet("triangles");
  springs["material"].erase("poisson");
  EXPECT_EQ(make_problem(parse(springs)).material.model, Model::springs);
  // a box is unchanged
  Json box = moving_box();
  box["material"] = sheet("triangles")["material"];
  EXPECT_EQ(make_problem(parse(box)).material.model, Model::neo_hookean);
}

TEST(MembraneScene, NamesTheKeyOfAModelThatSurfacesDoNotHave) {
  const std::string has_not =
      "material/model: is \"neo-hookean\", and the body is a surface; expected \"stvk\", \"corotational\" or \"springs\"";
  Json scene = sheet("triangles");
  scene["material"]["model"] = "neo-hookean";
  EXPECT_EQ(refusal(scene), "file: /" + has_not);
  Json region = half_of_springs("quadrilaterals");
  region["regions"][0]["material"] = Json::parse(R"({"young": 200, "poisson": 0.3})");
  EXPECT_EQ(refusal(region), "accepted");
  region["regions"][0]["material"]["model"] = "neo-hookean";
  EXPECT_EQ(refusal(region), "file: /regions/0/" + has_not);
  Json chain = sheet("triangles");
  chain["body"] = Json::parse(R"({"generate": {"chain": {"links": 3, "spacing": 1}}})");
  EXPECT_EQ(refusal(chain), "file: /material/poisson: cannot be combined with /body/generate/chain; expected cells");
}

TEST(MembraneScene, HasNoDampingRatioThatNothingWouldTake) {
  Json scene = sheet("triangles");
  scene["material"]["damping"] = Json::parse(R"({"ratio": 0.1, "frequency": 2})");
  EXPECT_EQ(refusal(scene),
            "file: /material/damping: is a ratio at a frequency, and the body is a surface; expected no such key: "
            "only 'viscosity' damps membranes");
  Problem problem;
  problem.mesh = triangle_sheet(1, 1, 0.1);
  problem.material = {.stiffness = 0, .damping = 0, .young = 1, .model = Model::stvk, .damping_time = 0.1};
  EXPECT_THROW((build_body<Map2, Held::by_every_dart>(problem)), InputError);
}

// The view and the columns are two ways to hold one body.
TEST(MembraneScene, MovesABodyWithTheSameBitsOnAMapAndWithout) {
  for (const Json& scene : all_kinds()) {
    Simulation still(parse(scene)), on_map(parse(with_events(scene, R"([{"at": 0.01, "remove": {"ids": [3]}}])")));
    for (int n = 0; n < 9; ++n) {
      ASSERT_FALSE(still.advance());
      ASSERT_FALSE(on_map.advance());
    }
    EXPECT_EQ(still.body().map_name(), "no map");
    EXPECT_EQ(on_map.body().map_name(), "2-g-map");
    EXPECT_EQ(still.body().state_hash(), on_map.body().state_hash()) << scene.dump();
    EXPECT_EQ(still.body().largest_stress(), on_map.body().largest_stress()) << scene.dump();
    EXPECT_GT(still.body().largest_stress(), 0.1);
  }
}

// Released at once, a strip that hangs by its top sinks until a wave has come back from there: its foot is lowest after
// 2 L / c, c^2 = Y / rho, by rho g L^2 / Y, twice its extension at rest. Poisson's ratio 0 makes it one-dimensional.
TEST(MembraneScene, LetsAStripSinkAsTheWaveInItHasIt) {
  const double young = 2000.0, density = 2.0, length = 1.0, speed = std::sqrt(young / density);
  for (const Json& kind : undamped()) {
    Json scene = Json::parse(R"({"name": "strip", "gravity": [0, -9.81, 0], "integrator": "blanes-moan-4",
      "body": {"generate": {"sheet": {"cells": [2, 20], "spacing": 0.05}}},
      "fixed": [{"plane": {"point": [0, 0.999, 0], "normal": [0, 1, 0]}}],
      "material": {"density": 2, "young": 2000, "poisson": 0, "viscosity": 0}})");
    scene["body"]["generate"]["sheet"]["kind"] = kind["body"]["generate"]["sheet"]["kind"];
    if (kind["material"].contains("model")) scene = corotational(scene);
    scene["step"] = 2.0 * length / speed / 1000;
    scene["duration"] = 2.0 * length / speed;
    Simulation simulation(parse(scene));
    run(simulation);
    double foot = 0.0;
    for (const Eigen::Vector3d& x : simulation.body().vertices().position) foot = std::min(foot, x[1]);
    const double sinks = density * 9.81 * length * length / young;
    // twenty rows along the wave, and strains of 1 %
    EXPECT_NEAR(foot / -sinks, 1.0, 0.02) << kind.dump();
  }
}

// The error of a fourth order method in the energy goes with the fourth power of the step: with half the step, it is a
// sixteenth, up to terms of higher orders.
TEST(MembraneScene, KeepsItsEnergyToTheOrderOfTheIntegrator) {
  for (const Json& kind : undamped()) {
    const auto worst = [&kind](double step) {
      Json scene = kind;
      scene["integrator"] = "blanes-moan-4";
      scene["initial_velocity"] = Json::parse(R"({"linear": [[0.5, 0, 2], [1, 0, 0], [3, -2, 0]]})");
      scene["duration"] = 0.256;
      scene["step"] = step;
      Simulation simulation(parse(scene));
      const double start = simulation.diagnostics().energy();
      double largest = 0.0;
      while (simulation.steps_done() < simulation.step_count()) {
        EXPECT_FALSE(simulation.advance());
        largest = std::max(largest, std::abs(simulation.diagnostics().energy() - start));
      }
      EXPECT_GT(simulation.diagnostics().elastic, 1e-3);
      return largest;
    };
    const double ratio = worst(0.004) / worst(0.002);
    EXPECT_NEAR(std::log2(ratio), 4.0, 0.4) << kind.dump();
  }
}

// The body loses no energy, not even by a cut.
TEST(MembraneScene, KeepsTheEnergyOfAFreeBodyThatIsCut) {
  for (Json scene : undamped()) {
    scene["integrator"] = "energy-momentum";
    scene["gravity"] = {0, 0, 0};
    scene["initial_velocity"] = Json::parse(R"({"linear": [[0, 0, 2], [1, 0, 0], [3, -2, 0]]})");
    scene =
        with_events(scene, R"([{"at": 0.005, "dissociate": {"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]}}}])");
    Simulation simulation(parse(scene));
    const Diagnostics first = simulation.diagnostics();
    run(simulation);
    const Diagnostics last = simulation.diagnostics();
    EXPECT_EQ(simulation.operations(), 3u);
    EXPECT_GT(last.elastic, 1e-6 * first.kinetic);
    // ten steps, each to some roundings of the present energy
    EXPECT_NEAR(last.energy(), first.energy(), 1e-13 * first.kinetic);
    EXPECT_LE((last.angular_momentum - first.angular_momentum).norm(), 1e-12 * first.angular_momentum.norm());
  }
}

/// The momentum of each component.
std::vector<Eigen::Vector3d> momenta(const Simulation& simulation) {
  const Frame frame = simulation.frame();
  std::vector<std::uint32_t> part(frame.mesh.points.size());
  for (std::size_t c = 0; c < frame.mesh.cell_count(); ++c)
    for (const std::uint32_t k : frame.mesh.cell(c)) part[k] = frame.component[c];
  std::vector<Eigen::Vector3d> sums(simulation.body().counts().components, Eigen::Vector3d(0, 0, 0));
  for (std::size_t k = 0; k < part.size(); ++k) sums[part[k]] += frame.mass[k] * frame.velocity[k];
  return sums;
}

// Membranes of one half do not depend on the vertices of the other.
TEST(MembraneScene, LetsTwoPartsFlyOnTheirOwn) {
  for (Json scene : undamped()) {
    scene["gravity"] = {0, 0, 0};
    scene["initial_velocity"] = Json::parse(R"({"linear": [[5, 0, 0], [0, 0, 0], [9, 4, 0]]})");
    scene = with_events(scene, R"([{"at": 0, "dissociate": {"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]}}}])");
    Simulation simulation(parse(scene));
    const auto before = momenta(simulation);
    run(simulation);
    const auto after = momenta(simulation);
    ASSERT_EQ(before.size(), 2u);
    for (std::size_t part = 0; part < 2; ++part)
      EXPECT_LE((after[part] - before[part]).norm(), 1e-13 * before[part].norm()) << scene.dump();
    EXPECT_GT(simulation.diagnostics().elastic, 1e-3);
  }
}

TEST(MembraneScene, CarriesOnThroughEveryEventAndEveryIntegrator) {
  for (const Json& kind : all_kinds())
    for (const IntegratorEntry& entry : integrators()) {
      Json scene = eventful(kind);
      scene["integrator"] = entry.name;
      scene["step"] = entry.name == std::string("explicit-euler") ? 1e-5 : 2e-4;
      Simulation simulation(parse(scene));
      const double before = simulation.body().mass();
      while (simulation.steps_done() < simulation.step_count()) ASSERT_FALSE(simulation.advance()) << entry.name;
      EXPECT_EQ(simulation.body().violation(), "");
      EXPECT_NEAR(simulation.body().mass() + simulation.body().removed_mass(), before, 1e-12 * before);
      EXPECT_GT(simulation.operations(), 5u);
    }
}

TEST(MembraneScene, GoesOnWithTheSameBitsAfterAnInterruption) {
  for (const Json& kind : all_kinds()) {
    const SceneFile file = parse(eventful(kind));
    const RunInMemory one = whole(file);
    for (const std::uint64_t n : {1, 3, 5, 8}) expect_same(in_two(file, n), one);
  }
}

// Each of two bodies has its own material, and moves as if it were alone.
TEST(MembraneScene, HasBodiesOfSeveralMaterials) {
  const char* bodies = R"([
    {"generate": {"sheet": {"cells": [4, 3], "spacing": 0.125}}},
    {"generate": {"sheet": {"cells": [4, 3], "spacing": 0.125, "kind": "quadrilaterals"}}, "translate": [2, 0, 0],
     "material": {"density": 3, "young": 100, "poisson": 0.1}}])";
  Json both = sheet("triangles");
  both.erase("body");
  both["bodies"] = Json::parse(bodies);
  Json second = sheet("quadrilaterals", R"({"density": 3, "young": 100, "poisson": 0.1, "viscosity": 0.5})");
  second["body"]["translate"] = {2, 0, 0};
  Simulation all(parse(both)), one(parse(sheet("triangles"))), other(parse(second));
  for (Simulation* simulation : {&all, &one, &other}) run(*simulation);
  const auto sum = one.diagnostics().elastic + other.diagnostics().elastic;
  EXPECT_GT(other.diagnostics().elastic, 0.0);
  EXPECT_NEAR(all.diagnostics().elastic, sum, 1e-12 * sum);
}

TEST(MembraneScene, IsPlannedToTheByteAndSaysThatNothingResistsBending) {
  for (const char* events : {"[]", R"([{"at": 0.005, "remove": {"ids": [3]}}])"})
    for (const Json& json :
         {sheet("triangles"), sheet("quadrilaterals"), with(sheet("triangles"), "bending", R"({"rigidity": 0.25})"),
          with(sheet("quadrilaterals"), "bending", R"({"second_neighbours": 32})")}) {
      Json of_implicit = with_events(json, events);
      of_implicit["integrator"] = "backward-euler";
      const SceneFile scene = parse(of_implicit);
      const Problem problem = make_problem(scene);
      ScenePlan plan = plan_scene(scene);
      std::string elements;
      for (const PlanItem& item : plan.items) {
        if (item.part == Part::elements) elements = item.what;
        if (item.part == Part::elements || item.part == Part::springs || item.part == Part::cells ||
            item.part == Part::force) {
          EXPECT_EQ(item.bytes, memory::predicted_bytes(scene, problem, plan, item)) << name(item.part);
        }
      }
      EXPECT_EQ(elements, fmt::format("{} membranes: rest shape, corners", problem.mesh.cell_count()));
      EXPECT_TRUE(plan.unplanned.empty()) << name(plan.unplanned.front().part);
      const bool is_named = std::ranges::any_of(plan.left_out, [](const auto& left_out) {
        return left_out.what == "stiffness against bending, which membranes do not have";
      });
      EXPECT_EQ(is_named, !json.contains("bending"));
    }
}

}  // namespace
}  // namespace dartboard::membrane_scene_test
