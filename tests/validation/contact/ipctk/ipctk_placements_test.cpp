#include "validation/contact/ipctk/ipctk_placements.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/meshes/generators/mesh_generators.h"
#include "core/places/nearest_on_triangle.h"

namespace dartboard::ipctk_placements_test {
namespace {

using Eigen::Vector3d;

IpctkPlacements placed(std::function<bool(std::size_t)> loses = {}) {
  return ipctk_placements("a box and a ball", kuhn_box(2, 2, 2, 0.5, 0.15, 5), tetrahedron_ball(2, 0.5),
                          {.placements = 40, .seed = 3, .loses = std::move(loses)});
}
/// The answer of one that agrees in everything.
IpctkAnswer agreeing(const IpctkPlacements& p) {
  IpctkAnswer answer;
  for (std::size_t k = 0; k < p.question.places.size(); ++k) {
    answer.crossing.push_back(p.overlap[k] > 0.0);
    answer.squares.emplace_back();
    for (const IpctkSample& s : p.question.places[k].samples) answer.squares[k].push_back(s.depth * s.depth);
  }
  return answer;
}

TEST(IpctkPlacements, AreSomeInEachOtherAndSomeApart) {
  const IpctkPlacements p = placed();
  const IpctkPlacementsFound found = found_by_ipctk(p, agreeing(p));
  EXPECT_EQ(found.bodies, "a box and a ball");
  EXPECT_EQ(found.placements, 40u);
  EXPECT_GT(found.crossing, 10u);
  EXPECT_LT(found.crossing, 35u);
  EXPECT_EQ(found.disputed, 0u);
  EXPECT_EQ(found.false_felt, 0u);
  EXPECT_LE(found.deepest_quiet, 0.5);
  EXPECT_GT(found.contacts, 50u);
  EXPECT_GT(found.shallow, found.contacts / 2);
  EXPECT_LE(found.apart, 1e-16);
  EXPECT_EQ(p.question.places[0].x.size(), 26u + 18u);  // without those in the middle
  EXPECT_FALSE(p.question.in_motion);
}

// Cells of a cube of 1/2 m that is not distorted: between two opposite edges, 1/2 m over the root of 3; a diagonal.
TEST(IpctkPlacements, KnowTheLeastWidthAndTheLongestEdgeOfACell) {
  const Mesh box = kuhn_box(1, 1, 1, 0.5);
  const IpctkPlacements p = ipctk_placements("boxes", box, box, {.placements = 3, .seed = 1});
  EXPECT_NEAR(p.width, 0.5 / std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(p.edge, 0.5 * std::sqrt(3.0), 1e-15);
  EXPECT_GT(p.size, 0.5);
  EXPECT_LT(p.size, 2.0);
}

TEST(IpctkPlacements, AreEverySecondTimeThoseBeforeMovedOnALittle) {
  const IpctkPlacements p = placed();
  const double a_little = 0.3 * p.width;  // a fifth of an altitude is less
  for (std::size_t k = 1; k < p.question.places.size(); k += 2) {
    const auto &before = p.question.places[k - 1].x, &after = p.question.places[k].x;
    EXPECT_EQ(after.front(), before.front());
    const Vector3d moved = after.back() - before.back();
    EXPECT_GT(moved.norm(), 0.0);
    EXPECT_LT(moved.norm(), a_little);
    EXPECT_LT((after[after.size() - 2] - before[before.size() - 2] - moved).norm(), 1e-15);
  }
  EXPECT_GT((p.question.places[2].x.back() - p.question.places[1].x.back()).norm(), a_little);
}

// The depth is that of the nearest triangle of the whole body, searched here one by one.
TEST(IpctkPlacements, HaveTheBodyThatASampleIsInsideOf) {
  const IpctkPlacements p = placed();
  for (const IpctkPlace& place : p.question.places)
    for (const IpctkSample& s : place.samples) {
      Vector3d y(0, 0, 0);
      for (const std::uint32_t k : s.nodes) y += place.x[k] / static_cast<double>(s.nodes.size());
      double least = INFINITY;
      for (std::size_t t = 0; t < p.question.triangles.size(); ++t) {
        const auto& n = p.question.triangles[t];
        if (p.question.bodies[t] == s.body)
          least =
              std::min(least, nearest_on_triangle(place.x[n[0]] - y, place.x[n[1]] - y, place.x[n[2]] - y).way.norm());
      }
      EXPECT_NEAR(s.depth, least, 1e-14);
    }
}

TEST(IpctkPlacements, CountWhatIsLost) {
  const IpctkPlacements p = placed([](std::size_t k) { return k % 2 == 0; });
  const IpctkPlacementsFound found = found_by_ipctk(p, agreeing(p));
  EXPECT_GE(found.quiet, found.crossing / 3);
  EXPECT_GT(found.deepest_quiet, 0.5);
}

TEST(IpctkPlacements, CountContactsWhereNoSurfacesCross) {
  const IpctkPlacements p = placed();
  IpctkAnswer answer = agreeing(p);
  const auto felt = std::ranges::find_if(p.question.places, &IpctkPlace::felt) - p.question.places.begin();
  answer.crossing[static_cast<std::size_t>(felt)] = false;
  const IpctkPlacementsFound found = found_by_ipctk(p, answer);
  EXPECT_EQ(found.false_felt, 1u);
  EXPECT_EQ(found.disputed, 1u);
}

TEST(IpctkPlacements, AreDisputedWhereSurfacesCrossWithoutAnOverlap) {
  const IpctkPlacements p = placed();
  IpctkAnswer answer = agreeing(p);
  answer.crossing.assign(answer.crossing.size(), true);
  const IpctkPlacementsFound found = found_by_ipctk(p, answer);
  EXPECT_EQ(found.disputed, static_cast<std::size_t>(std::ranges::count(p.overlap, 0.0)));
  EXPECT_EQ(found.false_felt, 0u);
}

/// A sample of this depth in a body of size 2, whose cells are 1 wide and 4 long; ipctk finds another distance.
IpctkPlacementsFound compared(double depth, double distance) {
  IpctkPlacements p{.bodies = "", .question = {}, .overlap = {0.5}, .width = 1.0, .edge = 4.0, .size = 2.0};
  p.question.places = {{.x = {}, .samples = {{.nodes = {0}, .depth = depth}}, .felt = true}};
  return found_by_ipctk(p, {.crossing = {true}, .squares = {{distance * distance}}, .free = {}});
}

TEST(IpctkPlacements, CompareDepthsWithDistances) {
  EXPECT_EQ(compared(0.5, 0.5).apart, 0.0);
  EXPECT_EQ(compared(0.5, 0.5).shallow, 1u);
  EXPECT_EQ(compared(0.5, 0.25).apart, 0.125);
  EXPECT_EQ(compared(0.25, 0.5).apart, 0.125);
  EXPECT_EQ(compared(5.0, 0.5).apart, 2.25);
}

TEST(IpctkPlacements, AllowLongerWaysUpToAnEdgeButNoShorterOnesBeyondTheWidthOfACell) {
  const IpctkPlacementsFound longer = compared(3.0, 1.5), equal = compared(1.5, 1.5), shorter = compared(1.5, 3.0);
  EXPECT_EQ(longer.apart, 0.0);
  EXPECT_EQ(longer.longer, 1u);
  EXPECT_EQ(longer.longest, 2.0);
  EXPECT_EQ(longer.shallow, 0u);
  EXPECT_EQ(compared(5.0, 1.5).apart, 0.5);
  EXPECT_EQ(compared(5.0, 5.0).apart, 0.0);
  EXPECT_EQ(compared(5.0, 4.5).apart, 0.25);
  EXPECT_EQ(equal.longer, 0u);
  EXPECT_EQ(equal.longest, 1.0);
  EXPECT_EQ(shorter.apart, 0.75);
  EXPECT_EQ(shorter.longer, 0u);
}

}  // namespace
}  // namespace dartboard::ipctk_placements_test
