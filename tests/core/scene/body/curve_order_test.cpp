// Large bodies are stored along a space-filling curve where their mesh is in no good order.

#include "core/mechanics/curve_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <map>
#include <memory>
#include <numeric>

#include "core/meshes/generators/mesh_generators.h"
#include "core/meshes/mesh_io.h"
#include "core/plain/random.h"
#include "core/scene/body/simulated_body.h"
#include "tests/support/folder_for_tests.h"
#include "tests/support/moving_box.h"

namespace dartboard::curve_order_test {
namespace {

using namespace moving;
using Eigen::Vector3d;

std::vector<std::uint32_t> shuffled(std::size_t size, std::uint64_t seed) {
  std::vector<std::uint32_t> order(size);
  std::iota(order.begin(), order.end(), 0u);
  SplitMix64 random(seed);
  for (std::size_t k = size; k > 1; --k) std::swap(order[k - 1], order[random.below(static_cast<std::uint32_t>(k))]);
  return order;
}
Mesh with_shuffled_cells(const Mesh& mesh, std::uint64_t seed) {
  Problem problem;
  problem.mesh = mesh;
  return in_order(problem, shuffled(mesh.cell_count(), seed)).mesh;
}
Vector3d middle_of(const Mesh& mesh, std::uint32_t c) {
  Vector3d sum(0, 0, 0);
  for (const std::uint32_t p : mesh.cell(c)) sum += mesh.points[p];
  return sum / static_cast<double>(mesh.cell(c).size());
}

// 16 cubes along each axis, so each step of the curve is the edge of one.
TEST(CurveOrder, GoesFromEachCubeOfALatticeToANeighbour) {
  const Mesh mesh = with_shuffled_cells(hexahedron_box(16, 16, 16, 0.5), 1);
  const std::vector<std::uint32_t> order = order_along_curve(mesh);
  std::vector<std::uint32_t> cells = order;
  std::ranges::sort(cells);
  ASSERT_EQ(cells, order_of_mesh(mesh));
  for (std::size_t k = 0; k + 1 < order.size(); ++k)
    EXPECT_NEAR((middle_of(mesh, order[k + 1]) - middle_of(mesh, order[k])).norm(), 0.5, 1e-12) << k;
}

TEST(CurveOrder, IsThatOfTheMeshWhereNumbersOfNeighboursAreClose) {
  EXPECT_TRUE(order_along_curve(hexahedron_box(16, 16, 16, 0.5)).empty());
  EXPECT_TRUE(order_along_curve(with_shuffled_cells(hexahedron_box(15, 15, 15, 0.5), 1)).empty());  // 4096 points
  EXPECT_TRUE(order_along_curve(Mesh()).empty());
}

TEST(CurveOrder, OfAMeshThatIsNotFiniteOrAPointIsThatOfTheMesh) {
  Mesh mesh = with_shuffled_cells(hexahedron_box(16, 16, 16, 0.5), 1);
  Mesh point = mesh;
  for (Vector3d& x : point.points) x.setZero();
  EXPECT_TRUE(order_along_curve(point).empty());
  mesh.points[7].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(order_along_curve(mesh).size(), mesh.cell_count());
}

TEST(CurveOrder, LeavesFewWideCellsOfAShuffledBox) {
  const Mesh mesh = with_shuffled_cells(kuhn_box(20, 20, 20, 0.1), 3);
  const std::size_t shuffled_ones = count_wide_cells(mesh, order_of_mesh(mesh));
  EXPECT_GT(shuffled_ones, mesh.cell_count() / 4);
  EXPECT_LT(count_wide_cells(mesh, order_along_curve(mesh)), shuffled_ones / 8);
}

// Materials go with their cells, and needs refer to the mesh as it is given.
TEST(CurveOrder, TakesMaterialsAlong) {
  Problem problem;
  problem.mesh = kuhn_box(1, 1, 1, 1.0);
  problem.materials.resize(2);
  problem.cell_material = {0, 1, 1, 0, 1, 0};
  const std::vector<std::uint32_t> order{3, 1, 5, 0, 2, 4};
  const Problem ordered = in_order(problem, order);
  for (std::uint32_t k = 0; k < 6; ++k) {
    EXPECT_EQ(ordered.cell_material[k], problem.cell_material[order[k]]);
    EXPECT_TRUE(std::ranges::equal(ordered.mesh.cell(k), problem.mesh.cell(order[k])));
  }
}

using CurveOrderOfFiles = FolderTest;

// One scene over a mesh in the order of its lattice and over the same cells shuffled: selections by the numbers of the
// file, pressures, attachments of materials and removals find the same cells.
TEST_F(CurveOrderOfFiles, IsNotNoticedByScenes) {
  const Mesh mesh = kuhn_box(17, 16, 16, 0.0625);
  const std::vector<std::uint32_t> order = shuffled(mesh.cell_count(), 5);
  std::vector<std::uint32_t> number(order.size());  // in the shuffled mesh
  for (std::uint32_t k = 0; k < order.size(); ++k) number[order[k]] = k;
  write_medit(folder_ / "lattice.mesh", mesh);
  write_medit(folder_ / "shuffled.mesh", with_shuffled_cells(mesh, 5));
  ASSERT_FALSE(order_along_curve(with_shuffled_cells(mesh, 5)).empty());

  for (const bool with_events : {false, true}) {
    const auto simulate = [&](const char* name, const std::vector<std::uint32_t>& ids) {
      Json scene = moving_box();
      scene["duration"] = 0.004;
      scene["material"]["young"] = 5000;
      scene["material"].erase("stiffness");
      scene["body"] = {{"mesh", name}};
      scene["regions"] = Json::parse(R"([{"cells": {"ids": []}, "material": {"density": 500, "young": 9000}}])");
      scene["regions"][0]["cells"]["ids"] = ids;
      scene["forces"] = Json::parse(R"([{"plane": {"point": [1.0625, 0, 0], "normal": [1, 0, 0]}, "pressure": 900,
                                         "normals": "current"}])");
      if (with_events) {
        scene["events"] = Json::parse(R"([{"at": 0.001, "remove": {"ids": []}},
          {"at": 0.002, "dissociate": {"plane": {"point": [0.5, 0, 0], "normal": [1, 0.1, 0]}}}])");
        scene["events"][0]["remove"]["ids"] = ids;
      }
      auto simulation = std::make_unique<Simulation>(parse_scene(scene.dump(), name, folder_));
      run(*simulation);
      return simulation;
    };
    std::vector<std::uint32_t> ids(300), ids_there;
    std::iota(ids.begin(), ids.end(), 9000u);
    for (const std::uint32_t c : ids) ids_there.push_back(number[c]);
    const auto a = simulate("lattice.mesh", ids), b = simulate("shuffled.mesh", ids_there);
    const CellCounts counts = a->body().counts(), counts_b = b->body().counts();
    EXPECT_EQ(counts.cells, mesh.cell_count() - (with_events ? 300 : 0));
    EXPECT_EQ(counts.cells, counts_b.cells);
    EXPECT_EQ(counts.vertices, counts_b.vertices);
    EXPECT_EQ(counts.components, counts_b.components);
    const Frame fa = a->frame({}), fb = b->frame({});
    ASSERT_EQ(fa.mesh_point.size(), fb.mesh_point.size());
    EXPECT_EQ(fa.mesh_point, fb.mesh_point);
    std::map<std::uint32_t, std::uint8_t> material;
    for (std::size_t c = 0; c < fa.mesh_cell.size(); ++c) material[fa.mesh_cell[c]] = fa.material[c];
    std::map<std::uint32_t, Vector3d> middle;
    for (std::uint32_t c = 0; c < fa.mesh_cell.size(); ++c) middle[fa.mesh_cell[c]] = middle_of(fa.mesh, c);
    double farthest = 0.0;
    for (std::uint32_t c = 0; c < fb.mesh_cell.size(); ++c) {
      const std::uint32_t same = order[fb.mesh_cell[c]];
      EXPECT_EQ(fb.material[c], material.at(same));
      farthest = std::max(farthest, (middle_of(fb.mesh, c) - middle.at(same)).norm());
    }
    EXPECT_LE(farthest, 1e-13);
    EXPECT_EQ(b->body().violation(), "");
  }
}

TEST_F(CurveOrderOfFiles, LeavesTheNumberOfAWrongCellThatOfTheFile) {
  Mesh mesh = with_shuffled_cells(kuhn_box(16, 16, 16, 0.0625), 2);
  mesh.nodes[mesh.first[777]] = mesh.nodes[mesh.first[777] + 1];
  Problem problem;
  problem.mesh = mesh;
  problem.material = {.density = 1, .stiffness = 1};
  for (const bool changes : {false, true}) {
    try {
      make_simulated_body(problem, changes);
      FAIL();
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find("cell 777"), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace dartboard::curve_order_test
