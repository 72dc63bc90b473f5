// Obstacles that cover parts of each other: blocks next to each other and inside of each other, on half-spaces.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/base/archive.h"
#include "core/contact/contacts.h"
#include "core/contact/obstacle_contact.h"
#include "tests/support/bodies/term_checks_for_tests.h"

namespace dartboard::joined_blocks_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Places = std::vector<Vector3d>;

ContactLaw law_of(int exponent, double pressure = 1.0) {
  ContactLaw law;
  law.pressure = pressure;
  law.depth = 1.0;
  law.exponent = exponent;
  return law;
}

const std::vector<SkinSample>& one_sample() {
  static const std::vector<SkinSample> samples{{{0}, 1, 1.0}};
  return samples;
}

ObstacleContact contact_with(const std::vector<Obstacle>& obstacles, int exponent = 3) {
  return {std::vector<ContactLaw>(obstacles.size(), law_of(exponent)), obstacles, one_sample()};
}

/// The discrete force on a way.
Vector3d force_on_way(const ObstacleContact& contact, const Vector3d& from, const Vector3d& way) {
  Places force(1, Vector3d(0, 0, 0));
  const Places x{from}, w{way};
  contact.add_discrete_forces({x, w, 0.5}, force);
  return force[0];
}

Vector3d force_at(const ObstacleContact& contact, const Vector3d& x) { return forces_of(contact, Places{x})[0]; }

/// Blocks, among them some with coordinates that are quarters, so that they touch and have faces in one plane, and a
/// floor at times.
struct Scenes {
  SplitMix64 random{11};
  bool quarters = false;

  double number() {
    const double drawn = random.next_signed();
    return quarters ? std::round(4 * drawn) / 4 : drawn;
  }
  Vector3d place() {
    const double x = number(), y = number();
    return {x, y, number()};
  }
  Vector3d anywhere() {
    const double x = random.next_signed(), y = random.next_signed();
    return {x, y, random.next_signed()};
  }
  std::vector<Obstacle> obstacles(int k) {
    quarters = k % 3 != 0;
    std::vector<Obstacle> drawn;
    for (int b = 0; b < 2 + k % 4; ++b) {
      Block block{place(), place()};
      for (int axis = 0; axis < 3; ++axis) {
        if (block.low[axis] > block.high[axis]) std::swap(block.low[axis], block.high[axis]);
        block.high[axis] += 0.25;
      }
      drawn.push_back({block});
    }
    if (k % 2 == 0) drawn.push_back({HalfSpace{{0, 0, -0.5}, {0, 0, 1}}});
    if (k % 10 == 0) drawn.push_back({HalfSpace{{0, 0, -0.75}, Vector3d(1, 0, 2).normalized()}});
    return drawn;
  }
  std::vector<ContactLaw> laws(int k, std::size_t count) {
    std::vector<ContactLaw> drawn(count, law_of(2 + k % 3));
    if (k % 5 == 0)
      for (ContactLaw& law : drawn) law.pressure = 1.0 + std::abs(random.next_signed());
    return drawn;
  }
  ObstacleContact contact(int k, const std::vector<Obstacle>& of) { return {laws(k, of.size()), of, one_sample()}; }
};

// ---- closed forms

TEST(JoinedBlocks, PushUpwardsAloneWhereOneFollowsTheOther) {
  const ObstacleContact contact = contact_with({{Block{{-1, -1, -1}, {0.3, 1, 0}}}, {Block{{0.3, -1, -1}, {1, 1, 0}}}});
  // next to the seam, too, where the squares of the distances from both tops are equal by rounding
  for (const double x : {0.2999, 0.3 - 1e-10, 0.3 - 1e-16, 0.3, 0.3 + 1e-16, 0.3 + 1e-10, 0.3001})
    EXPECT_EQ(force_at(contact, {x, 0, -0.0625}), Vector3d(0, 0, 0.0625 * 0.0625)) << x;
}

// In steps, too: over the seam, down onto it and up from it.
TEST(JoinedBlocks, PushUpwardsAloneOnWaysOverASeam) {
  const ObstacleContact two = contact_with({{Block{{-1, -1, -1}, {0.25, 1, 0}}}, {Block{{0.25, -1, -1}, {1, 1, 0}}}}),
                        one = contact_with({{Block{{-1, -1, -1}, {1, 1, 0}}}});
  for (const double from : {-0.0625, 0.125})
    for (const double to : {-0.125, 0.0625}) {
      const Vector3d start(0.125, 0, from), way(0.25, 0.5, to - from);
      const Vector3d force = force_on_way(two, start, way);
      EXPECT_EQ(force, force_on_way(one, start, way));
      EXPECT_EQ(force.head<2>().norm(), 0.0);
      EXPECT_EQ(two.energy_change({Places{start}}, Places{way}, 1.0).value,
                one.energy_change({Places{start}}, Places{way}, 1.0).value);
    }
}

// Next to a step of 1/8 m, from below its upper edge and beside it: the nearest free place is on the lower edge of the
// part of the higher block that is free.
TEST(JoinedBlocks, PushTowardsTheEdgeOfWhatIsFreeNextToAStep) {
  const std::vector<Obstacle> step{{Block{{-1, -1, -1}, {0, 1, 0.5}}}, {Block{{0, -1, -1}, {1, 1, 0}}}};
  const ObstacleContact contact = contact_with(step);
  const Vector3d place(-0.03, 0, -0.04);
  Penetration found;
  ASSERT_TRUE(contact.find_penetration(0, place, found));
  EXPECT_NEAR(found.depth, 0.05, 1e-16);
  EXPECT_LE((found.normal - Vector3d(0.6, 0, 0.8)).norm(), 1e-15);
  const Vector3d across(0.8, 0, -0.6);
  EXPECT_LE((found.curvature + across * across.transpose() / 0.05).norm(), 1e-13);
  EXPECT_FALSE(contact.find_penetration(1, place, found));
  // the tangent has the stiffness across, which does not soften, when projected, too
  for (const Compression compression : {Compression::exact, Compression::projected})
    EXPECT_NEAR(product_of(contact, {place}, {across}, compression)[0].dot(across), 0.05 * 0.05 / 0.05, 1e-14);
}

TEST(JoinedBlocks, OfAWallOnAFloorPushSidewaysAloneAndTheFloorUpwards) {
  for (const double foot : {0.0, -0.25}) {
    const ObstacleContact contact = contact_with({{HalfSpace{}}, {Block{{-1, -1, foot}, {0, 1, 2}}}});
    EXPECT_EQ(force_at(contact, {-0.0625, 0, 0.03125}), Vector3d(0.0625 * 0.0625, 0, 0));
    EXPECT_EQ(force_at(contact, {-0.0625, 0, 0}), Vector3d(0.0625 * 0.0625, 0, 0));
    EXPECT_EQ(force_at(contact, {-0.0625, 0, -0.125}), Vector3d(0.0625 * 0.0625, 0, 0.125 * 0.125));
    EXPECT_EQ(force_at(contact, {0.0625, 0, -0.125}), Vector3d(0, 0, 0.125 * 0.125));
  }
}

TEST(JoinedBlocks, LeaveABlockInsideOfAFloorWithoutContact) {
  ObstacleContact contact = contact_with({{HalfSpace{}}, {Block{{-1, -1, -1}, {1, 1, 0}}}});
  EXPECT_EQ(force_at(contact, {0, 0, -0.125}), Vector3d(0, 0, 0.125 * 0.125));
  EXPECT_EQ(Contacts(&contact).state_at(Places{{0, 0, -0.125}}).contacts, 1u);
  Penetration found;
  EXPECT_FALSE(contact.find_penetration(1, {0, 0, -0.125}, found));
  EXPECT_EQ(contact.penetration_in(1, {0, 0, -0.125}).depth, 0.0);
}

TEST(JoinedBlocks, LeaveABlockWithAllFacesInHalfSpacesWithoutContact) {
  std::vector<Obstacle> walls{{Block{{-1, -1, -1}, {1, 1, 1}}}};
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-1.0, 1.0})
      walls.push_back({HalfSpace{side * Vector3d::Unit(axis), -side * Vector3d::Unit(axis)}});
  const ObstacleContact contact = contact_with(walls);
  EXPECT_EQ(contact.energy(Places{{0.25, 0, 0}}), 0.0);
  EXPECT_EQ(force_at(contact, {1.25, 0, 0}), Vector3d(-0.0625, 0, 0));
  EXPECT_EQ(force_on_way(contact, {0.5, 0, 0}, {0.25, 0, 0}), Vector3d(0, 0, 0));
}

// Where both blocks are, energies are not doubled.
TEST(JoinedBlocks, ThatOverlapHaveOneContactWithASample) {
  ObstacleContact contact = contact_with({{Block{{-1, -1, -1}, {0.5, 1, 0}}}, {Block{{0, -1, -1}, {1, 1, 0}}}});
  EXPECT_EQ(Contacts(&contact).state_at(Places{{0.25, 0, -0.125}}).contacts, 1u);
  EXPECT_EQ(force_at(contact, {0.25, 0, -0.125}), Vector3d(0, 0, 0.125 * 0.125));
}

// A gap of a nanometre, an edge and a ball leave a block as it is alone, to the bit.
TEST(JoinedBlocks, AreThoseWithoutAGapOnly) {
  const Block block{{-1, -1, -1}, {0, 1, 0}};
  const ObstacleContact contact = contact_with({{block},
                                                {Block{{1e-9, -1, -1}, {1, 1, 0}}},
                                                {Block{{-1, 1, 0}, {0, 2, 1}}},
                                                {Ball{{-0.5, 0, 0}, 0.25}},
                                                {HalfSpace{{-1, -1, -0.75}, Vector3d(1, 2, 2) / 3.0}}});
  SplitMix64 random(3);
  for (int k = 0; k < 500; ++k) {
    const Vector3d x(random.next_signed(), random.next_signed(), random.next_signed());
    const Penetration alone = penetration(block, x);
    Penetration found;
    ASSERT_EQ(contact.find_penetration(0, x, found), alone.depth > 0.0);
    if (alone.depth > 0.0) {
      ASSERT_EQ(found.depth, alone.depth);
      ASSERT_EQ(found.normal, alone.normal);
    }
  }
  for (const std::uint32_t other : {1u, 2u, 3u, 4u}) EXPECT_FALSE(contact.are_joined(0, other));
}

// ---- energies, forces and tangents

// Over 1000 ways among random blocks, by steps s: no change is above the larger force times s, but for the stiffness
// times s^2, so that a jump at the depth d is seen where d is above 2 s or so.
TEST(JoinedBlocks, HaveAnEnergyWithoutJumps) {
  Scenes draw;
  std::size_t touched = 0;
  for (int k = 0; k < 1000; ++k) {
    const std::vector<Obstacle> obstacles = draw.obstacles(k);
    ObstacleContact contact = draw.contact(k, obstacles);
    const Vector3d from = draw.anywhere(), way = draw.anywhere() - from;
    constexpr int steps = 400;
    double before = 0.0, pushed = 0.0;
    for (int n = 0; n <= steps; ++n) {
      const ContactState state = Contacts(&contact).state_at(Places{from + n * way / steps});
      double now = 0.0;
      for (const Vector3d& force : state.force_on) now += force.norm();
      const double s = way.norm() / steps, stiffness = 50.0;
      if (n > 0) {
        ASSERT_LE(std::abs(state.energy - before), (std::max(now, pushed) + stiffness * s) * s) << k << ' ' << n;
      }
      before = state.energy;
      pushed = now;
      touched += state.contacts;
    }
  }
  EXPECT_GT(touched, 50000u);
}

// Central differences, at places from which no other face, edge or block is as near within the step.
TEST(JoinedBlocks, PushAlongTheSlopeOfTheirEnergyAndStiffenAsThatDoes) {
  Scenes draw;
  std::size_t seen = 0, oblique = 0;
  const double d = 1e-6;
  for (int k = 0; k < 4000; ++k) {
    const std::vector<Obstacle> obstacles = draw.obstacles(k);
    const ObstacleContact contact = draw.contact(k, obstacles);
    const Vector3d x = draw.anywhere();
    const auto touches = [&](const Vector3d& y) {
      std::vector<std::pair<std::uint32_t, Penetration>> found;
      contact.for_each_penetration(y, [&](std::uint32_t o, const Penetration& in) { found.emplace_back(o, in); });
      return found;
    };
    const auto here = touches(x);
    if (here.empty()) continue;
    bool smooth = true;
    for (const auto& [o, in] : here) smooth = smooth && in.depth > 0.01;
    Vector3d slope(0, 0, 0);
    Matrix3d bend = Matrix3d::Zero();
    for (int c = 0; c < 3; ++c) {
      const Vector3d up = x + d * Vector3d::Unit(c), down = x - d * Vector3d::Unit(c);
      for (const Vector3d& y : {Vector3d(x + 2 * d * Vector3d::Unit(c)), Vector3d(x - 2 * d * Vector3d::Unit(c))}) {
        const auto there = touches(y);
        smooth = smooth && there.size() == here.size();
        for (std::size_t t = 0; smooth && t < here.size(); ++t)
          smooth = there[t].first == here[t].first && (there[t].second.normal - here[t].second.normal).norm() < 1e-3;
      }
      slope[c] = (contact.energy(Places{up}) - contact.energy(Places{down})) / (2 * d);
      bend.col(c) = (force_at(contact, down) - force_at(contact, up)) / (2 * d);
    }
    if (!smooth) continue;
    ++seen;
    if (here[0].second.normal.cwiseAbs().maxCoeff() < 0.99) ++oblique;
    ASSERT_LE((slope + force_at(contact, x)).norm(), 1e-8) << k;
    for (int c = 0; c < 3; ++c)
      ASSERT_LE((bend.col(c) - product_of(contact, {x}, {Vector3d::Unit(c)})[0]).norm(), 1e-6) << k;
    for (const Vector3d& w : {Vector3d(1, 0, 0), Vector3d(-1, 2, 0), Vector3d(1, 1, -1)})
      ASSERT_GE(product_of(contact, {x}, {w}, Compression::projected)[0].dot(w), -1e-12);
  }
  EXPECT_GT(seen, 1000u);
  EXPECT_GT(oblique, 50u);
}

TEST(JoinedBlocks, HaveDiscreteForcesAndChangesOfEnergyThatAreExact) {
  Scenes draw;
  std::size_t inside = 0;
  for (int k = 0; k < 20000; ++k) {
    const std::vector<Obstacle> obstacles = draw.obstacles(k);
    const ObstacleContact contact = draw.contact(k, obstacles);
    const Vector3d y = draw.anywhere();
    Vector3d way = draw.anywhere();
    if (k % 7 == 0) way *= 1e-3;
    if (k % 7 == 1) way *= 1e-8;
    if (k % 11 == 0) way[k % 3] = 0.0;
    const double before = contact.energy(Places{y}), after = contact.energy(Places{y + way});
    const Places x{y}, step{way};
    const EnergyChange found = contact.energy_change({x}, step, 1.0);
    const Vector3d force = force_on_way(contact, y, way), back = force_on_way(contact, y + way, -way);
    ASSERT_NEAR(found.value, after - before, 2e-14) << k;
    ASSERT_NEAR(force.dot(way), -found.value, 2e-14) << k;
    ASSERT_GE(found.sizes, std::abs(found.value) * (1 - 1e-12)) << k;
    // the places at the ends differ by a rounding from one direction to the other
    if (way.norm() > 1e-4) {
      ASSERT_LE((force - back).norm(), 1e-11) << k;
    }
    ASSERT_LE((force_on_way(contact, y, Vector3d(0, 0, 0)) - force_at(contact, y)).norm(), 1e-14) << k;
    if (before > 0.0) ++inside;
  }
  EXPECT_GT(inside, 4000u);
}

// To 1e-10 of curvature and some roundings; differences of depths have an error of 1e-17 over ways of 1e-11.
TEST(JoinedBlocks, KeepTheDigitsOfEnergyOnShortWays) {
  const ObstacleContact contact = contact_with({{Block{{-1, -1, -1}, {0, 1, 0.5}}}, {Block{{0, -1, -1}, {1, 1, 0}}}});
  for (const Vector3d& place : {Vector3d(0.3, 0, -0.1), Vector3d(-0.3, 0.1, 0.4), Vector3d(-0.03, 0, -0.04)}) {
    const Vector3d way(1e-11, -2e-11, 3e-11);
    const double expected = -force_at(contact, place).dot(way);
    ASSERT_GT(std::abs(expected), 1e-16);
    EXPECT_NEAR(contact.energy_change({Places{place}}, Places{way}, 1.0).value, expected, 1e-8 * std::abs(expected));
    EXPECT_LE((force_on_way(contact, place, way) - force_at(contact, place)).norm(),
              1e-8 * std::abs(expected) / way.norm());
  }
}

// Iterations of implicit methods try ways whose ends are on both sides of a face.
TEST(JoinedBlocks, HaveDiscreteForcesThatDoNotJumpWhereTheWayEndsOnAFace) {
  const ObstacleContact contact = contact_with({{Block{{-1, -1, -1}, {0, 1, 0}}}, {Block{{0, -1, -1}, {1, 1, -0.5}}}});
  const Vector3d from(-0.1, 0, -0.05);
  for (const Vector3d& end : {Vector3d(0, 0, -0.25), Vector3d(-0.2, 0, 0), Vector3d(0.25, 0, -0.5)}) {
    const Vector3d across(end[0] == 0.0 ? 1e-9 : 0.0, 0, end[0] == 0.0 ? 0.0 : 1e-9);
    const Vector3d inside = force_on_way(contact, from, end - across - from),
                   outside = force_on_way(contact, from, end + across - from);
    EXPECT_GT(inside.norm(), 1e-4);
    EXPECT_LE((inside - outside).norm(), 1e-7) << end.transpose();
  }
}

// ---- obstacles that move

// Blocks and floors that come together, part and pass through each other.
TEST(JoinedBlocks, AreMovedByTheWorkThatTheirEnergyChangesBy) {
  Scenes draw;
  double largest = 0.0;
  for (int k = 0; k < 300; ++k) {
    std::vector<Obstacle> obstacles = draw.obstacles(k);
    for (Obstacle& o : obstacles) {
      if (k % 4 > 0) o.velocity = draw.anywhere();
      if (k % 4 == 1) o.velocity = obstacles[0].velocity;
      o.until = 0.75;
    }
    ObstacleContact contact = draw.contact(k, obstacles);
    const Places x{draw.anywhere()};
    for (const double time : {0.0, 0.01, 0.25, 0.26, 0.5, 1.0, 2.0}) {
      const EnergyChange work = contact.work_of_placing(time, x);
      const double before = contact.energy(x);
      contact.place_at(time);
      ASSERT_NEAR(contact.energy(x) - before, work.value, 1e-13) << k << ' ' << time;
      ASSERT_GE(work.sizes, std::abs(work.value) * (1 - 1e-12));
      largest = std::max(largest, std::abs(work.value));
      EXPECT_EQ(contact.work_of_placing(time, x).sizes, 0.0);
    }
  }
  EXPECT_GT(largest, 0.01);
}

TEST(JoinedBlocks, AreTheSameWhereverTheyWereAtFirst) {
  Scenes draw;
  std::size_t inside = 0;
  for (int k = 0; k < 1000; ++k) {
    const std::vector<Obstacle> there = draw.obstacles(k);
    std::vector<Obstacle> moving = there;
    for (Obstacle& o : moving) {
      o.velocity = draw.place();
      o.until = 1.0;
      const Vector3d back = -o.velocity;
      if (auto* plane = std::get_if<HalfSpace>(&o.shape)) plane->point += back;
      if (auto* block = std::get_if<Block>(&o.shape)) {
        block->low += back;
        block->high += back;
      }
    }
    ObstacleContact moved = draw.contact(1, moving);
    const ObstacleContact still = draw.contact(1, there);
    moved.place_at(1.0);
    const Vector3d x = draw.anywhere();
    ASSERT_NEAR(moved.energy(Places{x}), still.energy(Places{x}), 1e-13) << k;
    ASSERT_LE((force_at(moved, x) - force_at(still, x)).norm(), 1e-13) << k;
    if (still.energy(Places{x}) > 0.0) ++inside;
  }
  EXPECT_GT(inside, 300u);
}

TEST(JoinedBlocks, AreThoseOfThePlacesThatWereReadOrTaken) {
  std::vector<Obstacle> apart{{Block{{-1, -1, -1}, {0, 1, 0}}},
                              {Block{{0.5, -1, -1}, {2, 1, 0}}, {-1, 0, 0}, 0.0, 0.5}};
  ObstacleContact moved = contact_with(apart), read = contact_with(apart), taken = contact_with(apart);
  moved.place_at(3.0);
  EXPECT_TRUE(moved.are_joined(0, 1));
  EXPECT_FALSE(read.are_joined(0, 1));
  Archive archive;
  moved.state(archive);
  Archive again(archive.written(), "places");
  read.state(again);
  taken.place_as(moved);
  for (const ObstacleContact* contact : {&moved, &read, &taken}) {
    EXPECT_TRUE(contact->are_joined(0, 1));
    EXPECT_EQ(force_at(*contact, {-1e-3, 0, -0.125}), Vector3d(0, 0, 0.125 * 0.125));
  }
}

}  // namespace
}  // namespace dartboard::joined_blocks_test
