// The witness of the remaining cells of a mesh, on a cube whose cells are known; it uses no map.

#include "validation/conservation/remaining_cells.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "core/meshes/generators/mesh_generators.h"

namespace dartboard::remaining_cells_test {
namespace {

using Counts = std::array<std::size_t, 4>;

// Vertices, edges, faces, components.
Counts counts_of(const RemainingCells& cells) {
  Counts counts{0, 0, cells.count_sides(), cells.count_components()};
  cells.for_each_vertex([&](std::uint32_t, auto) { ++counts[0]; });
  cells.for_each_edge([&](std::uint32_t, auto) { ++counts[1]; });
  return counts;
}

// Six tetrahedra around the diagonal of a cube.
TEST(RemainingCellsOfACube, AreJoinedAtSixFaces) {
  const Mesh mesh = kuhn_box(1, 1, 1, 1.0);
  const RemainingCells cells(mesh);
  EXPECT_EQ(cells.count(), 6u);
  EXPECT_EQ(counts_of(cells), (Counts{8, 19, 18, 1}));
  std::size_t most = 0;
  cells.for_each_edge([&](std::uint32_t, auto around) { most = std::max(most, around.size()); });
  EXPECT_EQ(most, 6u);  // the diagonal
}

TEST(RemainingCellsOfACube, ComeApartToSixTetrahedra) {
  const Mesh mesh = kuhn_box(1, 1, 1, 1.0);
  RemainingCells cells(mesh);
  std::size_t joined = 0;
  for (std::uint32_t side = 0; side < cells.first_side(6); ++side) {
    if (!cells.is_joined(side)) continue;
    ++joined;
    cells.dissociate(side);
    EXPECT_FALSE(cells.is_joined(side));
  }
  EXPECT_EQ(joined, 6u);
  EXPECT_EQ(counts_of(cells), (Counts{24, 36, 24, 6}));
}

// One of two neighbours around the diagonal removed: four are left in a fan, and the removed one is not counted.
TEST(RemainingCellsOfACube, AreLeftInAFanWithoutOneOfThem) {
  const Mesh mesh = kuhn_box(1, 1, 1, 1.0);
  RemainingCells cells(mesh);
  cells.remove(0);
  EXPECT_EQ(cells.count(), 5u);
  EXPECT_FALSE(cells.is_there(0));
  // two outer faces and the edge between them are gone; each vertex has other cells
  EXPECT_EQ(counts_of(cells), (Counts{8, 18, 16, 1}));
  EXPECT_EQ(cells.component(1).size(), 5u);
}

TEST(RemainingCellsOfACube, HaveTheAreasOfTheirSides) {
  const Mesh mesh = kuhn_box(1, 1, 1, 2.0);
  const RemainingCells cells(mesh);
  double area = 0.0;
  for (std::uint32_t side = 0; side < cells.first_side(6); ++side)
    if (!cells.is_joined(side)) area += cells.measure(side);
  EXPECT_EQ(area, 6 * 4.0);  // squares of 2 m in halves: exact
}

}  // namespace
}  // namespace dartboard::remaining_cells_test
