// Scenes with springs that are not edges, and with bending.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "core/scene/file/scene_problem.h"
#include "core/scene/file/springs_beside_edges.h"
#include "core/scene/plan/scene_plan.h"
#include "core/time/integrators.h"
#include "core/time/system/energy.h"
#include "tests/support/bodies/surveys_for_tests.h"
#include "tests/support/moving_box.h"
#include "tests/support/plan_memory.h"
#include "tests/support/run_in_memory.h"

namespace dartboard::springs_beside_edges_scene_test {
namespace {

using namespace moving;
using namespace recorded;

Json with(Json scene, const char* key, const Json& value) {
  scene[key] = value;
  return scene;
}
Json block(const char* kind, const char* diagonals = "faces") {
  Json scene = with(moving_box(), "diagonals", diagonals);
  scene["body"]["generate"]["box"]["kind"] = kind;
  return scene;
}
Json sheet(const char* kind, const char* bending) {
  Json scene = moving_box();
  scene["body"] = Json::parse(R"({"generate": {"sheet": {"cells": [4, 3], "spacing": 0.125}}})");
  scene["body"]["generate"]["sheet"]["kind"] = kind;
  scene["bending"] = Json::parse(bending);
  return scene;
}
constexpr const char* rigid = R"({"rigidity": 0.25})";
constexpr const char* sprung = R"({"second_neighbours": 32})";

TEST(SpringsBesideEdges, AreReadFromTheScene) {
  EXPECT_EQ(parse(moving_box()).diagonals, Diagonals::none);
  EXPECT_FALSE(parse(moving_box()).bending.any());
  EXPECT_EQ(parse(block("hexahedra", "all")).diagonals, Diagonals::all);
  EXPECT_EQ(parse(block("hexahedra", "volumes")).diagonals, Diagonals::volumes);
  EXPECT_EQ(parse(sheet("triangles", rigid)).bending.rigidity, 0.25);
  EXPECT_EQ(parse(sheet("triangles", sprung)).bending.second_neighbours, 32);
}

TEST(SpringsBesideEdges, NameTheKeyThatFitsNoCell) {
  EXPECT_EQ(refusal(block("tetrahedra")),
            "file: /diagonals: is \"faces\", and no cell has such diagonals; expected hexahedra, prisms, pyramids or "
            "quadrilaterals, or no such key");
  EXPECT_EQ(refusal(with(sheet("quadrilaterals", sprung), "diagonals", "volumes")),
            "file: /diagonals: is \"volumes\", and no cell has such diagonals; expected hexahedra, or no such key");
  Json scene = block("hexahedra");
  scene["material"] = Json::parse(R"({"young": 2e4, "poisson": 0.3})");
  EXPECT_EQ(
      refusal(scene),
      "file: /diagonals: is \"faces\", and all cells are made of elements; expected cells of springs, or no such key");
  scene = with(moving_box(), "diagonals", "faces");
  scene["body"] = Json::parse(R"({"generate": {"chain": {"links": 3, "spacing": 1}}})");
  EXPECT_EQ(refusal(scene),
            "file: /diagonals: cannot be combined with /body/generate/chain, which has no cells; expected cells");
  EXPECT_EQ(refusal(with(moving_box(), "bending", Json::parse(rigid))),
            "file: /bending: cannot be combined with a solid, whose cells do not bend at edges; expected a surface");
  EXPECT_EQ(refusal(sheet("quadrilaterals", rigid)),
            "file: /bending/rigidity: is 0.25 N m, and cell 0 is a quadrilateral; expected triangles, or "
            "'second_neighbours' in its place");
  EXPECT_EQ(refusal(sheet("triangles", R"({"rigidity": -1})")),
            "file: /bending/rigidity: is -1; expected a number >= 0 [N m]");
  EXPECT_EQ(refusal(sheet("triangles", R"({"rigidity": 1, "second_neighbours": 1})")),
            "file: /bending: has 'rigidity', 'second_neighbours'; expected exactly one of 'rigidity', "
            "'second_neighbours'");
  scene = with_events(block("hexahedra"), R"([{"at": 0.001, "refine": {"cells": {"random": {"count": 1}}}}])");
  EXPECT_EQ(refusal(scene),
            "file: /events/0/refine: subdivides tetrahedra, and the body has other cells; expected a solid that has "
            "tetrahedra");
}

TEST(SpringsBesideEdges, BendFromAFlatSheetAlone) {
  SceneFile scene = parse(sheet("triangles", rigid));
  Problem problem = make_problem(scene);
  const auto refused = [&] {
    try {
      require_springs_beside_edges(scene, problem);
      return std::string();
    } catch (const InputError& error) {
      return std::string(error.what());
    }
  };
  std::swap(problem.mesh.nodes[0], problem.mesh.nodes[1]);  // the other way round is as flat
  EXPECT_EQ(refused(), "");
  problem.mesh.points[7][2] += 1e-5;
  EXPECT_NE(refused().find("file: /bending/rigidity: is 0.25 N m, and the surface is bent by"), std::string::npos);
  std::swap(problem.mesh.nodes[0], problem.mesh.nodes[1]);
  EXPECT_NE(refused(), "");
}

// A Young's modulus for cells that their edges alone do not hold: the springs have the mean over their edges.
TEST(SpringsBesideEdges, TakeAYoungsModulusForHexahedra) {
  Json scene = block("hexahedra");
  scene["material"].erase("stiffness");
  scene["material"]["young"] = 2e4;
  EXPECT_NEAR(make_problem(parse(scene)).material.stiffness, 0.1 * 2e4 * 0.125, 1e-10);
  const Simulation simulation(parse(scene));
  const SpringSystem system = simulation.body().system();
  for (std::size_t k = 0; k < system.springs.size(); ++k) {
    const double cells = system.springs[k].stiffness / 250.0;
    EXPECT_NEAR(cells, std::round(cells), 1e-12);
    // the damping is that of the material in each of its cells
    EXPECT_NEAR(system.springs[k].damping, 0.25 * cells, 1e-12);
  }
  scene["diagonals"] = "none";
  EXPECT_NE(refusal(scene).find("/material/young: is 20000 Pa, and cell 0 is a hexahedron"), std::string::npos);
}

TEST(SpringsBesideEdges, MoveABodyWithTheSameBitsOnAMapAndWithout) {
  for (const Json& scene :
       {block("hexahedra"), block("mixed", "all"), with(sheet("quadrilaterals", sprung), "diagonals", "faces"),
        sheet("triangles", rigid), sheet("triangles", sprung)}) {
    Simulation still(parse(scene)), on_map(parse(with_events(scene, R"([{"at": 0.01, "remove": {"ids": [3]}}])")));
    for (int n = 0; n < 9; ++n) {
      ASSERT_FALSE(still.advance());
      ASSERT_FALSE(on_map.advance());
    }
    EXPECT_EQ(still.body().map_name(), "no map");
    EXPECT_EQ(still.body().state_hash(), on_map.body().state_hash()) << scene.dump();
    EXPECT_EQ(still.body().largest_stress(), on_map.body().largest_stress());
    // and they do move it
    Json plain = scene;
    plain.erase("diagonals");
    plain.erase("bending");
    Simulation without(parse(plain));
    for (int n = 0; n < 9; ++n) ASSERT_FALSE(without.advance());
    if (scene.contains("diagonals")) {
      EXPECT_NE(still.body().state_hash(), without.body().state_hash());
    }
  }
}

Json eventful_block() {
  return with_events(block("hexahedra", "all"), R"([
    {"at": 0.002, "dissociate": {"plane": {"point": [0.125, 0, 0], "normal": [1, 0, 0]}}},
    {"at": 0.003, "tear": {"vertex": 13, "direction": [0, 1, 0]}}, {"at": 0.004, "remove": {"random": {"count": 3}}},
    {"from": 0.006, "tear_where_stressed": {"threshold": 100}}])");
}
Json eventful_sheet(const char* kind, const char* bending) {
  return with_events(sheet(kind, bending), R"([
    {"at": 0.002, "dissociate": {"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]}}},
    {"at": 0.004, "remove": {"random": {"count": 3}}}])");
}

TEST(SpringsBesideEdges, CarryOnThroughEveryEventAndEveryIntegrator) {
  for (Json scene : {eventful_block(), eventful_sheet("triangles", rigid), eventful_sheet("quadrilaterals", sprung)})
    for (const IntegratorEntry& entry : integrators()) {
      scene["integrator"] = entry.name;
      scene["step"] = entry.name == std::string("euler") ? 1e-5 : 2e-4;
      Simulation simulation(parse(scene));
      const double before = simulation.body().mass();
      while (simulation.steps_done() < simulation.step_count()) ASSERT_FALSE(simulation.advance()) << entry.name;
      EXPECT_EQ(simulation.body().violation(), "");
      EXPECT_NEAR(simulation.body().mass() + simulation.body().removed_mass(), before, 1e-12 * before);
      EXPECT_GT(simulation.operations(), 5u);
    }
}

TEST(SpringsBesideEdges, GoOnWithTheSameBitsAfterAnInterruption) {
  for (Json scene : {eventful_block(), eventful_sheet("triangles", rigid), eventful_sheet("triangles", sprung),
                     eventful_sheet("quadrilaterals", sprung)}) {
    const SceneFile file = parse(scene);
    const RunInMemory one = whole(file);
    for (const std::uint64_t n : {1, 3, 5, 8}) expect_same(in_two(file, n), one);
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

// The bending of one of them does not depend on the other.
TEST(SpringsBesideEdges, LetTwoPartsFlyOnTheirOwn) {
  for (const Json& whole : {sheet("triangles", rigid), sheet("triangles", sprung), sheet("quadrilaterals", sprung)}) {
    Json scene =
        with_events(whole, R"([{"at": 0, "dissociate": {"plane": {"point": [0.25, 0, 0], "normal": [1, 0, 0]}}}])");
    scene["material"]["viscosity"] = 0;
    scene["gravity"] = {0, 0, 0};
    scene["initial_velocity"] = Json::parse(R"({"linear": [[0, 0, 0], [0, 0, 0], [9, 4, 0]]})");
    Simulation simulation(parse(scene));
    const auto before = momenta(simulation);
    run(simulation);
    const auto after = momenta(simulation);
    ASSERT_EQ(before.size(), 2u);
    for (std::size_t part = 0; part < 2; ++part)
      EXPECT_LE((after[part] - before[part]).norm(), 1e-13 * before[part].norm());
  }
}

// The body loses no energy: a cut takes the springs across it.
TEST(SpringsBesideEdges, KeepTheEnergyOfAFreeBody) {
  for (Json scene : {block("hexahedra"), sheet("triangles", rigid), sheet("quadrilaterals", sprung)}) {
    scene["material"]["damping"] = scene["material"]["viscosity"] = 0;
    scene["integrator"] = "energy-momentum";
    scene["gravity"] = {0, 0, 0};
    scene["initial_velocity"] = Json::parse(R"({"linear": [[0, 0, 2], [1, 0, 0], [3, -2, 0]]})");
    Simulation simulation(parse(scene));
    const Diagnostics first = simulation.diagnostics();
    run(simulation);
    const Diagnostics last = simulation.diagnostics();
    EXPECT_GT(last.elastic, 1e-8 * first.kinetic);
    // ten steps, each to some roundings of the present energy
    EXPECT_NEAR(last.energy(), first.energy(), 1e-14 * first.kinetic);
    EXPECT_LE((last.angular_momentum - first.angular_momentum).norm(), 1e-12 * first.angular_momentum.norm());
  }
}

TEST(SpringsBesideEdges, OfFacesHoldTheShapeOfEveryCell) {
  const auto warned = [](const Json& json) {
    std::string found;
    for (const std::string& w : warnings_before_run(parse(json)))
      if (w.find("change their shape") != w.npos) found = w;
    return found;
  };
  EXPECT_NE(warned(block("mixed", "none")), "");
  EXPECT_EQ(warned(block("mixed", "faces")), "");
  EXPECT_EQ(warned(block("hexahedra", "all")), "");
  const std::string left = warned(block("mixed", "volumes"));
  EXPECT_NE(left.find("edges of cells and diagonals through their volumes alone carry springs"), left.npos) << left;
  EXPECT_NE(left.find("hexahedron in 2 ways"), left.npos) << left;
}

TEST(SpringsBesideEdges, ArePlannedToTheByte) {
  for (const char* events : {"[]", R"([{"at": 0.005, "remove": {"ids": [3]}}])"})
    for (const Json& json :
         {block("hexahedra"), block("mixed", "all"), sheet("triangles", rigid), sheet("quadrilaterals", sprung)}) {
      const SceneFile scene = parse(with_events(json, events));
      const Problem problem = make_problem(scene);
      ScenePlan plan = plan_scene(scene);
      int found = 0;
      for (const PlanItem& item : plan.items)
        if (item.part == Part::cell_springs || item.part == Part::force || item.part == Part::rest ||
            item.part == Part::elements) {
          EXPECT_EQ(item.bytes, memory::predicted_bytes(scene, problem, plan, item)) << name(item.part);
          if (item.part != Part::rest) ++found;
        }
      EXPECT_EQ(found, 1);
      EXPECT_TRUE(plan.unplanned.empty()) << name(plan.unplanned.front().part);
    }
}

// Cells of elements among them have no springs, and both keep their own part of the plan.
TEST(SpringsBesideEdges, StandBesideElementsInOtherCells) {
  Json scene = block("hexahedra");
  scene["regions"] = Json::parse(R"([{"cells": {"box": {"min": [0, 0, 0], "max": [0.1, 1, 1]}},
    "material": {"density": 768, "young": 2e4, "poisson": 0.3}}])");
  Simulation simulation(parse(scene));
  const SpringSystem system = simulation.body().system();
  ASSERT_EQ(system.terms.size(), 2u);
  std::size_t braced = 0;
  for (std::size_t c = 0; c < system.terms[1]->size(); ++c) braced += system.terms[1]->nodes(c).empty() ? 0 : 1;
  EXPECT_EQ(braced, 4u);
  run(simulation);
}

}  // namespace
}  // namespace dartboard::springs_beside_edges_scene_test
