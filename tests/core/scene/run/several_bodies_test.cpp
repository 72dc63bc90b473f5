// Scenes of several materials and of several bodies.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>

#include "core/scene/file/cell_tags.h"
#include "core/scene/file/load_mesh.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/plan/scene_plan.h"
#include "core/time/system/energy.h"
#include "tests/support/bodies/corner_body.h"
#include "tests/support/bodies/surveys_for_tests.h"
#include "tests/support/folder_for_tests.h"
#include "tests/support/moving_box.h"
#include "tests/support/plan_memory.h"

namespace dartboard::several_bodies_test {
namespace {

using namespace moving;
using Eigen::Vector3d;

Json with_region(const char* cells, const char* material) {
  Json scene = moving_box();
  scene["regions"] = Json::array({{{"cells", Json::parse(cells)}, {"material", Json::parse(material)}}});
  return scene;
}
constexpr const char* left_half = R"({"box": {"min": [-1, -1, -1], "max": [0.125, 1, 1]}})";
constexpr const char* heavy = R"({"density": 1536, "stiffness": 256, "damping": 1})";
constexpr const char* rubber = R"({"density": 768, "young": 2e4, "poisson": 0.3})";

TEST(SceneRegions, ReplaceTheMaterialOfTheCellsTheyHold) {
  const Problem problem = make_problem(parse(with_region(left_half, heavy)));
  ASSERT_EQ(problem.materials.size(), 2u);
  EXPECT_EQ(problem.materials[0].stiffness, 64.0);
  EXPECT_EQ(problem.materials[1].stiffness, 256.0);
  EXPECT_EQ(problem.materials[1].viscosity, 0.5);  // of the surroundings
  for (std::size_t c = 0; c < problem.mesh.cell_count(); ++c) {
    double x = 0.0;
    for (const std::uint32_t p : problem.mesh.cell(c)) x += problem.mesh.points[p].x() / 4.0;
    EXPECT_EQ(problem.cell_material[c], x <= 0.125 ? 1 : 0) << c;
  }
  const Simulation simulation(parse(with_region(left_half, heavy)));
  EXPECT_EQ(simulation.body().mass(), 24 * 0.25 + 24 * 0.5);
}

TEST(SceneRegions, OfEverythingMakeAHomogeneousBody) {
  const Problem problem = make_problem(parse(with_region(R"({"sphere": {"centre": [0, 0, 0], "radius": 9}})", heavy)));
  EXPECT_TRUE(problem.materials.empty());
  EXPECT_TRUE(problem.cell_material.empty());
  EXPECT_EQ(problem.material.density, 1536.0);
  EXPECT_EQ(problem.material.viscosity, 0.5);
}

TEST(SceneRegions, OfWhichTheLastCounts) {
  Json scene = with_region(left_half, heavy);
  scene["regions"].push_back({{"cells", {{"ids", {0, 1}}}}, {"material", Json::parse(rubber)}});
  const Problem problem = make_problem(parse(scene));
  ASSERT_EQ(problem.materials.size(), 3u);
  EXPECT_EQ(problem.materials[2].model, Model::neo_hookean);
  EXPECT_EQ(problem.cell_material[0], 2);
  EXPECT_EQ(problem.cell_material[1], 2);
}

// Springs of a Young's modulus have the same stiffness as in a body of their own.
TEST(SceneRegions, OfSpringsOfYoungAreAsStiffAsABodyOfThem) {
  Json scene = with_region(left_half, R"({"density": 768, "young": 3e4, "damping": 2})");
  scene["body"]["generate"]["box"]["jitter"] = 0.2;  // no two cells alike
  const Problem problem = make_problem(parse(scene));
  double sum = 0.0, edges = 0.0;
  for (std::size_t c = 0; c < problem.mesh.cell_count(); ++c) {
    if (problem.cell_material[c] != 1) continue;
    const auto node = problem.mesh.cell(c);
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        sum += 3e4 * std::abs(signed_measure(problem.mesh, c)) /
               (problem.mesh.points[node[i]] - problem.mesh.points[node[j]]).squaredNorm();
        edges += 1.0;
      }
  }
  EXPECT_NEAR(problem.materials[1].stiffness * edges / sum, 1.0, 1e-14);
}

// A body of corners that knows no map: it adds up each cell's springs by the cell's own numbers. A cut through both
// materials in between; errors of both fourth-order methods are far below the bound, which a hundredth of the
// difference from a body of one material exceeds.
TEST(SceneRegions, MoveAsABodyOfCornersDoes) {
  for (const char* material : {heavy, R"({"density": 1536, "young": 3e4, "damping": 1})"}) {
    Json json =
        with_events(with_region(left_half, material),
                    R"([{"at": 0.02, "dissociate": {"plane": {"point": [0, 0, 0.125], "normal": [0.3, 0, 1]}}}])");
    json["duration"] = 0.05;
    const SceneFile scene = parse(json);
    Simulation simulation(scene);
    run(simulation);
    CornerBody body(make_problem(scene));
    body.run(0.0, 0.02, scene.step / 4);
    body.cut([](const Vector3d& x) { return Vector3d(0.3, 0, 1).dot(x - Vector3d(0, 0, 0.125)) >= 0; });
    body.run(0.02, 0.05, scene.step / 4);
    const auto& vertices = simulation.body().vertices();
    double farthest = 0.0;
    for (std::size_t k = 0; k < vertices.size(); ++k) {
      double nearest = 1.0;  // of the parts of its point
      for (const Vector3d& x : body.x) nearest = std::min(nearest, (x - vertices.position[k]).norm());
      farthest = std::max(farthest, nearest);
    }
    EXPECT_LT(farthest, 1e-8) << material;
  }
}

// Springs in one half and elements in the other: energy that leaves one goes into the other, or into the motion.
TEST(SceneRegions, OfSpringsBesideElementsKeepTheirEnergy) {
  Json json = with_region(left_half, rubber);
  json["material"] = Json::parse(R"({"density": 768, "stiffness": 64, "damping": 0, "viscosity": 0})");
  json["integrator"] = "blanes-moan-4";
  json["duration"] = 0.2;
  json["gravity"] = {0, 0, 0};
  Simulation simulation(parse(json));
  const SpringSystem system = simulation.body().system();
  ASSERT_EQ(system.terms.size(), 1u);
  ASSERT_EQ(system.springs.size(), simulation.body().counts().edges);
  const auto energy = [&] {
    const auto& v = simulation.body().vertices();
    return kinetic_energy(simulation.body().system(), v.velocity) +
           elastic_energy(simulation.body().system(), v.position);
  };
  const double before = energy();
  run(simulation);
  double of_springs = 0.0;
  const auto& x = simulation.body().vertices().position;
  for (std::size_t k = 0; k < system.springs.size(); ++k) {
    const double stretch = (x[system.ends[k][1]] - x[system.ends[k][0]]).norm() - system.springs[k].rest_length;
    of_springs += 0.5 * system.springs[k].stiffness * stretch * stretch;
  }
  const double of_elements = system.terms[0]->energy(x);
  EXPECT_GT(of_springs, 0.02 * before);
  EXPECT_GT(of_elements, 0.02 * before);
  EXPECT_NEAR(energy() / before, 1.0, 1e-6);  // of order 4 in h omega = 0.3, bounded
}

TEST(SceneRegions, OnAMapMoveWithTheBitsOfThoseWithout) {
  const Json plain = with_region(left_half, rubber);
  Simulation columns(parse(plain)), on_map(parse(with_events(plain, R"([{"at": 0.01, "remove": {"ids": [0]}}])")));
  while (columns.steps_done() < 9) {
    columns.advance();
    on_map.advance();
  }
  ASSERT_NE(columns.body().map_name(), on_map.body().map_name());
  EXPECT_EQ(columns.body().state_hash(), on_map.body().state_hash());
  EXPECT_EQ(columns.body().largest_stress(), on_map.body().largest_stress());
  EXPECT_EQ(columns.body().frame({.stress = true}).stress, on_map.body().frame({.stress = true}).stress);
  EXPECT_EQ(columns.body().frame({}).material.size(), 48u);
}

TEST(SceneRegions, WarnOfLooseShapesWhereCellsAreSpringsAlone) {
  Json scene = with_region(left_half, rubber);
  scene["body"]["generate"]["box"]["kind"] = "hexahedra";
  const auto said = [](const Json& json) {
    const SceneFile file = parse(json);
    std::string all;
    for (const std::string& warning : warnings_before_run(file)) all += warning + "\n";
    return all;
  };
  EXPECT_NE(said(scene).find("(4 of kind hexahedron in 6 ways)"), std::string::npos) << said(scene);
  scene["material"] = Json::parse(R"({"density": 768, "young": 1e4, "poisson": 0.2})");
  EXPECT_EQ(said(scene).find("hexahedron"), std::string::npos) << said(scene);
}

TEST(SceneRegions, NameTheKeyThatIsWrong) {
  EXPECT_EQ(
      refusal(with_region(R"({"sphere": {"centre": [9, 0, 0], "radius": 1}})", heavy)),
      "file: /regions/0/cells: selects no cell of the body; expected a region that some cells have their centroid in");
  EXPECT_EQ(refusal(with_region(R"({"ids": [3, 48]})", heavy)),
            "file: /regions/0/cells/ids/1: is 48; expected a cell of the mesh, less than 48");
  EXPECT_EQ(
      refusal(with_region(R"({"random": {"count": 3}})", heavy)),
      "file: /regions/0/cells/random: is drawn anew with every seed; expected cells by place, by number or by tag");
  EXPECT_EQ(
      refusal(with_region(R"({"tag": {"value": 3}})", heavy)),
      "file: /regions/0/cells/tag: names a mark of cells, and no mesh file of the scene has any; expected a selection "
      "by place");
  EXPECT_EQ(refusal(with_region(left_half, R"({"young": 1e4, "poisson": 0.5})")),
            "file: /regions/0/material/poisson: is 0.5; expected a number >= -0.99 and <= 0.4999");
  EXPECT_EQ(refusal(with_region(left_half, R"({"poisson": 0.3})")),
            "file: /regions/0/material/poisson: is given without 'young'; expected Young's modulus together with it");
  EXPECT_EQ(
      refusal(with_region(left_half, R"({"viscosity": 1})")),
      "file: /regions/0/material/viscosity: unknown key; the valid keys are 'density', 'stiffness', 'young', 'poisson', "
      "'model', 'damping', 'width'");
  Json scene = with_region(left_half, rubber);
  scene["regions"][0]["material"]["model"] = "neo-hookean";
  scene["body"] = Json::parse(R"({"generate": {"sheet": {"cells": [2, 2], "spacing": 0.1}}})");
  EXPECT_EQ(refusal(scene),
            "file: /regions/0/material/model: is \"neo-hookean\", and the body is a surface; expected \"stvk\", "
            "\"corotational\" or \"springs\"");
  scene["body"] = Json::parse(R"({"generate": {"chain": {"links": 2, "spacing": 1}}})");
  EXPECT_EQ(refusal(scene),
            "file: /regions: cannot be combined with /body/generate/chain, which has no cells; expected no such key");
}

// ---- marks of cells in a mesh file

constexpr const char* marked_mesh = R"(MeshVersionFormatted 2
Dimension 3
Vertices
5
0 0 0 0
1 0 0 0
0 1 0 0
0 0 1 0
1 1 1 0
Tetrahedra
2
1 2 3 4 7
2 3 4 5 9
End
)";

class MarkedMesh : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    std::ofstream(folder_ / "two.mesh") << marked_mesh;
  }
  SceneFile scene(const char* tag) const {
    Json json = with_region("{}", heavy);
    json["body"] = {{"mesh", file_}};
    json["regions"][0]["cells"] = {{"tag", Json::parse(tag)}};
    SceneFile scene = parse_scene(json.dump(), "file", folder_);
    load_mesh(scene);
    return scene;
  }
  std::string refusal_of(const char* tag) const {
    try {
      scene(tag);
    } catch (const InputError& error) {
      return error.what();
    }
    return "accepted";
  }

  const char* file_ = "two.mesh";
};

TEST_F(MarkedMesh, NamesItsRegionsByTheirMarks) {
  EXPECT_EQ(make_problem(scene(R"({"value": 9})")).cell_material, (std::vector<MaterialNumber>{0, 1}));
  EXPECT_EQ(make_problem(scene(R"({"of": "reference", "value": 7})")).cell_material,
            (std::vector<MaterialNumber>{1, 0}));
}

TEST_F(MarkedMesh, SaysWhichMarksThereAre) {
  EXPECT_EQ(refusal_of(R"({"value": 8})"), "file: /regions/0/cells/tag: names a mark that no cell has; expected 7, 9");
  EXPECT_EQ(refusal_of(R"({"of": "group", "value": 7})"),
            "file: /regions/0/cells/tag: names a kind of marks that no mesh file has; expected 'reference'");
  EXPECT_EQ(refusal_of(R"({"named": "left"})"),
            "file: /regions/0/cells/tag: names a mark that no cell has; expected 7, 9");
}

/// Two tetrahedra of the entities 1 and 2 and the physical groups 5 and 6, with a name for each group.
std::string gmsh_with(const char* name_of_5, const char* name_of_6) {
  return std::string("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n3 5 \"") + name_of_5 + "\"\n3 6 \"" +
         name_of_6 +
         "\"\n$EndPhysicalNames\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n$EndNodes\n"
         "$Elements\n2\n1 4 2 5 1 1 2 3 4\n2 4 2 6 2 2 3 4 5\n$EndElements\n";
}

/// A mesh with two kinds of marks, of which the groups alone have names.
class MarkedGmsh : public MarkedMesh {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    std::ofstream(folder_ / "two.msh") << gmsh_with("left", "right");
    file_ = "two.msh";
  }
};

TEST_F(MarkedGmsh, NamesARegionByANameThatOneKindOfMarksHas) {
  EXPECT_EQ(make_problem(scene(R"({"named": "right"})")).cell_material, (std::vector<MaterialNumber>{0, 1}));
}

TEST_F(MarkedGmsh, StillHasToSayWhichKindOfMarksANumberMeans) {
  for (const char* tag : {R"({"value": 5})", R"({"named": "middle"})"})
    EXPECT_EQ(refusal_of(tag),
              "file: /regions/0/cells/tag: does not say which kind of marks it means; expected \"of\": 'entity' or "
              "'physical group'");
}

TEST_F(MarkedGmsh, HasToSayTheKindWhereTwoKindsHaveTheName) {
  SceneFile file = scene(R"({"named": "left"})");
  LoadedMesh named_twice = *file.body.loaded;
  for (CellTags& marks : named_twice.tags) marks.names = {{1, "left"}, {5, "left"}};
  file.body.loaded = std::make_shared<const LoadedMesh>(named_twice);
  try {
    cells_with(file, {.tag = "", .value = "left"}, "/tag");
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("does not say which kind of marks it means"), std::string::npos)
        << error.what();
  }
}

TEST_F(MarkedMesh, TellsEventsTheirCellsToo) {
  Json json = moving_box();
  json["body"] = {{"mesh", "two.mesh"}};
  json["events"] = Json::parse(R"([{"at": 0.005, "remove": {"tag": {"value": 7}}}])");
  SceneFile scene = parse_scene(json.dump(), "file", folder_);
  EXPECT_THROW(Simulation{scene}, InputError);  // the marks have not been resolved yet
  load_mesh(scene);
  Simulation simulation(scene);
  run(simulation);
  EXPECT_EQ(simulation.body().frame({}).mesh_cell, (std::vector<std::uint32_t>{1}));
}

// ---- several bodies

Json two_boxes() {
  Json scene = moving_box();
  Json box = scene["body"];
  scene.erase("body");
  Json other = box;
  other["translate"] = {1, 0, 0};
  other["material"] = Json::parse(heavy);
  other["initial_velocity"] = {0, 3, 0};
  scene["bodies"] = {box, other};
  return scene;
}

TEST(SceneBodies, StandSideBySideEachOfItsOwnMaterialAndMotion) {
  const Problem problem = make_problem(parse(two_boxes()));
  const Problem one = make_problem(parse(moving_box()));
  const std::size_t points = one.mesh.points.size();
  ASSERT_EQ(problem.mesh.points.size(), 2 * points);
  ASSERT_EQ(problem.mesh.cell_count(), 96u);
  for (std::size_t p = 0; p < points; ++p) {
    EXPECT_EQ(problem.mesh.points[p], one.mesh.points[p]);
    EXPECT_EQ(problem.mesh.points[points + p], Vector3d(one.mesh.points[p] + Vector3d(1, 0, 0)));
    EXPECT_EQ(problem.initial_velocity[p], one.initial_velocity[p]);
    EXPECT_EQ(problem.initial_velocity[points + p], Vector3d(0, 3, 0));
  }
  for (std::size_t c = 0; c < 96; ++c) EXPECT_EQ(problem.cell_material[c], c < 48 ? 0 : 1);
  const Simulation simulation(parse(two_boxes()));
  EXPECT_EQ(simulation.body().counts().components, 2u);
  EXPECT_EQ(simulation.body().mass(), 48 * 0.25 + 48 * 0.5);
}

// The bodies are independent: each moves as it would alone, except for the order in which its forces are summed.
TEST(SceneBodies, MoveAsEachWouldAlone) {
  Json second = moving_box();
  second["body"]["translate"] = {1, 0, 0};
  second["material"] = Json::parse(heavy);
  second["material"]["viscosity"] = 0.5;
  second["initial_velocity"] = {0, 3, 0};
  Simulation together(parse(two_boxes())), first(parse(moving_box())), other(parse(second));
  for (Simulation* simulation : {&together, &first, &other}) run(*simulation);
  const auto place_of = [](const Simulation& simulation, std::uint32_t point) {
    const auto& v = simulation.body().vertices();
    return v.position[static_cast<std::size_t>(std::ranges::find(v.point, point) - v.point.begin())];
  };
  for (std::uint32_t p = 0; p < 27; ++p) {
    EXPECT_LT((place_of(together, p) - place_of(first, p)).norm(), 1e-15) << p;
    EXPECT_LT((place_of(together, 27 + p) - place_of(other, p)).norm(), 2e-15) << p;
  }
}

TEST(SceneBodies, NameTheKeyThatIsWrong) {
  const auto with = [](std::size_t body, const char* key, const Json& value) {
    Json scene = two_boxes();
    scene["bodies"][body][key] = value;
    return refusal(scene);
  };
  EXPECT_EQ(with(1, "scale", -1), "file: /bodies/1/scale: is -1; expected a number > 0");
  EXPECT_EQ(with(1, "initial_velocity", Json{0, 0, 3e8}),
            "file: /bodies/1/initial_velocity: is 3e+08 m/s somewhere in the body; expected at most 299792458 m/s, the "
            "speed of light");
  Json scene = two_boxes();
  scene["body"] = scene["bodies"][0];
  EXPECT_EQ(refusal(scene), "file: /: has 'body', 'bodies'; expected exactly one of 'body', 'bodies'");
  scene = two_boxes();
  scene["bodies"] = Json::array();
  EXPECT_EQ(refusal(scene), "file: /bodies: is empty; expected at least one body");
}

TEST(SceneBodies, AreSelectedByPlaceAndNotByNumber) {
  Json json = two_boxes();
  json["fixed"] = Json::parse(R"([{"ids": [3]}])");
  SceneFile scene = parse(json);
  try {
    load_mesh(scene);
    ADD_FAILURE() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(
        error.what(),
        "file: /fixed/0/ids/0: is 3 together with /bodies; expected a place, because numbers are ambiguous with "
        "several bodies");
  }
  json["fixed"] = Json::parse(R"([{"box": {"min": [0.9, -1, -1], "max": [2, 1, 1]}}])");
  EXPECT_EQ(make_problem(parse(json)).fixed.size(), 27u);
}

}  // namespace
}  // namespace dartboard::several_bodies_test
