#include "core/places/joined_boxes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/plain/random.h"

namespace dartboard::joined_boxes_test {
namespace {

using Eigen::Vector3d;

constexpr double infinity = std::numeric_limits<double>::infinity();

double area_of(const JoinedBoxes& boxes, std::size_t box) {
  double sum = 0.0;
  for (const SpannedBox& part : boxes.surface(box)) {
    double area = 1.0;
    for (int k = 0; k < 3; ++k)
      if (part.low[k] < part.high[k]) area *= part.high[k] - part.low[k];
    sum += area;
  }
  return sum;
}

/// The cells between all coordinates of the boxes, and beyond them: each is inside of a box or outside of all.
struct Grid {
  std::array<std::vector<double>, 3> at;
  std::span<const SpannedBox> boxes;

  explicit Grid(std::span<const SpannedBox> all) : boxes(all) {
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = {-infinity, infinity};
      for (const SpannedBox& box : boxes)
        for (const Vector3d& corner : {box.low, box.high}) at[k].push_back(corner[static_cast<int>(k)]);
      std::ranges::sort(at[k]);
    }
  }
  /// The distance of a place from the nearest cell that is in no box.
  double distance(const Vector3d& x) const {
    double least = infinity;
    for (std::size_t i = 0; i + 1 < at[0].size(); ++i)
      for (std::size_t j = 0; j + 1 < at[1].size(); ++j)
        for (std::size_t k = 0; k + 1 < at[2].size(); ++k) {
          const Vector3d low(at[0][i], at[1][j], at[2][k]), high(at[0][i + 1], at[1][j + 1], at[2][k + 1]);
          if (!(low.array() < high.array()).all()) continue;
          const bool taken = std::ranges::any_of(boxes, [&](const SpannedBox& box) {
            return (box.low.array() <= low.array()).all() && (high.array() <= box.high.array()).all();
          });
          if (!taken) least = std::min(least, (x.cwiseMax(low).cwiseMin(high) - x).norm());
        }
    return least;
  }
};

TEST(JoinedBoxes, HaveNoSurfaceBetweenThem) {
  const JoinedBoxes boxes({{{0, 0, 0}, {1, 1, 1}}, {{1, 0, 0}, {3, 1, 1}}});
  EXPECT_EQ(area_of(boxes, 0), 5.0);
  EXPECT_EQ(area_of(boxes, 1), 2.0 * 4 + 1.0);
  EXPECT_TRUE(boxes.contains({1, 0.5, 0.5}));
  EXPECT_FALSE(boxes.contains({3.5, 0.5, 0.5}));
  const WayToSurface out = boxes.nearest(0, {1, 0.5, 0.75});
  EXPECT_EQ(out.distance, 0.25);
  EXPECT_EQ(out.way, Vector3d(0, 0, 0.25));
  EXPECT_EQ(out.point, Vector3d(1, 0.5, 1));
}

TEST(JoinedBoxes, KeepThePartOfAFaceThatIsNotCovered) {
  const JoinedBoxes boxes({{{0, 0, 0}, {1, 1, 1}}, {{1, 0.25, 0.25}, {2, 0.75, 0.75}}});
  EXPECT_EQ(area_of(boxes, 0), 6.0 - 0.25);
  EXPECT_EQ(area_of(boxes, 1), 4 * 0.5 + 0.25);
  // from the middle of the covered part the way leads to its edge
  EXPECT_EQ(boxes.nearest(0, {0.75, 0.5, 0.625}).way, Vector3d(0.25, 0, 0.125));
}

TEST(JoinedBoxes, KeepFacesInOnePlaneThatLookTheSameWay) {
  const JoinedBoxes boxes({{{0, 0, 0}, {2, 1, 1}}, {{1, 0, 0}, {3, 1, 1}}});
  EXPECT_EQ(area_of(boxes, 0), 4 * 2.0 + 1.0);
  EXPECT_EQ(area_of(boxes, 1), 4 * 2.0 + 1.0);
}

TEST(JoinedBoxes, HaveNoSurfaceOfABoxInsideOfOthers) {
  const JoinedBoxes boxes({{{0, 0, 0}, {2, 1, 1}}, {{2, 0, 0}, {4, 1, 1}}, {{1, 0.25, 0.25}, {3, 0.5, 0.5}}});
  EXPECT_TRUE(boxes.has_surface(0));
  EXPECT_TRUE(boxes.has_surface(1));
  EXPECT_FALSE(boxes.has_surface(2));
}

TEST(JoinedBoxes, CloseAGapOfRoundingAndNoOther) {
  for (const double size : {1.0, 1e3}) {
    const SpannedBox box{{0, 0, 0}, {size, size, size}};
    const auto next_to_it = [&](double gap) { return SpannedBox{{size + gap, 0, 0}, {2 * size, size, size + gap}}; };
    for (const double gap : {1e-13 * size, -1e-13 * size}) {
      EXPECT_TRUE(are_joined(box, next_to_it(gap)));
      const JoinedBoxes joined({box, next_to_it(gap)});
      EXPECT_NEAR(area_of(joined, 0) + area_of(joined, 1), 10 * size * size, 1e-9 * size * size);
      EXPECT_TRUE(joined.contains({size * (1 + 1e-16), 0.5 * size, 0.5 * size}));
    }
    EXPECT_FALSE(are_joined(box, next_to_it(1e-11 * size)));
  }
}

TEST(JoinedBoxes, AreNotJoinedByAnEdge) {
  const SpannedBox box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_FALSE(are_joined(box, {{1, 1, 0}, {2, 2, 1}}));
  EXPECT_FALSE(are_joined(box, {{1, 1, 1}, {2, 2, 2}}));
  EXPECT_TRUE(are_joined(box, {{1, 0.5, 0.5}, {2, 2, 2}}));
  EXPECT_TRUE(are_joined(box, {{0.5, 0.5, 0.5}, {2, 2, 2}}));
}

TEST(JoinedBoxes, ReachToInfinity) {
  const JoinedBoxes boxes({{{0, 0, -infinity}, {1, 1, 1}}, {{1, 0, -infinity}, {2, 1, 0.5}}});
  EXPECT_EQ(boxes.nearest(0, {0.75, 0.5, -9}).way, Vector3d(0, -0.5, 0));
  EXPECT_EQ(boxes.nearest(0, {0.875, 0.5, 0.5}).way, Vector3d(0.125, 0, 0));
  EXPECT_EQ(boxes.nearest(1, {1.5, 0.75, -9}).way, Vector3d(0, 0.25, 0));
  for (std::size_t box : {0u, 1u})
    for (const SpannedBox& part : boxes.surface(box)) EXPECT_GT(part.high[2], -infinity);
}

// The witness takes the space apart into cells.
TEST(JoinedBoxes, AreAsDeepAsItIsToTheNearestPlaceOutsideOfAll) {
  SplitMix64 random(7);
  int inside = 0;
  for (int k = 0; k < 400; ++k) {
    const auto coordinate = [&] {
      return k % 2 == 0 ? std::round(4 * random.next_signed()) / 4 : random.next_signed();
    };
    std::vector<SpannedBox> drawn;
    for (int b = 0; b < 2 + k % 4; ++b) {
      SpannedBox box;
      for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = coordinate();
        box.high[axis] = coordinate();
        if (box.low[axis] > box.high[axis]) std::swap(box.low[axis], box.high[axis]);
        box.high[axis] += 0.25;
      }
      drawn.push_back(box);
    }
    const JoinedBoxes boxes(drawn);
    const Grid grid(boxes.boxes());
    for (int n = 0; n < 20; ++n) {
      const double x = coordinate(), y = coordinate();
      const Vector3d place(x, y, coordinate());
      double least = infinity;
      for (std::size_t b = 0; b < drawn.size(); ++b)
        if (boxes.has_surface(b)) least = std::min(least, boxes.nearest(b, place).distance);
      const double depth = boxes.contains(place) ? least : 0.0;
      ASSERT_NEAR(depth, grid.distance(place), 1e-15) << k;
      if (depth > 0.0) ++inside;
    }
  }
  EXPECT_GT(inside, 1000);
}

}  // namespace
}  // namespace dartboard::joined_boxes_test
