// Cells whose corners do not go round their faces. Another test checks that elements refuse the same cells.

#include "core/meshes/formats/crossed_cells.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>
#include <tuple>
#include <utility>

#include "core/meshes/generators/mesh_generators.h"
#include "tests/support/meshes/mesh_samples.h"

namespace dartboard::crossed_cells_test {
namespace {

using namespace samples;
using Nodes = std::vector<std::uint32_t>;

CrossedCells of_cell(CellKind kind, const Nodes& nodes, const std::vector<Eigen::Vector3d>& points = cube) {
  Mesh mesh;
  mesh.points = points;
  mesh.add_cell(kind, nodes);
  return find_crossed_cells(mesh);
}

constexpr std::string_view voxels = R"(MeshVersionFormatted 2 Dimension 3 Vertices 12
0 0 0 0
1.1 0 0 0
0 1 0.1 0
1 1 0 0
0 0 1 0
1 0 1.1 0
0 1 1 0
1 1.1 1 0
0 0 2 0
1 0 2 0
0 1 2 0
1 1 2 0
Hexahedra 2
1 2 4 3 5 6 8 7 0
5 6 7 8 9 10 11 12 0
End
)";

TEST(CrossedCells, AreThoseOfEveryKindInVoxelOrder) {
  for (const auto& [kind, nodes, swap] :
       {std::tuple{CellKind::hexahedron, Nodes{0, 1, 3, 2, 4, 5, 7, 6},
                   "swap the third and fourth, and the seventh and eighth points"},
        {CellKind::hexahedron, Nodes{0, 1, 3, 2, 4, 5, 6, 7},
         "swap the third and fourth points of each such cell, or give it VTK's type"},
        {CellKind::hexahedron, Nodes{0, 1, 2, 3, 4, 5, 7, 6}, "swap the seventh and eighth points"},
        {CellKind::pyramid, Nodes{0, 1, 3, 2, 4}, "swap the third and fourth points"},
        {CellKind::prism, Nodes{0, 1, 3, 4, 7, 5}, "swap the fifth and sixth points"},
        {CellKind::prism, Nodes{0, 1, 4, 3, 5, 7}, "swap the third and fourth points"},
        {CellKind::quadrilateral, Nodes{0, 1, 3, 2}, "swap the third and fourth"}}) {
    const CrossedCells crossed = of_cell(kind, nodes);
    EXPECT_EQ(crossed.cells, (Nodes{0})) << name(kind);
    EXPECT_EQ(crossed.voxel_order, 1u) << name(kind);
    EXPECT_EQ(crossed.found(),
              "1 cell is crossed, with corners that do not go round its faces: cell 0; it looks like "
              "voxel order");
    expect_part(crossed.remedy(), std::string("corners in the order of Gmsh and VTK: ") + swap);
  }
}

TEST(CrossedCells, AreNotThoseOfEitherHand) {
  for (const auto& [kind, nodes] : {std::pair{CellKind::hexahedron, Nodes{4, 5, 6, 7, 0, 1, 2, 3}},
                                    {CellKind::hexahedron, Nodes{0, 1, 2, 3, 4, 5, 6, 7}},
                                    {CellKind::pyramid, Nodes{0, 3, 2, 1, 6}},
                                    {CellKind::prism, Nodes{0, 3, 1, 4, 7, 5}},
                                    {CellKind::tetrahedron, Nodes{0, 3, 1, 4}},
                                    {CellKind::quadrilateral, Nodes{3, 2, 1, 0}}})
    EXPECT_FALSE(of_cell(kind, nodes).any()) << name(kind);
  for (const Mesh& mesh : {mixed_box(2, 2, 2, 1.0), hexahedron_box(2, 1, 1, 1e-6), quad_sheet(3, 2, 1e6)})
    EXPECT_FALSE(find_crossed_cells(mesh).any());
}

// A corner in the middle of the edge between its neighbours, and beyond it: an arrow.
TEST(CrossedCells, AreNotQuadrilateralsWithOneCornerThatTurnsBack) {
  for (const double at : {0.5, 0.3}) {
    const std::vector<Eigen::Vector3d> points{{0, 0, 0}, {1, 0, 0}, {at, at, 0}, {0, 1, 0}};
    EXPECT_FALSE(of_cell(CellKind::quadrilateral, {0, 1, 2, 3}, points).any()) << at;
  }
}

// If it lies in the middle of its neighbours the Jacobian of a corner is zero, and beyond it negative; at the Gauss
// points it is positive.
TEST(CrossedCells, AreNotHexahedraThatBendBackAtOneCornerAlone) {
  for (const double at : {0.5, 0.45}) {
    auto points = cube;
    points[6] = {at, at, 1};
    EXPECT_FALSE(of_cell(CellKind::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}, points).any()) << at;
  }
}

/// A triangle and another above it, larger or smaller, turned and shifted, each corner moved by up to a share of the
/// height, which is at most one; of either hand.
std::vector<Eigen::Vector3d> random_prism(std::mt19937_64& random, double twist, double shift, double noise) {
  const auto within = [&random](double a, double b) {
    return a + (b - a) * static_cast<double>(random() >> 11) / 0x1p53;
  };
  const double height = within(0.02, 1.0), larger = within(0.5, 2.0), angle = within(-twist, twist);
  const Eigen::Vector3d shear(within(-shift, shift) * height, within(-shift, shift) * height, height);
  const Eigen::Matrix3d turn = larger * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
  std::vector<Eigen::Vector3d> points;
  for (const double corner : {0.0, 2.0, 4.5})
    points.emplace_back(std::cos(corner) + within(-0.2, 0.2), std::sin(corner) + within(-0.2, 0.2), 0.0);
  const double hand = within(0, 1) < 0.5 ? -1 : 1;
  for (std::size_t k = 0; k < 3; ++k) {
    const Eigen::Vector3d x = points[k];
    points.emplace_back(shear + Eigen::Vector3d((turn * x).x(), (turn * x).y(), 0));
  }
  for (auto& x : points) {
    for (int k = 0; k < 3; ++k) x[k] += within(-noise, noise) * height;
    x.z() *= hand;
  }
  return points;
}

const Nodes prism_nodes{0, 1, 2, 3, 4, 5};

TEST(CrossedCells, AreNotPrismsThatAreFlatShearedOrTwistedByThirtyDegrees) {
  std::mt19937_64 random(1);
  for (const auto& [twist, shift, noise] :
       {std::tuple{0.0, 0.0, 0.0}, {0.52, 0.0, 0.0}, {0.52, 5.0, 0.0}, {0.52, 1.0, 0.1}})
    for (int n = 0; n < 2000; ++n) {
      const auto points = random_prism(random, twist, shift, noise);
      ASSERT_FALSE(of_cell(CellKind::prism, prism_nodes, points).any())
          << twist << ' ' << shift << ' ' << noise << ' ' << n;
    }
}

// Their Jacobians are of one sign at all Gauss points.
TEST(CrossedCells, AreThePrismsWithACornerOfEachEndSwapped) {
  std::mt19937_64 random(2);
  for (const auto& [a, b] : {std::pair{2, 3}, {2, 4}, {0, 4}, {0, 5}, {1, 3}, {1, 5}})
    for (int n = 0; n < 200; ++n) {
      Nodes nodes = prism_nodes;
      std::swap(nodes[static_cast<std::size_t>(a)], nodes[static_cast<std::size_t>(b)]);
      const CrossedCells crossed = of_cell(CellKind::prism, nodes, random_prism(random, 0.0, 3.0, 0.0));
      ASSERT_EQ(crossed.cells, (Nodes{0})) << a << ' ' << b << ' ' << n;
      ASSERT_EQ(crossed.voxel_order, a == 2 && b == 3 ? 1u : 0u) << a << ' ' << b << ' ' << n;
    }
}

/// The number of right-handed corners of a prism.
int right_handed_corners(const Nodes& nodes, const std::vector<Eigen::Vector3d>& points) {
  int count = 0;
  for (std::size_t k = 0; k < 6; ++k) {
    const std::size_t end = k / 3 * 3;
    const auto x = [&](std::size_t n) { return points[nodes[n]]; };
    const Eigen::Vector3d a = x(end + (k + 1) % 3) - x(k), b = x(end + (k + 2) % 3) - x(k);
    count += a.cross(b).dot(x(k % 3 + 3) - x(k % 3)) > 0;
  }
  return count;
}

// Faces twisted by a few degrees leave volumes of either hand at the ends of the axial edge. If all six corners are of
// one hand the cell is valid as it is, even if another order is better; most of the others are found.
TEST(CrossedCells, AreTheTwistedPrismsWithACornerOfEachEndSwappedThatTurnOverAtACorner) {
  std::mt19937_64 random(3);
  const Nodes nodes{0, 1, 3, 2, 4, 5};
  int turned_over = 0, found = 0;
  for (int n = 0; n < 1000; ++n) {
    const auto points = random_prism(random, 0.05, 1.0, 0.02);
    const int right = right_handed_corners(nodes, points);
    const bool is_found = of_cell(CellKind::prism, nodes, points).any();
    const bool is_of_one_hand = right % 6 == 0;
    ASSERT_FALSE(is_of_one_hand && is_found) << n;
    turned_over += !is_of_one_hand;
    found += is_found;
  }
  EXPECT_GT(found, 500);
  EXPECT_LT(turned_over, 900);
}

TEST(CrossedCells, OfEqualLobesAreCrossedThoughTheyHaveNoMeasure) {
  const std::string_view square = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3 4\n";
  expect_part(refusal(square, MeshFormat::obj), "file:5: 1 cell is crossed");
  EXPECT_EQ(parse_mesh(square, MeshFormat::obj, "file", {.weld = {}, .keep_crossed = true}).crossed.cells, (Nodes{0}));
}

TEST(CrossedCells, WithoutVolumeAreFlatAndNotCrossed) {
  auto points = cube;
  for (auto& x : points) x.z() = 0;
  EXPECT_FALSE(of_cell(CellKind::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}, points).any());
}

TEST(CrossedCells, AreRefusedWithTheLineOfTheFirstAndTheNumbersOfAll) {
  expect_part(refusal(voxels, MeshFormat::medit),
              "file:16: 1 cell is crossed, with corners that do not go round its faces: cell 1; it looks like voxel "
              "order; expected corners in the order of Gmsh and VTK: swap the third and fourth, and the seventh");
  const auto both = with(voxels, "1 2 4 3 5 6 8 7", "1 2 3 4 5 6 7 8");
  expect_part(
      refusal(both, MeshFormat::medit),
      "file:15: 2 cells are crossed, with corners that do not go round their faces: cells 0, 1; they look like");
}

TEST(CrossedCells, AreListedWhereTheyAreKept) {
  const LoadedMesh loaded = parse_mesh(voxels, MeshFormat::medit, "file", {.weld = {}, .keep_crossed = true});
  EXPECT_EQ(loaded.mesh.cell_count(), 2u);
  EXPECT_EQ(loaded.crossed.cells, (Nodes{1}));
  EXPECT_EQ(loaded.crossed.voxel_order, 1u);
}

}  // namespace
}  // namespace dartboard::crossed_cells_test
