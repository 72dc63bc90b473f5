#include "core/plain/diagonals.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace dartboard::diagonals_test {
namespace {

using Eigen::Vector3d;

std::size_t count(CellKind kind, Diagonals which) { return diagonals_of(kind, which).size(); }

TEST(Diagonals, JoinTheCornersThatNoEdgeJoins) {
  EXPECT_EQ(count(CellKind::hexahedron, Diagonals::faces), 12u);
  EXPECT_EQ(count(CellKind::hexahedron, Diagonals::volumes), 4u);
  EXPECT_EQ(count(CellKind::prism, Diagonals::faces), 6u);
  EXPECT_EQ(count(CellKind::prism, Diagonals::volumes), 0u);
  EXPECT_EQ(count(CellKind::pyramid, Diagonals::faces), 2u);
  EXPECT_EQ(count(CellKind::quadrilateral, Diagonals::faces), 2u);
  for (const CellKind kind : {CellKind::triangle, CellKind::tetrahedron})
    for (const Diagonals which : {Diagonals::none, Diagonals::faces, Diagonals::volumes, Diagonals::all})
      EXPECT_EQ(count(kind, which), 0u);
  // with the edges, every pair of corners once
  for (int k = 0; k <= static_cast<int>(CellKind::hexahedron); ++k) {
    const auto kind = static_cast<CellKind>(k);
    const int n = node_count(kind);
    std::vector<int> met(64, 0);
    for (const auto springs : {edges_beside(kind, Diagonals::all), diagonals_of(kind, Diagonals::all)})
      for (const CornerSpring& s : springs) {
        EXPECT_LT(s.a, s.b);
        ++met[static_cast<std::size_t>(8 * s.a + s.b)];
      }
    for (int a = 0; a < n; ++a)
      for (int b = a + 1; b < n; ++b) EXPECT_EQ(met[static_cast<std::size_t>(8 * a + b)], 1) << name(kind);
  }
}

/// The elasticity of springs of these weights together, over the volume: sum of weight n_i n_j n_k n_l.
std::array<double, 81> elasticity(CellKind kind, Diagonals which, const std::vector<Vector3d>& x) {
  std::array<double, 81> tensor{};
  for (const auto springs : {edges_beside(kind, which), diagonals_of(kind, which)})
    for (const CornerSpring& s : springs) {
      const Vector3d n = (x[static_cast<std::size_t>(s.b)] - x[static_cast<std::size_t>(s.a)]).normalized();
      for (std::size_t k = 0; k < 81; ++k)
        tensor[k] += s.weight * n[static_cast<int>(k / 27)] * n[static_cast<int>(k / 9 % 3)] *
                     n[static_cast<int>(k / 3 % 3)] * n[static_cast<int>(k % 3)];
    }
  return tensor;
}

/// An isotropic one of Lame's two equal moduli.
void expect_isotropic(const std::array<double, 81>& tensor, double modulus, int dimension) {
  const auto same = [](std::size_t a, std::size_t b) { return a == b ? 1.0 : 0.0; };
  for (std::size_t k = 0; k < 81; ++k) {
    const std::array<std::size_t, 4> i{k / 27, k / 9 % 3, k / 3 % 3, k % 3};
    const bool within =
        std::ranges::all_of(i, [&](std::size_t axis) { return axis < static_cast<std::size_t>(dimension); });
    const double expected = within
                                ? modulus * (same(i[0], i[1]) * same(i[2], i[3]) + same(i[0], i[2]) * same(i[1], i[3]) +
                                             same(i[0], i[3]) * same(i[1], i[2]))
                                : 0.0;
    EXPECT_NEAR(tensor[k], expected, 1e-14) << k;
  }
}

const std::vector<Vector3d> cube{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                 {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

// lambda = mu = 0.4 E is Poisson's ratio 1/4 in a solid; 3/8 E is 1/3 in a sheet.
TEST(Diagonals, MakeCubesPrismsAndSquaresIsotropic) {
  for (const Diagonals which : {Diagonals::faces, Diagonals::volumes, Diagonals::all})
    expect_isotropic(elasticity(CellKind::hexahedron, which, cube), 0.4, 3);
  const double h = std::sqrt(3.0) / 2;
  expect_isotropic(elasticity(CellKind::prism, Diagonals::faces,
                              {{0, 0, 0}, {1, 0, 0}, {0.5, h, 0}, {0, 0, 1}, {1, 0, 1}, {0.5, h, 1}}),
                   0.4, 3);
  expect_isotropic(elasticity(CellKind::quadrilateral, Diagonals::faces, {cube[0], cube[1], cube[2], cube[3]}), 0.375,
                   2);
}

TEST(Diagonals, MakeTheSixPyramidsOfACubeIsotropic) {
  const std::vector<Vector3d> up{cube[0], cube[1], cube[2], cube[3], {0.5, 0.5, 0.5}};
  std::array<double, 81> sum{};
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<Vector3d> x;
    for (const Vector3d& p : up) x.emplace_back(p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]);
    const auto one = elasticity(CellKind::pyramid, Diagonals::faces, x);
    for (std::size_t k = 0; k < 81; ++k) sum[k] += one[k] / 3;
  }
  expect_isotropic(sum, 0.4, 3);
}

TEST(Diagonals, LeaveEdgesAsTheyAreWhereACellHasNone) {
  for (const auto& [kind, which] : {std::pair{CellKind::hexahedron, Diagonals::none},
                                    {CellKind::prism, Diagonals::volumes},
                                    {CellKind::tetrahedron, Diagonals::all}})
    for (const CornerSpring& edge : edges_beside(kind, which)) EXPECT_EQ(edge.weight, 1.0);
}

}  // namespace
}  // namespace dartboard::diagonals_test
