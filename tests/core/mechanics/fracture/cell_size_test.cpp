#include "core/mechanics/fracture/cell_size.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <vector>

#include "core/plain/random.h"

namespace dartboard::cell_size_test {
namespace {

using Eigen::Vector3d;
using Listing = std::vector<std::size_t>;
constexpr double u = std::numeric_limits<double>::epsilon() / 2;

struct Kind {
  CellKind kind;
  std::vector<Vector3d> corners;        // of the cell that it is named after, without a skew
  std::vector<Listing> other_listings;  // of the same cell, with other first corners; some inside out
};

const Vector3d o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> table{
      {CellKind::triangle, {o, x, y}, {{1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {1, 0, 2}, {2, 1, 0}}},
      {CellKind::quadrilateral, {o, x, x + y, y}, {{1, 2, 3, 0}, {2, 3, 0, 1}, {3, 2, 1, 0}, {0, 3, 2, 1}}},
      {CellKind::tetrahedron, {o, x, y, z}, {{1, 2, 0, 3}, {3, 0, 2, 1}, {2, 3, 0, 1}, {0, 2, 1, 3}, {3, 2, 1, 0}}},
      {CellKind::pyramid, {o, x, x + y, y, z}, {{1, 2, 3, 0, 4}, {2, 3, 0, 1, 4}, {3, 2, 1, 0, 4}, {0, 3, 2, 1, 4}}},
      {CellKind::prism, {o, x, y, z, x + z, y + z}, {{1, 2, 0, 4, 5, 3}, {3, 5, 4, 0, 2, 1}, {0, 2, 1, 3, 5, 4}}},
      {CellKind::hexahedron,
       {o, x, x + y, y, z, x + z, x + y + z, y + z},
       {{1, 2, 3, 0, 5, 6, 7, 4}, {0, 4, 5, 1, 3, 7, 6, 2}, {6, 7, 4, 5, 2, 3, 0, 1}, {0, 3, 2, 1, 4, 7, 6, 5}}},
  };
  return table;
}

std::vector<Vector3d> listed(const std::vector<Vector3d>& corners, const Listing& listing) {
  std::vector<Vector3d> list;
  for (const std::size_t k : listing) list.push_back(corners[k]);
  return list;
}

std::vector<Vector3d> skewed(const std::vector<Vector3d>& corners, SplitMix64& random, double by) {
  std::vector<Vector3d> moved = corners;
  for (Vector3d& p : moved)
    for (double& c : p) c += by * random.next_signed();
  return moved;
}

double measure(CellKind kind, const std::vector<Vector3d>& corners) {
  Mesh mesh;
  mesh.points = corners;
  std::vector<std::uint32_t> nodes(corners.size());
  std::iota(nodes.begin(), nodes.end(), 0u);
  mesh.add_cell(kind, nodes);
  return signed_measure(mesh, 0);
}

// Numbers of a few bits: exact.
TEST(CellSize, OfCellsOfAUnitCubeIsItsShare) {
  const double expected[] = {0.5, 1.0, 1.0 / 6, 1.0 / 3, 0.5, 1.0};
  for (std::size_t k = 0; k < kinds().size(); ++k)
    EXPECT_DOUBLE_EQ(cell_size(kinds()[k].kind, kinds()[k].corners), expected[k]);
}

// Both decompose a skew cell by the middles of its faces. Neither sums more than 24 terms, of some 10 operations, each
// of at most 2^3: sides are below 2.
TEST(CellSize, OfASkewCellIsItsMeasure) {
  SplitMix64 random(3);
  for (const Kind& k : kinds())
    for (int trial = 0; trial < 200; ++trial) {
      const auto corners = skewed(k.corners, random, 0.4);
      EXPECT_NEAR(cell_size(k.kind, corners), std::abs(measure(k.kind, corners)), 24 * 10 * 8 * u) << name(k.kind);
    }
}

TEST(CellSize, HasTheSameBitsHoweverTheCornersAreListed) {
  SplitMix64 random(4);
  for (const Kind& k : kinds())
    for (int trial = 0; trial < 200; ++trial) {
      const auto corners = skewed(k.corners, random, 0.4);
      const double size = cell_size(k.kind, corners);
      for (const Listing& listing : k.other_listings)
        EXPECT_EQ(cell_size(k.kind, listed(corners, listing)), size) << name(k.kind);
    }
}

TEST(CellSize, OfAFlatCellIsZeroAndOfNoNumberNone) {
  for (const Kind& k : kinds()) {
    auto corners = k.corners;
    for (Vector3d& p : corners) p = Vector3d(p.x(), p.x(), p.x());
    EXPECT_EQ(cell_size(k.kind, corners), 0.0) << name(k.kind);
    corners.back().y() = std::numeric_limits<double>::quiet_NaN();
    EXPECT_TRUE(std::isnan(cell_size(k.kind, corners))) << name(k.kind);
  }
}

TEST(CellSize, KnowsKindsByTheirCorners) {
  for (const Kind& k : kinds()) EXPECT_EQ(kind_of_corners(dimension(k.kind), k.corners.size()), k.kind);
}

}  // namespace
}  // namespace dartboard::cell_size_test
