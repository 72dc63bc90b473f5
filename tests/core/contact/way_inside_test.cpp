#include "core/contact/way_inside.h"

#include <gtest/gtest.h>

#include <cmath>
#include <utility>

#include "core/plain/random.h"

namespace dartboard::way_inside_test {
namespace {

using Eigen::Vector3d;

/// Numbers between -1 and 1, or quarters of them, so that places are often on faces, on edges and as near to two faces.
struct Draws {
  SplitMix64 random{5};
  bool quarters = false;

  double number() {
    const double drawn = random.next_signed();
    return quarters ? std::round(4 * drawn) / 4 : drawn;
  }
  Vector3d place() {
    const double x = number(), y = number();
    return {x, y, number()};
  }
  ObstacleShape shape(int kind) {
    if (kind == 0) return HalfSpace{place(), Vector3d(random.next_signed(), 0.5, random.next_signed()).normalized()};
    if (kind == 1) return Ball{place(), 0.25 + std::abs(number())};
    Block block{place(), place()};
    for (int k = 0; k < 3; ++k) {
      if (block.low[k] > block.high[k]) std::swap(block.low[k], block.high[k]);
      block.high[k] += 0.25;
    }
    return block;
  }
};

double energy_at(const ContactLaw& law, const ObstacleShape& shape, const Vector3d& y) {
  return is_inside(shape, y) ? law.energy(1.0, penetration(shape, y).depth) : 0.0;
}

// Energies are below 3^4 / 4 of a unit and right to some roundings, and so are their changes; those of very short ways,
// too.
TEST(WayInside, HasTheChangeOfEnergyAndTheForceThatDoesIt) {
  Draws draw;
  int inside = 0;
  for (int k = 0; k < 60000; ++k) {
    draw.quarters = k % 3 == 0;
    ContactLaw law;
    law.pressure = law.depth = 1.0;
    law.exponent = 2 + k % 5 % 3;
    const ObstacleShape shape = draw.shape(k % 4);
    const Vector3d y = draw.place();
    Vector3d way = draw.place();
    if (k % 7 == 0) way *= 1e-8;
    if (k % 11 == 0) way[k % 3] = 0.0;
    const double before = energy_at(law, shape, y), after = energy_at(law, shape, y + way);
    const EnergyChange found = change_on_way(law, 1.0, shape, y, way);
    const Vector3d force = mean_force_on_way(law, 1.0, shape, y, way);
    ASSERT_NEAR(found.value, after - before, 1e-13) << k;
    ASSERT_NEAR(force.dot(way), -found.value, 1e-13) << k;
    ASSERT_GE(found.sizes, std::abs(found.value) * (1 - 1e-12)) << k;
    // at equal distance from two faces, the choice may depend on the direction
    if (!draw.quarters) {
      ASSERT_LE((force - mean_force_on_way(law, 1.0, shape, y + way, -way)).norm(), 1e-13) << k;
    }
    if (before > 0.0) ++inside;
  }
  EXPECT_GT(inside, 10000);
}

TEST(WayInside, IsNothingWhereAllOfItIsOutside) {
  ContactLaw law;
  law.pressure = law.depth = 1.0;
  const Vector3d way(1, 0, 0);
  for (const ObstacleShape& shape : {ObstacleShape(HalfSpace{}), ObstacleShape(Ball{{0, 0, -2}, 1.0}),
                                     ObstacleShape(Block{{0, 0, -3}, {1, 1, -1}})}) {
    EXPECT_EQ(change_on_way(law, 1.0, shape, {0, 0.5, 0.25}, way).sizes, 0.0);
    EXPECT_EQ(mean_force_on_way(law, 1.0, shape, {0, 0.5, 0.25}, way), Vector3d(0, 0, 0));
    EXPECT_FALSE(is_inside(shape, {0, 0.5, 0.25}));
  }
}

// Through the middle of a block, in at one face and out at the other: the pushes of both halves are equal and opposite.
TEST(WayInside, ThroughABlockPushesBothWays) {
  ContactLaw law;
  law.pressure = law.depth = 1.0;
  law.exponent = 2;
  const Block block{{0, 0, 0}, {1, 2, 2}};
  EXPECT_LE(mean_force_on_way(law, 1.0, block, {-1, 1, 1}, {3, 0, 0}).norm(), 1e-16);
  // to the middle: E = 1/8 over a way of 3/2
  EXPECT_NEAR(mean_force_on_way(law, 1.0, block, {-1, 1, 1}, {1.5, 0, 0})[0], -0.125 / 1.5, 1e-16);
  EXPECT_NEAR(change_on_way(law, 1.0, block, {-1, 1, 1}, {1.5, 0, 0}).value, 0.125, 1e-16);
}

}  // namespace
}  // namespace dartboard::way_inside_test
