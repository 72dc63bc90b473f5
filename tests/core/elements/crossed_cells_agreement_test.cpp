// Elements refuse the same cells for which a mesh is refused, and prisms without volume at a corner: independent code,
// the same Gauss points.

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <random>

#include "core/elements/solids.h"
#include "core/meshes/formats/crossed_cells.h"
#include "tests/support/meshes/mesh_samples.h"

namespace dartboard::crossed_cells_agreement_test {
namespace {

bool has_corner_of_another_hand(const std::vector<Eigen::Vector3d>& x, bool is_left_handed) {
  for (std::size_t k = 0; k < 6; ++k) {
    const std::size_t end = k < 3 ? 0 : 3;
    Eigen::Matrix3d edges;
    edges << x[end + (k + 1) % 3] - x[k], x[end + (k + 2) % 3] - x[k], x[k % 3 + 3] - x[k % 3];
    if ((is_left_handed ? -1.0 : 1.0) * edges.determinant() <= 1e-12) return true;
  }
  return false;
}

TEST(CrossedCellsAndElements, AgreeOnRandomVolumes) {
  std::mt19937_64 random(20100601);
  const auto coordinate = [&random] { return static_cast<double>(random() >> 11) / 9007199254740992.0; };
  const std::vector<std::vector<std::uint32_t>> corners{{0, 1, 2, 3, 4}, {0, 1, 3, 4, 5, 7}, {0, 1, 2, 3, 4, 5, 6, 7}};
  const CellKind kinds[] = {CellKind::pyramid, CellKind::prism, CellKind::hexahedron};
  std::size_t whole = 0, crossed = 0;
  for (std::size_t k = 0; k < 6000; ++k) {
    Mesh mesh;
    mesh.points = samples::cube;
    // from hardly bent to without any shape
    for (auto& x : mesh.points)
      x += static_cast<double>(k % 8) / 3.0 *
           Eigen::Vector3d(coordinate() - 0.5, coordinate() - 0.5, coordinate() - 0.5);
    mesh.add_cell(kinds[k % 3], corners[k % 3]);
    std::vector<Eigen::Vector3d> x;
    for (const std::uint32_t p : mesh.cell(0)) x.push_back(mesh.points[p]);
    const SolidShape shape = solid_shape_of(kinds[k % 3], x);
    bool positive = false, negative = false;
    for (std::size_t q = 0; q < gauss_points(shape.kind); ++q) (shape.volume[q] > 0.0 ? positive : negative) = true;
    const bool found = find_crossed_cells(mesh).any();
    const bool may_be_flat = kinds[k % 3] == CellKind::prism && has_corner_of_another_hand(x, negative);
    EXPECT_TRUE(found == (positive && negative) || (found && may_be_flat)) << k;
    ++(positive && negative ? crossed : whole);
  }
  EXPECT_GT(whole, 500u);
  EXPECT_GT(crossed, 500u);
}

}  // namespace
}  // namespace dartboard::crossed_cells_agreement_test
