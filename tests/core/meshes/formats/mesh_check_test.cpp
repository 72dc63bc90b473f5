#include "core/meshes/formats/mesh_check.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <limits>

#include "tests/support/meshes/mesh_samples.h"

namespace dartboard::mesh_check_test {
namespace {

using namespace samples;
using Nodes = std::vector<std::uint32_t>;

LoadedMesh mesh_of(std::vector<Eigen::Vector3d> points, const std::vector<std::pair<CellKind, Nodes>>& cells) {
  LoadedMesh loaded;
  loaded.mesh.points = std::move(points);
  for (const auto& [kind, nodes] : cells) loaded.mesh.add_cell(kind, nodes);
  return loaded;
}

std::string refused(LoadedMesh loaded) {
  try {
    check_and_repair(loaded, "file", std::array<std::uint32_t, 3>{11, 12, 13});
  } catch (const IoError& error) {
    return error.what();
  }
  ADD_FAILURE() << "the mesh passed";
  return "";
}

TEST(MeshCheck, TurnsEveryInvertedKindRightHanded) {
  const std::vector<std::pair<CellKind, Nodes>> inverted{
      {CellKind::tetrahedron, {0, 3, 1, 4}},
      {CellKind::pyramid, {0, 3, 2, 1, 6}},
      {CellKind::prism, {0, 3, 1, 4, 7, 5}},
      {CellKind::hexahedron, {4, 5, 6, 7, 0, 1, 2, 3}},
  };
  const double volumes[] = {1.0 / 6.0, 1.0 / 3.0, 0.5, 1.0};
  for (std::size_t k = 0; k < inverted.size(); ++k) {
    LoadedMesh loaded = mesh_of(cube, {inverted[k]});
    // sums of at most 24 products of halves, thirds and quarters below one: 64 u is ample
    constexpr double tolerance = 64 * std::numeric_limits<double>::epsilon();
    EXPECT_NEAR(signed_measure(loaded.mesh, 0), -volumes[k], tolerance);
    check_and_repair(loaded, "file", std::array<std::uint32_t, 1>{11});
    EXPECT_NEAR(signed_measure(loaded.mesh, 0), volumes[k], tolerance);
    EXPECT_EQ(loaded.notices.at(0), "reordered the nodes of 1 inverted cell, the first of them cell 0 (" +
                                        std::string(name(inverted[k].first)) + ") in line 11");
  }
}

TEST(MeshCheck, KeepsTheFacesOfAMirroredCell) {
  const auto face_sets = [](const Mesh& mesh) {
    std::vector<Nodes> sets;
    for (const auto& face : faces_of(mesh.kinds[0])) {
      Nodes points;
      for (int k : face) points.push_back(mesh.cell(0)[static_cast<std::size_t>(k)]);
      std::sort(points.begin(), points.end());
      sets.push_back(points);
    }
    std::sort(sets.begin(), sets.end());
    return sets;
  };
  for (const auto& cell : std::vector<std::pair<CellKind, Nodes>>{{CellKind::tetrahedron, {0, 3, 1, 4}},
                                                                  {CellKind::pyramid, {0, 3, 2, 1, 6}},
                                                                  {CellKind::prism, {0, 3, 1, 4, 7, 5}},
                                                                  {CellKind::hexahedron, {4, 5, 6, 7, 0, 1, 2, 3}}}) {
    LoadedMesh loaded = mesh_of(cube, {cell});
    const auto before = face_sets(loaded.mesh);
    check_and_repair(loaded, "file");
    EXPECT_EQ(face_sets(loaded.mesh), before);
  }
}

TEST(MeshCheck, RefusesAnEmptyMesh) {
  EXPECT_EQ(refused(mesh_of(cube, {})), "file: the mesh has no cells; expected at least one");
}

TEST(MeshCheck, RefusesPolygonsNextToVolumes) {
  expect_part(refused(mesh_of(cube, {{CellKind::tetrahedron, {0, 1, 3, 4}}, {CellKind::triangle, {0, 1, 2}}})),
              "file:12: cell 1 (triangle) occurs next to cell 0 (tetrahedron)");
}

TEST(MeshCheck, RefusesAnIndexOutOfRangeAndARepeatedNode) {
  expect_part(refused(mesh_of(cube, {{CellKind::tetrahedron, {0, 1, 3, 8}}})), "cell 0 (tetrahedron) has the point 8");
  expect_part(refused(mesh_of(cube, {{CellKind::tetrahedron, {0, 1, 3, 1}}})), "has the point 1 twice");
}

TEST(MeshCheck, RefusesACoordinateThatIsNotFinite) {
  auto points = cube;
  points[3].y() = std::numeric_limits<double>::quiet_NaN();
  expect_part(refused(mesh_of(points, {{CellKind::tetrahedron, {0, 1, 3, 4}}})), "point 3 has a coordinate that is");
}

TEST(MeshCheck, RefusesTheSameCellTwice) {
  EXPECT_EQ(refused(mesh_of(cube, {{CellKind::tetrahedron, {0, 1, 3, 4}}, {CellKind::tetrahedron, {3, 0, 4, 1}}})),
            "file:12: cell 1 (tetrahedron) has the same points as cell 0 (tetrahedron); expected every cell once");
}

TEST(MeshCheck, RefusesAFaceOfThreeVolumes) {
  EXPECT_EQ(refused(mesh_of(cube, {{CellKind::tetrahedron, {0, 1, 3, 4}},
                                   {CellKind::tetrahedron, {0, 1, 3, 5}},
                                   {CellKind::tetrahedron, {0, 1, 3, 6}}})),
            "file:13: cell 2 (tetrahedron) shares the face of points 0, 1, 3 with cell 0 (tetrahedron) and cell 1 "
            "(tetrahedron); expected at most two volumes at every face");
}

TEST(MeshCheck, RefusesAnEdgeOfThreePolygons) {
  expect_part(refused(mesh_of(cube, {{CellKind::triangle, {0, 1, 2}},
                                     {CellKind::triangle, {1, 0, 5}},
                                     {CellKind::quadrilateral, {0, 1, 6, 7}}})),
              "cell 2 (quadrilateral) shares the edge of points 0, 1 with cell 0 (triangle) and cell 1 (triangle)");
}

TEST(MeshCheck, RefusesCellsWithoutVolumeOrArea) {
  expect_part(refused(mesh_of(cube, {{CellKind::tetrahedron, {0, 1, 2, 3}}})), "expected a volume that is not zero");
  // not quite coplanar, but no thicker than rounding would make it
  auto points = cube;
  points[3].z() = 1e-15;
  expect_part(refused(mesh_of(points, {{CellKind::tetrahedron, {0, 1, 2, 3}}})), "expected a volume that is not zero");
  points = cube;
  points[2] = {2, 0, 0};
  expect_part(refused(mesh_of(points, {{CellKind::triangle, {0, 1, 2}}})), "expected an area that is not zero");
}

TEST(MeshCheck, SeesThroughAFlatHexahedronFarFromTheOrigin) {
  auto points = cube;
  for (auto& x : points) x = Eigen::Vector3d(x[0] + 1e6, x[1] + 3e6, 1e6);
  expect_part(refused(mesh_of(points, {{CellKind::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}}})), "has the measure");
}

TEST(MeshCheck, RefusesCoordinatesTooLargeOrTooSmallToMeasure) {
  for (const double scale : {1e200, 1e-200}) {
    auto points = cube;
    for (auto& x : points) x *= scale;
    expect_part(refused(mesh_of(points, {{CellKind::tetrahedron, {0, 1, 3, 4}}})), "file:11: cell 0 (tetrahedron) has");
  }
}

TEST(MeshCheck, AllowsSmallBodiesAndThinCells) {
  auto points = cube;
  for (auto& x : points) x *= 1e-9;
  points[4].z() *= 1e-6;
  LoadedMesh loaded = mesh_of(points, {{CellKind::tetrahedron, {0, 1, 3, 4}}});
  check_and_repair(loaded, "file");
  EXPECT_TRUE(loaded.notices.empty());
}

TEST(MeshCheck, NotesPointsThatCoincideAsInATornBody) {
  auto points = cube;
  points[7] = points[1];
  LoadedMesh loaded = mesh_of(points, {{CellKind::tetrahedron, {0, 1, 3, 4}}});
  check_and_repair(loaded, "file");
  EXPECT_EQ(loaded.notices,
            (std::vector<std::string>{
                "1 point coincides with another one, as in a torn body; for example points 1 and 7; --weld "
                "2e-06, or \"weld\": 2e-06 in the body of a scene, would join them"}));
}

// Of several faults the one with the lowest points is named, wherever it stands.
TEST(MeshCheck, NamesTheLowestOfSeveralFaults) {
  const std::vector<Eigen::Vector3d> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0},  {0, 0, 1}, {0, 0, -1},
                                            {1, 1, 1}, {9, 0, 0}, {10, 0, 0}, {9, 1, 0}, {9, 0, 1}};
  constexpr CellKind tetrahedron = CellKind::tetrahedron;
  expect_part(refused(mesh_of(points, {{tetrahedron, {6, 7, 8, 9}},
                                       {tetrahedron, {9, 8, 7, 6}},
                                       {tetrahedron, {0, 1, 2, 3}},
                                       {tetrahedron, {4, 1, 2, 0}},
                                       {tetrahedron, {3, 2, 1, 0}}})),
              "cell 4 (tetrahedron) has the same points as cell 2 (tetrahedron)");
  expect_part(refused(mesh_of(points, {{tetrahedron, {1, 2, 3, 9}},
                                       {tetrahedron, {1, 3, 2, 8}},
                                       {tetrahedron, {3, 2, 1, 7}},
                                       {tetrahedron, {0, 1, 2, 6}},
                                       {tetrahedron, {2, 1, 0, 4}},
                                       {tetrahedron, {1, 0, 2, 5}}})),
              "cell 5 (tetrahedron) shares the face of points 0, 1, 2 with cell 3 (tetrahedron) and cell 4");
}

}  // namespace
}  // namespace dartboard::mesh_check_test
