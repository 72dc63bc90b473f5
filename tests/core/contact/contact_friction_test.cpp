// Friction of a contact: slopes that it holds, stopping distances, steps that are taken back.

#include "core/contact/contact_impulses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/base/archive.h"
#include "tests/support/bodies/touching_vertices_for_tests.h"

namespace dartboard::contact_friction_test {
namespace {

using Eigen::Vector3d;

constexpr double mass = TouchingVertices::mass, area = TouchingVertices::area;

// Sliding all the way through a bounce, friction takes mu times the normal momentum, 1 + e times that of the approach.
// More friction takes at most the whole of the sliding velocity. Of a thousand steps in contact, one may be wrong.
TEST(ContactFriction, TakesTheShareOfTheNormalMomentumThatItMay) {
  for (const int p : {2, 3, 4})
    for (const double e : {1.0, 0.5}) {
      const Vector3d v = bounce(contact_law(p, e, 0.25), {3, 4, -2}, 1e-3);
      const double lost = 0.25 * (1 + e) * 2.0;
      EXPECT_NEAR(v.head<2>().norm(), 5.0 - lost, 1e-3 * lost) << p << ' ' << e;
      EXPECT_NEAR(v[0] / v[1], 0.75, 1e-12);
      EXPECT_LE(bounce(contact_law(p, e, 10.0), {0.3, 0.4, -2}, 1e-3).head<2>().norm(), 1e-12);
    }
}

// What a floor leaves behind it does not push, nor rub.
TEST(ContactFriction, IsNothingWhereAFloorLeavesFasterThanItPushes) {
  TouchingVertices body = one_vertex({0, 0, -0.001}, {1, 0, 0});
  ObstacleContact contact({contact_law(3, 0.2, 0.5)}, {{HalfSpace{}, {0, 0, -1}}}, body.samples);
  ContactImpulses impulses(&contact);
  for (int k = 0; k < 20; ++k) body.step(contact, impulses, 1e-4);
  EXPECT_EQ(body.v[0][0], 1.0);
  EXPECT_EQ(impulses.losses().rubbed, 0.0);
}

// A step that is long for the contact, in which the vertex enters at a depth that it will never reach: friction is at
// most mu times the momentum that a bounce reverses; for a vertex at rest, mu times the force.
TEST(ContactFriction, TakesNoMoreThanTheNormalMomentumThatCanBeTurned) {
  for (const double speed : {3.0, 0.0}) {
    const ContactLaw law = contact_law(3, 0.5, 0.25);
    TouchingVertices body = one_vertex({0, 0, speed > 0.0 ? 0.0 : -0.001}, {100, 0, -speed});
    ObstacleContact contact({law}, {{HalfSpace{}}}, body.samples);
    ContactImpulses impulses(&contact);
    const double h = 0.01, turned = 1.5 * mass * speed, lying = law.force(area, 0.001);
    const auto none = [](std::span<const Vector3d>, std::span<const Vector3d>, std::span<Vector3d> a) {
      std::ranges::fill(a, Vector3d(0, 0, 0));
    };
    impulses.begin(0.0, h, body.inverse_mass, {}, body.x, body.v, none);
    ASSERT_EQ(contact.frozen_friction().size(), 1u);
    EXPECT_GT(law.force(area, speed * h / 2) * h, speed > 0.0 ? 5 * turned : -1.0);
    EXPECT_NEAR(-contact.frozen_friction()[0].force[0], 0.25 * (speed > 0.0 ? turned / h : lying), 1e-12);
  }
}

/// A vertex at rest on a plane with this slope, where its law carries it.
struct Slope {
  Vector3d normal, down;
  TouchingVertices body;
  ObstacleContact contact;
  ContactImpulses impulses;
  static constexpr double g = 9.81;

  Slope(double angle, double friction, int exponent, double restitution = 0.5)
      : normal(std::sin(angle), 0, std::cos(angle)),
        down(std::cos(angle), 0, -std::sin(angle)),
        body(one_vertex({0.3, -0.7, 0.4}, {0, 0, 0})),
        contact({contact_law(exponent, restitution, friction)}, {{HalfSpace{body.x[0], unit(normal)}}}, body.samples),
        impulses(&contact) {
    normal = std::get<HalfSpace>(contact.obstacles()[0].shape).normal;
    down = Vector3d(normal[2], 0, -normal[0]);
    body.gravity = {0, 0, -g};
    body.x[0] -= contact.laws()[0].depth_at_rest(mass * g * normal[2] / area) * normal;
  }
  static Vector3d unit(const Vector3d& n) { return n / n.norm(); }
  void run(int steps, double h) {
    for (int k = 0; k < steps; ++k) body.step(contact, impulses, h);
  }
};

// On either side of the steepest slope that friction can hold: not one bit of creep in 1e5 steps, and a slide with the
// remaining acceleration. Normal to the plane the vertex rests where rounding has put it, or oscillates by roundings:
// along it, a coordinate of 0.3 that moves by less than 2^-54 stays.
TEST(ContactFriction, HoldsAVertexToTheLastBitUpToItsSlope) {
  for (const int p : {2, 3, 4})
    for (const double mu : {0.3, 0.7}) {
      Slope holds(std::atan(mu) - 1e-6, mu, p);
      holds.run(1000, 1e-3);
      const Vector3d at = holds.body.x[0];
      holds.run(100000, 1e-3);
      EXPECT_EQ(holds.body.x[0], at) << p << ' ' << mu;
      EXPECT_LE(std::abs(holds.body.v[0].dot(holds.down)), 1e-16);
      const double angle = std::atan(mu) + 1e-6;
      Slope slides(angle, mu, p);
      const Vector3d from = slides.body.x[0];
      slides.run(10000, 1e-3);
      EXPECT_GT((slides.body.x[0] - from).dot(slides.down), 0.4 * 1e-6 * Slope::g * 100.0);
    }
}

/// Four vertices of different masses that rest on a slope by their own samples and, for two thirds, by their middle.
struct FourOnASlope {
  static constexpr double mu = 0.5;
  Vector3d normal, down;
  TouchingVertices body;
  ObstacleContact contact;
  ContactImpulses impulses;

  FourOnASlope()
      : normal(Slope::unit({std::sin(angle()), 0, std::cos(angle())})),
        down(normal[2], 0, -normal[0]),
        contact({contact_law(3, 0.5, mu)}, {{HalfSpace{{0, 0, 0}, normal}}}, body.samples),
        impulses(&contact) {
    const double depth = contact.laws()[0].depth_at_rest(4 * mass * Slope::g * normal[2] / area);
    for (const double a : {0.0, 0.1})
      for (const double b : {0.0, 0.1}) body.x.emplace_back(a * down + b * Vector3d(0, 1, 0) - depth * normal);
    body.v.assign(4, Vector3d(0, 0, 0));
    body.inverse_mass = {0.5 / mass, 1.0 / (0.5 * mass), 1.0 / (0.7 * mass), 1.0 / (0.8 * mass)};
    body.gravity = {0, 0, -Slope::g};
    for (std::uint32_t k = 0; k < 4; ++k) body.samples.push_back({{k}, 1, area / 12});
    body.samples.push_back({{0, 1, 3, 2}, 4, area / 1.5});
  }
  static double angle() { return std::atan(0.9 * mu); }
};

// The heavy ones cannot hold themselves, and the friction that the middle takes for them pushes the light ones, which
// have to give it back. Each sweep leaves a share of that, and the next step begins with it: in the end nothing moves
// along the slope; without friction they would move 2 m.
TEST(ContactFriction, HoldsABodyByWhatItsSamplesCanTogether) {
  FourOnASlope four;
  const auto run = [&four](int steps) {
    for (int k = 0; k < steps; ++k) four.body.step(four.contact, four.impulses, 1e-3);
  };
  run(2000);  // until it has settled across the slope
  const std::vector<Vector3d> from = four.body.x;
  run(1000);
  for (std::size_t i = 0; i < 4; ++i) {
    const Vector3d way = four.body.x[i] - from[i];
    EXPECT_LE((way - way.dot(four.normal) * four.normal).norm(), 1e-15) << i;
  }
}

TEST(ContactFriction, LetsAVertexSlideWithTheAccelerationThatIsLeft) {
  for (const int p : {2, 3, 4}) {
    const double angle = 0.6, mu = 0.4;
    Slope slope(angle, mu, p);
    slope.run(1000, 1e-3);
    const double a = Slope::g * (std::sin(angle) - mu * std::cos(angle));
    EXPECT_NEAR(slope.body.v[0].dot(slope.down), a, 1e-6 * a) << p;
    EXPECT_NEAR(slope.impulses.losses().rubbed, mu * mass * Slope::g * std::cos(angle) * 0.5 * a, 1e-6 * a);
  }
}

TEST(ContactFriction, StopsASlidingVertexAfterItsDistance) {
  for (const int p : {2, 3, 4})
    for (const double angle_of_way : {0.0, 1.1}) {
      const double mu = 0.4, speed = 2.0;
      Slope flat(0.0, mu, p);
      const Vector3d from = flat.body.x[0], way(std::cos(angle_of_way), std::sin(angle_of_way), 0);
      flat.body.v[0] = speed * way;
      flat.run(1000, 1e-3);
      const double distance = speed * speed / (2 * mu * Slope::g);
      EXPECT_LE((flat.body.x[0] - from - distance * way).head<2>().norm(), 1e-3 * distance) << p;
      EXPECT_LE(flat.body.v[0].head<2>().norm(), 1e-16);
      EXPECT_NEAR(flat.impulses.losses().rubbed, 0.5 * mass * speed * speed, 1e-6);
    }
}

// A step that is begun, taken back and taken again ends in the same bits as one that was not: both while contacts find
// the forces that hold them, and while they come and go.
TEST(ContactFriction, CanBeTakenBack) {
  for (const double up : {0.0, 0.3}) {
    FourOnASlope once, twice;
    for (FourOnASlope* four : {&once, &twice}) {
      for (Vector3d& v : four->body.v) v = up * four->normal + 0.02 * four->down;
      for (int k = 0; k < 120; ++k) {
        if (four == &twice) {
          const TouchingVertices kept = four->body;
          const auto accelerations = [&](std::span<const Vector3d> at, std::span<const Vector3d>,
                                         std::span<Vector3d> a) { four->body.accelerate(four->contact, at, a); };
          four->impulses.begin(kept.time, 1e-3, kept.inverse_mass, {}, kept.x, four->body.v, accelerations);
          four->impulses.take_back();
          EXPECT_TRUE(four->contact.frozen_friction().empty());
          four->body.v = kept.v;
        }
        four->body.step(four->contact, four->impulses, 1e-3);
      }
    }
    EXPECT_EQ(once.body.x, twice.body.x);
    EXPECT_EQ(once.body.v, twice.body.v);
    EXPECT_EQ(once.impulses.losses().rubbed, twice.impulses.losses().rubbed);
    EXPECT_EQ(once.impulses.losses().damped, twice.impulses.losses().damped);
    Archive a, b;
    once.impulses.state(a);
    twice.impulses.state(b);
    EXPECT_EQ(a.written(), b.written());
  }
}

TEST(ContactFriction, KeepsItsSumsInACheckpoint) {
  Slope slope(0.5, 0.3, 3);
  slope.body.v[0] = -0.1 * slope.normal;
  slope.run(50, 1e-3);
  Archive written;
  slope.impulses.state(written);
  slope.contact.state(written);
  Slope other(0.5, 0.3, 3);
  Archive read(written.written(), "file");
  other.impulses.state(read);
  other.contact.state(read);
  read.require_end();
  EXPECT_GT(other.impulses.losses().damped, 0.0);
  EXPECT_EQ(other.impulses.losses().damped, slope.impulses.losses().damped);
  EXPECT_EQ(other.impulses.losses().rubbed, slope.impulses.losses().rubbed);
}

// After the first contact no memory is allocated.
TEST(ContactFriction, NeedsNoMoreMemoryInTheSteadyState) {
  Slope slope(0.1, 0.5, 3);
  slope.run(5, 1e-3);
  const std::size_t bytes = slope.impulses.bytes() + slope.contact.bytes();
  slope.run(500, 1e-3);
  EXPECT_EQ(slope.impulses.bytes() + slope.contact.bytes(), bytes);
  EXPECT_GT(slope.impulses.bytes(), 0u);
}

}  // namespace
}  // namespace dartboard::contact_friction_test
