// A scene counts the points of its mesh file; a body has only those of its cells, and one for each of its vertices.

#include "core/scene/file/load_mesh.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "core/plain/error.h"
#include "core/scene/run/simulation.h"

namespace dartboard::load_mesh_test {
namespace {

namespace fs = std::filesystem;

/// Points 1, 2, 4 and 5 of six are the corners of the unit tetrahedron.
struct Folder {
  fs::path path = fs::temp_directory_path() / (std::to_string(getpid()) + "-point-numbers");
  explicit Folder(const std::string& keys) {
    fs::create_directories(path);
    std::ofstream(path / "gaps.mesh") << "MeshVersionFormatted 2\nDimension 3\nVertices\n6\n9 9 9 0\n0 0 0 0\n1 0 0 0\n"
                                         "8 8 8 0\n0 1 0 0\n0 0 1 0\nTetrahedra\n1\n2 3 5 6 0\nEnd\n";
    std::ofstream(path / "scene.json")
        << R"({"name": "x", "body": {"mesh": "gaps.mesh"}, "step": 0.001, "duration": 0.01, )" << keys << "}";
  }
  ~Folder() { fs::remove_all(path); }
  SceneFile scene() const { return read_scene(path / "scene.json"); }
};

TEST(PointNumbers, AreThoseOfTheFileInEveryKey) {
  const Folder folder(R"("fixed": [{"ids": [1, 5]}], "driven": [{"ids": [4], "velocity": [0, 0, 1]}],
      "events": [{"at": 0.005, "tear": {"vertex": 2, "direction": [1, 0, 0]}},
                 {"at": 0.005, "dissociate": {"points": [[1, 2, 5]]}}],
      "attachments": [{"ids": [5, 4], "stiffness": 3}], "output": {"probes": [{"name": "p", "vertex": 4}]})");
  const SceneFile scene = folder.scene();
  EXPECT_EQ(std::get<IdSelection>(scene.attachments.at(0).vertices).ids, (std::vector<std::uint32_t>{3, 2}));
  EXPECT_EQ(std::get<IdSelection>(scene.fixed.at(0).vertices).ids, (std::vector<std::uint32_t>{0, 3}));
  EXPECT_EQ(std::get<IdSelection>(scene.driven.at(0).vertices).ids, (std::vector<std::uint32_t>{2}));
  EXPECT_EQ(std::get<std::uint32_t>(std::get<Tear>(scene.events.at(0).action).vertex), 1u);
  EXPECT_EQ(std::get<0>(std::get<Dissociate>(scene.events.at(1).action).faces).at(0),
            (std::vector<std::uint32_t>{0, 1, 3}));
}

TEST(PointNumbers, LeadToThePlaceThatTheFileGivesThePoint) {
  const Folder folder(R"("output": {"probes": [{"name": "p", "vertex": 4}]})");
  EXPECT_EQ(Simulation(folder.scene()).probes().probes.at(0)->position, Eigen::Vector3d(0, 1, 0));
}

TEST(PointNumbers, OfPointsThatBelongToNoCellAreRefused) {
  const Folder folder(R"("output": {"probes": [{"name": "p", "vertex": 3}]})");
  try {
    folder.scene();
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("/output/probes/0/vertex: is 3; expected a point that belongs to a cell"),
              std::string::npos)
        << error.what();
  }
}

TEST(PointNumbers, AreThoseOfTheFileInMessages) {
  const Folder folder(R"("fixed": [{"ids": [4]}], "driven": [{"ids": [4], "velocity": [0, 0, 1]}])");
  try {
    Simulation simulation(folder.scene());
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("drives point 4, and /fixed holds it still"), std::string::npos)
        << error.what();
  }
}

/// Two tetrahedra that touch at point 0, the second with the corner of its right angle there.
struct TouchingFolder {
  fs::path path = fs::temp_directory_path() / (std::to_string(getpid()) + "-touching");
  explicit TouchingFolder(const std::string& keys, const std::string& touching = "split") {
    fs::create_directories(path);
    std::ofstream(path / "two.mesh")
        << "MeshVersionFormatted 2\nDimension 3\nVertices\n7\n0 0 0 0\n1 0 0 0\n0 1 0 0\n"
           "0 0 1 0\n-1 0 0 0\n0 -1 0 0\n0 0 -1 0\nTetrahedra\n2\n1 2 3 4 0\n1 6 5 7 0\nEnd\n";
    std::ofstream(path / "scene.json") << R"({"name": "x", "body": {"mesh": "two.mesh", "touching": ")" << touching
                                       << R"("}, "step": 0.001, "duration": 0.01)" << keys << "}";
  }
  ~TouchingFolder() { fs::remove_all(path); }
  SceneFile scene() const { return read_scene(path / "scene.json"); }
};

TEST(TouchingScene, RunsAsTheSeveralVerticesThatThePointIs) {
  const TouchingFolder folder("");
  Simulation simulation(folder.scene());
  const CellCounts counts = simulation.body().counts();
  EXPECT_EQ(counts.vertices, 8u);
  EXPECT_EQ(counts.components, 2u);
  while (simulation.steps_done() < simulation.step_count()) ASSERT_FALSE(simulation.advance());
}

TEST(TouchingScene, SaysSoOnceByTheNumbersOfTheFile) {
  const TouchingFolder folder("");
  const SceneFile scene = folder.scene();
  ASSERT_EQ(scene.body.loaded->notices.size(), 1u);
  EXPECT_EQ(scene.body.loaded->notices[0].find("cells touch at 1 point without sharing a face (point 0)"), 0u)
      << scene.body.loaded->notices[0];
}

TEST(TouchingScene, IsRefusedWhereItAsksForThat) {
  const TouchingFolder folder("", "refuse");
  try {
    Simulation simulation(folder.scene());
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("/body/mesh: "), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("two.mesh: cells touch at 1 point"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("expected none, or \"touching\": \"split\""), std::string::npos);
  }
}

TEST(TouchingScene, HoldsAllVerticesInThePlaceOfAPoint) {
  const TouchingFolder folder(R"(, "fixed": [{"ids": [0]}])");
  const Simulation simulation(folder.scene());
  std::size_t held = 0;
  for (const auto fixed : simulation.body().system().fixed) held += fixed;
  EXPECT_EQ(held, 2u);
  const TouchingFolder attached(R"(, "attachments": [{"ids": [0], "stiffness": 1}])");
  EXPECT_EQ(Simulation(attached.scene()).body().system().terms[0]->size(), 2u);
}

TEST(TouchingScene, KnowsAFaceByThePointsOfTheFile) {
  const TouchingFolder folder(R"(, "events": [{"at": 0, "dissociate": {"points": [[0, 4, 5]]}}])");
  const SceneFile scene = folder.scene();
  auto points = std::get<0>(std::get<Dissociate>(scene.events.at(0).action).faces).at(0);
  std::ranges::sort(points);
  EXPECT_EQ(points, (std::vector<std::uint32_t>{4, 5, 7}));
}

TEST(TouchingScene, DoesNotTakeTheNumberOfASplitPointForOneOfTheFile) {
  const TouchingFolder folder(R"(, "fixed": [{"ids": [7]}])");
  try {
    folder.scene();
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("/fixed/0/ids/0: is 7; expected a point of the mesh, less than 7"),
              std::string::npos)
        << error.what();
  }
}

// ---- seams

/// Two cubes, 1e-9 apart, after a point of no cell: points 2, 4, 6 and 8 of the first are met by 9, 11, 13 and 15.
struct SeamFolder {
  fs::path path = fs::temp_directory_path() / (std::to_string(getpid()) + "-seam");
  explicit SeamFolder(const std::string& body, const std::string& keys = "") {
    fs::create_directories(path);
    std::ofstream mesh(path / "two.mesh");
    mesh << "MeshVersionFormatted 2\nDimension 3\nVertices\n17\n9 9 9 0\n";
    for (const char* x : {"0 1", "1.000000001 2"})
      for (const char* yz : {" 0 0 0\n", " 1 0 0\n", " 0 1 0\n", " 1 1 0\n"}) {
        const std::string low_high = x;
        mesh << low_high.substr(0, low_high.find(' ')) << yz << low_high.substr(low_high.find(' ') + 1) << yz;
      }
    mesh << "Hexahedra\n2\n2 3 5 4 6 7 9 8 0\n10 11 13 12 14 15 17 16 0\nEnd\n";
    std::ofstream(path / "scene.json") << R"({"name": "x", "body": {)" << body
                                       << R"(}, "step": 0.001, "duration": 0.01)" << keys << "}";
  }
  ~SeamFolder() { fs::remove_all(path); }
  SceneFile scene() const { return read_scene(path / "scene.json"); }
  std::string refused() const {
    try {
      Simulation simulation(scene());
    } catch (const InputError& error) {
      return error.what();
    }
    ADD_FAILURE() << "no error";
    return "";
  }
};

TEST(SeamScene, IsOpenUnlessItAsksForWelding) {
  EXPECT_EQ(Simulation(SeamFolder(R"("mesh": "two.mesh")").scene()).body().counts().components, 2u);
  const CellCounts counts = Simulation(SeamFolder(R"("mesh": "two.mesh", "weld": 1e-6)").scene()).body().counts();
  EXPECT_EQ(counts.components, 1u);
  EXPECT_EQ(counts.vertices, 12u);
}

TEST(SeamScene, IsWeldedInTheUnitsOfTheFile) {
  EXPECT_EQ(
      Simulation(SeamFolder(R"("mesh": "two.mesh", "weld": 1e-6, "scale": 1e-6)").scene()).body().counts().components,
      1u);
  EXPECT_EQ(
      Simulation(SeamFolder(R"("mesh": "two.mesh", "weld": 1e-12, "scale": 1e-6)").scene()).body().counts().components,
      2u);
}

TEST(SeamScene, KnowsWeldedPointsByEachOfTheirNumbers) {
  const SeamFolder folder(R"("mesh": "two.mesh", "weld": 1e-6)",
                          R"(, "fixed": [{"ids": [1, 9, 10]}], "output": {"probes": [{"name": "p", "vertex": 15},
                             {"name": "q", "vertex": 16}]})");
  const SceneFile scene = folder.scene();
  EXPECT_EQ(std::get<IdSelection>(scene.fixed.at(0).vertices).ids, (std::vector<std::uint32_t>{0, 1, 8}));
  const Simulation simulation(scene);
  EXPECT_EQ(simulation.probes().probes.at(0)->position, Eigen::Vector3d(1, 1, 1));
  EXPECT_EQ(simulation.probes().probes.at(1)->position, Eigen::Vector3d(2, 1, 1));
}

TEST(SeamScene, IsRefusedWhereACellWouldLoseACorner) {
  const std::string said = SeamFolder(R"("mesh": "two.mesh", "weld": 1.5)").refused();
  EXPECT_NE(said.find("/body/mesh: "), std::string::npos) << said;
  EXPECT_NE(said.find("two.mesh:25: cell 1 (hexahedron) would lose a corner"), std::string::npos) << said;
}

TEST(SeamScene, HasAMeshFile) {
  const std::string said =
      SeamFolder(R"("generate": {"box": {"cells": [1, 1, 1], "spacing": 1}}, "weld": 1)").refused();
  EXPECT_NE(said.find("/body/weld: is given for a mesh that is generated"), std::string::npos) << said;
}

// ---- cells that cross themselves

TEST(CrossedScene, IsRefusedWithSpringsAsWithElements) {
  const SeamFolder folder(R"("mesh": "voxel.obj")");
  std::ofstream(folder.path / "voxel.obj") << "v 0 0 0\nv 2.5 0 0\nv 0 3 0\nv 2 2.6 0\nf 1 2 3 4\n";
  try {
    Simulation simulation(folder.scene());
    FAIL() << "no error";
  } catch (const IoError& error) {
    EXPECT_NE(std::string(error.what()).find("voxel.obj:5: 1 cell is crossed"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace dartboard::load_mesh_test
