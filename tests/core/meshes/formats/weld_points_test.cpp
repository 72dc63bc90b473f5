// Seams: how they are closed, when they are not, and the report on those that stay open.

#include "core/meshes/formats/weld_points.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/meshes/generators/mesh_generators.h"
#include "tests/support/meshes/mesh_samples.h"

namespace dartboard::weld_points_test {
namespace {

using namespace samples;
using Nodes = std::vector<std::uint32_t>;
using Notices = std::vector<std::string>;

/// A square of two triangles with points of their own, `gap` apart; the first point of the file has no cell.
std::string two_triangles(std::string_view gap, std::string_view height = "1") {
  return fmt::format("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 {1} 0\nv 1 0 {0}\nv 1 {1} 0\nv 0 {1} {0}\nf 2 3 4\nf 5 6 7\n", gap,
                     height);
}

LoadedMesh read(std::string_view text, std::optional<double> weld = {}) {
  return parse_mesh(text, MeshFormat::obj, "file", {.weld = weld});
}

std::string refused(std::string_view text, double weld) {
  try {
    read(text, weld);
  } catch (const InputError& error) {
    return error.what();
  }
  ADD_FAILURE() << "welded";
  return "";
}

TEST(WeldedPoints, AreTheFirstOfThemWhereItWas) {
  const LoadedMesh loaded = read(two_triangles("1e-9"), 1e-9);
  EXPECT_EQ(loaded.mesh.nodes, (Nodes{0, 1, 2, 1, 3, 2}));
  ASSERT_EQ(loaded.mesh.points.size(), 4u);
  EXPECT_EQ(loaded.mesh.points[1], Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(loaded.mesh.points[2], Eigen::Vector3d(0, 1, 0));
  EXPECT_EQ(loaded.notices.back(), "welded 2 points to others at most 1e-09 away");
}

TEST(WeldedPoints, AreKnownByEachOfTheirNumbersInTheFile) {
  const LoadedMesh loaded = read(two_triangles("0"), 1e-9);
  EXPECT_EQ(loaded.place_of_point, (Nodes{LoadedMesh::dropped, 0, 1, 2, 1, 3, 2}));
  EXPECT_EQ(loaded.number_in_file(1), 2u);
  EXPECT_EQ(loaded.number_in_file(3), 5u);
}

TEST(WeldedPoints, AreNoneBeyondTheDistance) {
  const LoadedMesh loaded = read(two_triangles("1e-6"), 0.9e-6);
  EXPECT_EQ(loaded.mesh.points.size(), 6u);
  EXPECT_EQ(loaded.notices.at(1), "welded no points: no two are within 9e-07 of each other");
}

// 1 + 1e-9 is not at a distance of 1e-9 from 1, because of the last bits of both.
TEST(WeldedPoints, AreThoseAtTheDistanceThatDecimalsSay) {
  const std::string text = "v 0 0\nv 1 0\nv 0 1\nv 1.000000001 0\nv 1 1\nv 0 1.000000001\nf 1 2 3\nf 4 5 6\n";
  EXPECT_EQ(read(text, 1e-9).mesh.points.size(), 4u);
}

TEST(WeldedPoints, HangTogetherByPairs) {
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0.01\nv -1 0 0\nv 0 -1 0\nv 0 0 0.02\nv 1 0 1\nv 0 1 1\nf 1 2 3\nf 4 5 6\nf 7 8 9\n";
  EXPECT_EQ(read(text, 0.011).mesh.nodes, (Nodes{0, 1, 2, 0, 3, 4, 0, 5, 6}));
}

TEST(WeldedPoints, AreNeverTwoCornersOfACell) {
  const std::string said = refused(two_triangles("0", "0.25"), 0.3);
  EXPECT_EQ(said,
            "file:8: cell 0 (triangle) would lose a corner: welding at 0.3 joins its points 1 and 3, which are 0.25 "
            "apart; expected a smaller distance");
}

// Neither edge is that short, but points of the other cell lead from one corner to the next.
TEST(WeldedPoints, AreNotTwoCornersByWayOfOthersEither) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 9 0\nv 0.5 0 0\nv 5 5 5\nv 5 -5 5\nf 1 2 3\nf 4 5 6\n";
  EXPECT_EQ(read(text, 0.4).mesh.points.size(), 6u);
  expect_part(refused(text, 0.6),
              "file:7: cell 0 (triangle) would lose a corner: welding at 0.6 joins its points 0 and 1");
}

TEST(WeldedPoints, NeedADistanceAboveZero) {
  for (const double bad :
       {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
    expect_part(refused(two_triangles("0"), bad), "expected more than 0");
}

TEST(WeldedPoints, JoinAllSidesOfScatteredCells) {
  const Mesh box = kuhn_box(4, 3, 2, 1.0, 0.2, 7);
  LoadedMesh loaded;
  for (std::size_t c = 0; c < box.cell_count(); ++c) {
    Nodes nodes;
    for (const std::uint32_t p : box.cell(c)) {
      nodes.push_back(static_cast<std::uint32_t>(loaded.mesh.points.size()));
      loaded.mesh.points.push_back(box.points[p] + Eigen::Vector3d::Constant(1e-9 * static_cast<double>(c % 5)));
    }
    loaded.mesh.add_cell(box.kinds[c], nodes);
  }
  weld_points(loaded, 1e-8, "file", {});
  EXPECT_EQ(loaded.mesh.points.size(), box.points.size());
}

// Wherever they lie: the search for near points uses boxes 64 times as wide as the distance, 2.6e-3. Steps of 2e-5 over
// one of them, of points 3e-5 apart, visit every border.
TEST(WeldedPoints, AreFoundWhereverTheyAre) {
  for (int k = 0; k < 140; ++k) {
    const double x = 10.0 + 2e-5 * k;
    EXPECT_EQ(read(fmt::format("v {} 5 5\nv 11 0 0\nv 0 11 0\nv {} 5 5\nv 0 0 11\nv -13 -13 0\nf 1 2 3\nf 4 5 6\n", x,
                               x + 3e-5),
                   4e-5)
                  .mesh.points.size(),
              5u);
  }
}

TEST(OpenSeams, AreReportedWithADistanceThatClosesThem) {
  for (const auto& [gap, found, weld] :
       {std::tuple{"0",
                   "2 points coincide with another one, as in a torn body; for example points 2 and 4; --weld 1e-06",
                   1e-6},
        {"1e-9",
         "2 points are within 1e-09 of another one, as in a torn body; for example points 2 and 4; --weld 2e-09",
         2e-9}}) {
    const std::string text = two_triangles(gap);
    const LoadedMesh open = read(text), closed = read(text, weld);
    expect_part(open.notices.back(), found);
    EXPECT_EQ(closed.mesh.points.size(), open.mesh.points.size() - 2);
    EXPECT_EQ(closed.notices.size(), 2u);
  }
}

TEST(OpenSeams, AreNoneWherePointsAreFarForTheirEdges) {
  // a millionth of the size of the points, sqrt(2); a thousandth of the shortest edge
  for (const auto& [near, far, height] : {std::tuple{"1.4e-6", "1.5e-6", "1"}, {"0.9e-7", "1.1e-7", "1e-4"}}) {
    EXPECT_EQ(read(two_triangles(near, height)).notices.size(), 2u);
    EXPECT_EQ(read(two_triangles(far, height)).notices.size(), 1u);
  }
  EXPECT_EQ(read("v 0 0 0\nv 1e-7 0 0\nv 0 1 0\nf 1 2 3\n").notices.size(), 0u);
}

TEST(OpenSeams, AreFoundFarFromTheOriginAndAmongLargeAndTinyCells) {
  EXPECT_EQ(read("v 1e9 0\nv 1000000001 0\nv 1e9 1\nv 1000000001 0\nv 1000000001 1\nv 1e9 1\nf 1 2 3\nf 4 5 6\n", 0.1)
                .mesh.points.size(),
            4u);
  expect_part(read("v 0 0\nv 1 0\nv 0 1\nv 0 0\nv -1e-9 0\nv 0 -1e-9\nf 1 2 3\nf 4 5 6\n").notices.at(1),
              "1 point coincides with another one");
}

TEST(MessagesOfAMesh, NamePointsByTheirNumbersInTheFile) {
  const std::string fan = "v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nv 0 -1 0\nf 2 3 4\nf 2 3 5\nf 2 3 6\n";
  expect_part(refusal(fan, MeshFormat::obj), "shares the edge of points 1, 2 with");
  expect_part(refusal("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 2 3 3\n", MeshFormat::obj), "has the point 2 twice");
}

}  // namespace
}  // namespace dartboard::weld_points_test
