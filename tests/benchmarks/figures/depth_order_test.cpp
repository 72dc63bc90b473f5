#include <gtest/gtest.h>

#include <Eigen/Core>
#include <Eigen/Dense>
#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <vector>

#include "benchmarks/figures/body_facets.h"
#include "core/meshes/generators/mesh_generators.h"

namespace dartboard::depth_order_test {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

DrawnFacet facet_of(std::vector<Vector3d> corners, std::uint32_t number) {
  return {.corners = std::move(corners), .base = number};
}
DrawnFacet square(const Vector3d& middle, double half, std::uint32_t number) {
  return facet_of({middle + Vector3d(-half, -half, 0), middle + Vector3d(half, -half, 0),
                   middle + Vector3d(half, half, 0), middle + Vector3d(-half, half, 0)},
                  number);
}
std::vector<std::uint32_t> order_of(std::vector<DrawnFacet> facets) {
  order_by_depth(facets);
  std::vector<std::uint32_t> numbers;
  for (const DrawnFacet& facet : facets) numbers.push_back(facet.base);
  return numbers;
}

// Squares in front of and behind a slope from depth -10 to 10: half of those in front are farther than its middle.
TEST(DepthOrder, PutsWhatIsInFrontOfASlopeAfterItWhateverTheirMiddlesAre) {
  std::vector<DrawnFacet> facets{facet_of({{-10, -1, -10}, {10, -1, 10}, {10, 1, 10}, {-10, 1, -10}}, 0)};
  for (int k = -9; k <= 9; ++k) {
    facets.push_back(square({1.0 * k, 0.5, k + 0.5}, 0.3, 1));
    facets.push_back(square({1.0 * k, -0.5, k - 0.5}, 0.3, 2));
    facets.push_back(facet_of({{k - 0.3, 0, k + 0.5}, {k + 0.3, 0, k + 0.5}}, 1));  // lines
    facets.push_back(facet_of({{k - 0.3, 0, k - 0.5}, {k + 0.3, 0, k - 0.5}}, 2));
    facets.push_back(facet_of({{k + 0.4, 0, k + 0.41}}, 1));  // dots
    facets.push_back(facet_of({{k + 0.4, 0, k + 0.39}}, 2));
  }
  const auto numbers = order_of(facets);
  ASSERT_EQ(numbers.size(), facets.size());
  const auto slope = std::ranges::find(numbers, 0u);
  EXPECT_EQ(std::count(numbers.begin(), slope, 2u), 3 * 19);
  EXPECT_EQ(std::count(slope, numbers.end(), 1u), 3 * 19);
}

TEST(DepthOrder, PutsADotAfterTheFacetsThatMeetInItsVertex) {
  const auto numbers = order_of({facet_of({{0, 0, 0}}, 1), facet_of({{0, 0, 0}, {1, 0, 2}, {0, 1, 2}}, 0),
                                 facet_of({{0, 0, 0}, {0, -1, 5}, {1, 0, 2}}, 0)});
  EXPECT_EQ(numbers, (std::vector{0u, 0u, 1u}));
}

TEST(DepthOrder, DrawsEachOnceOfFacetsThatHideEachOtherInACircle) {
  // three bars of which each begins above the one before and ends below the next
  std::vector<DrawnFacet> facets;
  for (std::uint32_t k = 0; k < 3; ++k) {
    const double turn = 2.0943951023931953 * k;
    const Eigen::Rotation2Dd rotation(turn);
    const auto at = [&](double along, double aside, double depth) {
      const Vector2d x = rotation * Vector2d(along, 1.0 + aside);
      return Vector3d(x.x(), x.y(), depth);
    };
    facets.push_back(facet_of({at(-4, -0.1, 1), at(4, -0.1, -1), at(4, 0.1, -1), at(-4, 0.1, 1)}, k));
  }
  facets.push_back(square({0, 0, 9}, 9, 3));  // in front of all
  const auto numbers = order_of(facets);
  ASSERT_EQ(numbers.size(), 4u);
  EXPECT_EQ(std::set(numbers.begin(), numbers.end()).size(), 4u);
  EXPECT_EQ(numbers.back(), 3u);
}

/// The depth of a facet at a place of the picture that it covers.
std::optional<double> depth_at(const DrawnFacet& facet, const Vector2d& place) {
  for (std::size_t k = 2; k < facet.corners.size(); ++k) {
    Eigen::Matrix3d corners;
    corners << facet.corners[0], facet.corners[k - 1], facet.corners[k];
    Eigen::Matrix3d sums = corners;
    sums.row(2).setOnes();
    const Vector3d weights = sums.inverse() * Vector3d(place.x(), place.y(), 1.0);
    if (weights.minCoeff() >= 0.0) return corners.row(2).dot(weights);
  }
  return {};
}

Frame bodies_of(const std::vector<Mesh>& meshes) {
  Frame frame;
  for (std::uint32_t k = 0; k < meshes.size(); ++k) {
    const auto first = static_cast<std::uint32_t>(frame.mesh.points.size());
    for (const Vector3d& x : meshes[k].points) frame.mesh.points.push_back(x);
    for (std::size_t c = 0; c < meshes[k].cell_count(); ++c) {
      std::vector<std::uint32_t> nodes;
      for (const std::uint32_t node : meshes[k].cell(c)) nodes.push_back(first + node);
      frame.mesh.add_cell(meshes[k].kinds[c], nodes);
      frame.component.push_back(k);
    }
  }
  for (std::uint32_t k = 0; k < frame.mesh.points.size(); ++k) frame.mesh_point.push_back(k);
  return frame;
}
Mesh moved(Mesh mesh, const Vector3d& by) {
  for (Vector3d& x : mesh.points) x += by;
  return mesh;
}

// A box of one cell, smaller ones on it and next to it, each sunk into it by a millimetre, and a sheet below all.
TEST(DepthOrder, DrawsTheNearestLastOfBodiesInContact) {
  const Mesh box = hexahedron_box(1, 1, 1, 1.0), small = hexahedron_box(2, 2, 2, 0.2);
  Mesh sheet = triangle_sheet(2, 2, 2.0);
  const Frame frame = bodies_of({moved(sheet, {-1.5, -1.5, 0.001}), box, moved(small, {0.1, 0.5, 0.999}),
                                 moved(small, {0.999, 0.3, 0.1}), moved(small, {0.3, -0.399, 0.05}),
                                 moved(small, {-0.399, 0.5, 0.2}), moved(small, {0.2, 0.6, 1.398})});
  std::vector<DrawnFacet> facets = BodyFacets({}, frame).of(frame).facets;
  order_by_depth(facets);
  std::size_t seen = 0;
  for (int i = -60; i <= 60; ++i)
    for (int j = -60; j <= 60; ++j) {
      const Vector2d place(0.0301 * i, 0.0303 * j);
      double nearest = -1e9, last = -1e9;
      for (const DrawnFacet& facet : facets)
        if (const auto depth = depth_at(facet, place)) {
          nearest = std::max(nearest, *depth);
          last = *depth;
          ++seen;
        }
      ASSERT_GE(last, nearest - 0.005) << place.transpose();
    }
  EXPECT_GT(seen, 3000u);
}

TEST(DepthOrder, MakesASideThatHidesMoreThanATenthOfTheBodiesAnOutline) {
  for (const int hidden : {2, 3}) {
    DrawnFacet side = square({0, 0, 1}, 10, 99);
    side.of = DrawnFacet::Of::side_of_obstacle;
    DrawnFacet ball = side;
    ball.of = DrawnFacet::Of::ball;
    std::vector<DrawnFacet> facets{side, ball};
    for (int k = 0; k < 20; ++k) facets.push_back(square({0.4 * k - 4, 0, k < hidden ? 0.0 : 2.0}, 0.1, 0));
    order_by_depth(facets);
    for (const DrawnFacet& facet : facets)
      EXPECT_EQ(facet.outline, facet.of == DrawnFacet::Of::side_of_obstacle && hidden == 3);
  }
}

}  // namespace
}  // namespace dartboard::depth_order_test
