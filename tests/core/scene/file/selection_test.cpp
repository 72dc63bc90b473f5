#include "core/scene/file/selections/selection.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"

namespace dartboard::selection_test {
namespace {

const std::vector<Eigen::Vector3d> points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 4, 0}};
using Numbers = std::vector<std::uint32_t>;

Numbers select(const VertexSelection& selection) { return select_points(selection, points, "/fixed/0"); }

TEST(Selection, OfIdsIsThosePointsInOrder) { EXPECT_EQ(select(IdSelection{{3, 1, 3}}), (Numbers{1, 3})); }
TEST(Selection, OfABoxIncludesItsSurface) { EXPECT_EQ(select(BoxSelection{{1, 0, 0}, {2, 0, 0}}), (Numbers{1, 2})); }
TEST(Selection, OfAPlaneIsThePositiveSideAndThePlaneItself) {
  EXPECT_EQ(select(PlaneSelection{{2, 0, 0}, {1, 0, 0}}), (Numbers{2, 3}));
  EXPECT_EQ(select(PlaneSelection{{2, 0, 0}, {-1, 0, 0}}), (Numbers{0, 1, 2}));
}
TEST(Selection, OfASphereIncludesItsSurface) {
  EXPECT_EQ(select(SphereSelection{{0, 0, 0}, 5.0}), (Numbers{0, 1, 2, 3}));  // 3-4-5
  EXPECT_EQ(select(SphereSelection{{0, 0, 0}, 1.0}), (Numbers{0, 1}));
}
// A blade of depth 2 along z that goes by (0, 0, 0), (4, 0, 0), (4, 4, 0): two rectangles.
TEST(Selection, AroundAPathIsWhatIsNearTheSweptRectanglesTheirEdgesAndTheirCorners) {
  const AroundSelection around{{{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}}, {0, 0, 2}}, 1.0};
  const auto is_in = [&around](double x, double y, double z) { return contains(around, {x, y, z}, 0.0); };
  for (const double y : {-1.0, 0.5}) EXPECT_TRUE(is_in(2, y, 1));  // next to the first
  EXPECT_FALSE(is_in(2, -1.01, 1));
  EXPECT_TRUE(is_in(4.9, 2, 1));  // next to the second
  EXPECT_FALSE(is_in(5.1, 2, 1));
  EXPECT_TRUE(is_in(2, 0, 3));  // beyond an edge
  EXPECT_FALSE(is_in(2, 0.1, 3));
  EXPECT_FALSE(is_in(2, 0, -1.1));
  EXPECT_TRUE(is_in(-0.6, 0, 2.8));  // beyond a corner, 3-4-5
  EXPECT_FALSE(is_in(-0.61, 0, 2.8));
  EXPECT_FALSE(is_in(2, 2, 1));  // between the two legs
}
TEST(Selection, AroundAPathWithoutDepthIsATubeWithRoundEnds) {
  const AroundSelection around{{{{0, 0, 0}, {4, 0, 0}}, {0, 0, 0}}, 1.0};
  EXPECT_TRUE(contains(around, {2, 0.6, 0.8}, 0.0));
  EXPECT_FALSE(contains(around, {2, 0.6, 0.81}, 0.0));
  EXPECT_TRUE(contains(around, {4.6, 0.8, 0}, 0.0));
  EXPECT_FALSE(contains(around, {4.6, 0.81, 0}, 0.0));
}
using Axes = std::vector<HeldAxes>;
TEST(Selection, OfSeveralThatHoldAddsUpTheirAxes) {
  const std::vector<HeldSelection> held{
      {IdSelection{{0, 3}}, 1}, {SphereSelection{{0, 0, 0}, 1.0}, 4}, {IdSelection{{2}}}};
  EXPECT_EQ(held_axes_of(held, points), (Axes{5, 4, 7, 1}));
}
TEST(Selection, OfNoneHoldsNothing) { EXPECT_EQ(held_axes_of({}, points), (Axes{0, 0, 0, 0})); }
TEST(Selection, RefusesAnIdThatIsNoPointAndNamesIt) {
  try {
    select(IdSelection{{0, 4}});
    FAIL() << "accepted";
  } catch (const InputError& error) {
    EXPECT_STREQ(error.what(), "/fixed/0/ids/1: is 4; expected a point of the mesh, less than 4");
  }
}

// A cross of five unit squares in the plane x = 7, seen along x: the notches between its arms are outside. It is listed
// from each of its corners on, so that each side is the last once, and in both senses.
TEST(Selection, OfAPolygonIsWhatIsSeenInItThoughItIsNotConvex) {
  std::vector<Eigen::Vector3d> corners{{7, 1, 0}, {7, 2, 0}, {7, 2, 1}, {7, 3, 1}, {7, 3, 2}, {7, 2, 2},
                                       {7, 2, 3}, {7, 1, 3}, {7, 1, 2}, {7, 0, 2}, {7, 0, 1}, {7, 1, 1}};
  for (int turn = 0; turn < 24; ++turn) {
    const PolygonSelection cross{{1, 0, 0}, corners};
    for (int y = -1; y <= 3; ++y)
      for (int z = -1; z <= 3; ++z) {
        const bool in_arms = (y == 1 && z >= 0 && z < 3) || (z == 1 && y >= 0 && y < 3);
        EXPECT_EQ(contains(cross, {-5, y + 0.5, z + 0.25}, 0.0), in_arms) << y << " " << z << " " << turn;
      }
    std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    if (turn == 11) std::reverse(corners.begin(), corners.end());
  }
}

TEST(Selection, OfAPolygonIncludesItsSides) {
  const PolygonSelection triangle{{0, 0, 1}, {{0, 0, 0}, {3, 0, 0}, {0, 3, 0}}};
  for (const auto& x : std::vector<Eigen::Vector3d>{{0, 1, 9}, {1, 0, 9}, {1, 2, 9}, {3, 0, 9}, {2, 1, -9}})
    EXPECT_TRUE(contains(triangle, x, 1e-9)) << x.transpose();
  for (const auto& x : std::vector<Eigen::Vector3d>{{-1e-6, 1, 9}, {1, -1e-6, 9}, {1, 2.00001, 9}, {3.00001, 0, 9}})
    EXPECT_FALSE(contains(triangle, x, 1e-9)) << x.transpose();
}

// 3 x 0.1 is 0.30000000000000004, and a unit normal rounds exact coordinates.
TEST(Selection, HoldsAWholeLayerWhereverRoundingPutsItsPoints) {
  const auto layer = [](const Mesh& mesh, const VertexSelection& selection) {
    return select_points(selection, mesh.points, "").size();
  };
  EXPECT_EQ(layer(kuhn_box(10, 1, 1, 0.1), PlaneSelection{{0.3, 0, 0}, {-1, 0, 0}}), 16u);
  EXPECT_EQ(layer(kuhn_box(9, 9, 9, 0.1), BoxSelection{{0, 0, 0}, {0.3, 0.3, 0.3}}), 64u);
  const Eigen::Vector3d across = Eigen::Vector3d(1, 1, 1).normalized();
  const Mesh cube = kuhn_box(6, 6, 6, 1.0);
  const auto in_front =
      std::count_if(cube.points.begin(), cube.points.end(), [](const auto& p) { return p.sum() >= 3; });
  EXPECT_EQ(layer(cube, PlaneSelection{{3, 0, 0}, across}), static_cast<std::size_t>(in_front));
}

}  // namespace
}  // namespace dartboard::selection_test
