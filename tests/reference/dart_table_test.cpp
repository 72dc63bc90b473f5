#include "reference/dart_table.h"

#include <gtest/gtest.h>

namespace dartboard::reference::dart_table_test {
namespace {

constexpr auto gone = DartTable::no_dart;

// Two squares of a strip, as a 2-g-map: darts 0 to 7 and 8 to 15 around them, 2 and 3 sewn to 13 and 12; dart 16 is
// dead.
DartTable two_squares() {
  DartTable t;
  t.alpha = {{1, 0, 3, 2, 5, 4, 7, 6, 9, 8, 11, 10, 13, 12, 15, 14, gone},
             {7, 2, 1, 4, 3, 6, 5, 0, 15, 10, 9, 12, 11, 14, 13, 8, gone},
             {0, 1, 13, 12, 4, 5, 6, 7, 8, 9, 10, 11, 3, 2, 14, 15, gone}};
  return t;
}

TEST(DartTable, HasOrbitsByTheirLowestDart) {
  const auto faces = orbits(two_squares(), {0, 1}), vertices = orbits(two_squares(), {1, 2}),
             edges = orbits(two_squares(), {0, 2});
  for (std::uint32_t d = 0; d < 16; ++d) EXPECT_EQ(faces[d], d < 8 ? 0u : 8u) << d;
  EXPECT_EQ(vertices[14], 1u);
  EXPECT_EQ(vertices[13], 1u);
  EXPECT_EQ(edges[12], 2u);
  EXPECT_EQ(edges[14], 14u);
  EXPECT_EQ(orbits(two_squares(), {})[5], 5u);
  EXPECT_FALSE(two_squares().is_live(16));
}

// Volumes in a ring around an edge, two faces of each at it, by the darts of one end of that edge: dart 4 t + 2 s + e
// is in volume t, on its side s, on the edge of the ring (e = 0) or on that which leaves it in the face (e = 1). Sides
// s = 1 of a volume and s = 0 of the next are sewn.
DartTable ring(std::uint32_t volumes, bool closed) {
  DartTable t;
  t.alpha.assign(4, std::vector<std::uint32_t>(4 * volumes));
  for (std::uint32_t d = 0; d < 4 * volumes; ++d) {
    const std::uint32_t v = d / 4, s = d / 2 % 2, e = d % 2;
    const bool sewn = closed || (s == 1 ? v + 1 < volumes : v > 0);
    t.alpha[0][d] = d;  // not needed
    t.alpha[1][d] = d ^ 1u;
    t.alpha[2][d] = e == 0 ? d ^ 2u : d;
    t.alpha[3][d] = sewn ? 4 * ((v + (s == 1 ? 1 : volumes - 1)) % volumes) + 2 * (1 - s) + e : d;
  }
  return t;
}

// From the face between volumes 0 and 3, alpha_2 crosses volume 0, alpha_3 enters volume 1, alpha_2 crosses it, and
// alpha_1 goes on from the edge; there alpha_2 leads nowhere, as the other edges lie on one volume each.
TEST(PaperFan, GoesByAlpha2Alpha3Alpha2Alpha1) {
  const DartTable t = ring(4, true);
  const PaperFan fan = paper_fan(t, 0);
  ASSERT_GE(fan.darts.size(), 2u);
  EXPECT_EQ(fan.darts[0], 0u);
  EXPECT_EQ(fan.darts[1], t(1, t(2, t(3, t(2, 0)))));
  EXPECT_EQ(fan.darts[1], 7u);
}

TEST(PaperFan, StopsBeforeTheSurface) {
  // one volume alone: both ways the next face is on the surface
  const PaperFan fan = paper_fan(ring(1, false), 0);
  EXPECT_EQ(fan.darts, std::vector<std::uint32_t>{0});
  EXPECT_FALSE(fan.closed);
}

}  // namespace
}  // namespace dartboard::reference::dart_table_test
