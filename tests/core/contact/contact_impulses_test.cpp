// Losses of a contact by restitution, and the sums of all losses.

#include "core/contact/contact_impulses.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "core/plain/random.h"
#include "tests/support/bodies/touching_vertices_for_tests.h"

namespace dartboard::contact_impulses_test {
namespace {

using Eigen::Vector3d;

constexpr double mass = TouchingVertices::mass, area = TouchingVertices::area;

// Of the second order: steps of 1/1000 of the time leave 1e-6 and some times that.
TEST(ContactImpulses, LeaveAVertexTheRestitutionOfItsLawAtAnySpeed) {
  for (const int p : {2, 3, 4})
    for (const double e : {1.0, 0.8, 0.5, 0.2})
      for (const double speed : {0.1, 10.0})
        EXPECT_NEAR(bounce(contact_law(p, e, 0.0), {0, 0, -speed}, 1e-3)[2] / speed, e, 1e-4)
            << p << ' ' << e << ' ' << speed;
}

TEST(ContactImpulses, BalanceWhatABounceHasLost) {
  for (const int p : {2, 3, 4}) {
    ContactLosses losses;
    const Vector3d v = bounce(contact_law(p, 0.5, 0.2), {3, 1, -2}, 1e-3, &losses);
    const double lost = 0.5 * mass * (14.0 - v.squaredNorm());
    EXPECT_GT(losses.damped, 0.0);
    EXPECT_GT(losses.rubbed, 0.0);
    EXPECT_EQ(losses.supplied, 0.0);
    // the error of Verlet in the energy of the way through
    EXPECT_NEAR(losses.damped + losses.rubbed, lost, 1e-4 * lost) << p;
  }
}

// A plate of four vertices and its middle falls flat: samples that share vertices count their masses once.
TEST(ContactImpulses, LeaveABodyOfManySamplesItsRestitution) {
  for (const int p : {2, 3, 4})
    for (const double speed : {0.1, 10.0}) {
      const double h = 2e-4 * contact_law(p, 1, 0).depth_at_impact(0.5 * 4 * mass * speed * speed / area) / speed;
      TouchingVertices plate;
      plate.x = {{0, 0, 2.5 * h * speed}, {1, 0, 2.5 * h * speed}, {1, 1, 2.5 * h * speed}, {0, 1, 2.5 * h * speed}};
      plate.v.assign(4, Vector3d(0, 0, -speed));
      plate.inverse_mass.assign(4, 1.0 / mass);
      for (std::uint32_t k = 0; k < 4; ++k) plate.samples.push_back({{k}, 1, area / 12});
      plate.samples.push_back({{0, 1, 2, 3}, 4, area / 1.5});
      ObstacleContact contact({contact_law(p, 0.5, 0.0)}, {{HalfSpace{}}}, plate.samples);
      ContactImpulses impulses(&contact);
      while (plate.x[0][2] > 0.0) plate.step(contact, impulses, h);
      while (plate.x[0][2] <= 0.0) plate.step(contact, impulses, h);
      for (const Vector3d& v : plate.v) EXPECT_NEAR(v[2] / speed, 0.5, 1e-4) << p << ' ' << speed;
    }
}

// Springs, samples that share vertices, a ball, a block and a plane that move: in all cases the sums account for the
// energy, up to Verlet's error in it, which goes with h^2.
TEST(ContactImpulses, AccountForAllEnergyThatIsNotConserved) {
  const auto imbalance = [](double h) {
    TouchingVertices body;
    SplitMix64 random(4);
    for (std::uint32_t k = 0; k < 8; ++k) {
      body.x.emplace_back(0.1 * (k & 1u), 0.1 * ((k >> 1u) & 1u), 0.012 + 0.1 * ((k >> 2u) & 1u));
      body.v.emplace_back(0.4, -0.2, -0.5);
      body.inverse_mass.push_back(1.0 / (0.1 + 0.02 * random.next_signed()));
      body.samples.push_back({{k}, 1, 0.002});
    }
    body.samples.push_back({{0, 1, 3, 2}, 4, 0.006});
    body.samples.push_back({{0, 1, 5, 0}, 3, 0.004});
    for (std::size_t a = 0; a < 8; ++a)
      for (std::size_t b = 0; b < a; ++b) body.springs.push_back({a, b, (body.x[a] - body.x[b]).norm(), 400.0});
    body.gravity = {0, 0, -9.81};
    Obstacle floor{HalfSpace{}, {0.05, 0, 0.02}}, ball{Ball{{0.35, 0.05, 0.05}, 0.15}},
        block{Block{{-0.3, -0.1, 0.0}, {-0.02, 0.3, 0.5}}, {0.1, 0, 0}, 0.0, 0.3};
    ContactLaw soft = contact_law(3, 0.6, 0.3), rough = contact_law(4, 1.0, 0.8), smooth = contact_law(3, 0.5, 0.0);
    for (ContactLaw* law : {&soft, &rough, &smooth}) law->depth = 0.02;
    ObstacleContact contact({soft, rough, smooth}, {floor, ball, block}, body.samples);
    ContactImpulses impulses(&contact);
    const double before = body.energy(contact);
    for (int k = 0; k < std::lround(0.5 / h); ++k) body.step(contact, impulses, h);
    const ContactLosses& lost = impulses.losses();
    EXPECT_GT(lost.damped, 1e-3);
    EXPECT_GT(lost.rubbed, 1e-3);
    EXPECT_GT(std::abs(lost.supplied), 1e-3);
    return body.energy(contact) - before - (lost.supplied - lost.damped - lost.rubbed);
  };
  const double fine = std::abs(imbalance(1e-5));
  EXPECT_LE(fine, 1e-5);  // of 1 J or so
  EXPECT_LE(fine, 0.05 * std::abs(imbalance(1e-4)) + 1e-7);
}

// A plane that rises under a vertex throws it up: in the frame of the plane the speed is multiplied by e.
TEST(ContactImpulses, BounceInTheFrameOfTheObstacle) {
  for (const int p : {2, 3, 4}) {
    const ContactLaw law = contact_law(p, 0.5, 0.3);
    TouchingVertices body = one_vertex({0, 0, 1e-4}, {0.1, 0, -1});
    Obstacle lift{HalfSpace{}, {0.1, 0, 1.0}};
    ObstacleContact contact({law}, {lift}, body.samples);
    ContactImpulses impulses(&contact);
    const double h = 1e-3 * law.depth_at_impact(0.5 * mass * 4 / area) / 2;
    const double before = body.energy(contact);
    do body.step(contact, impulses, h);
    while (body.x[0][2] <= body.time || body.v[0][2] < 0);
    EXPECT_NEAR(body.v[0][2], 1.0 + 0.5 * 2.0, 3e-4) << p;
    EXPECT_NEAR(body.v[0][0], 0.1, 1e-12);  // it moves with the plane
    const ContactLosses& lost = impulses.losses();
    EXPECT_NEAR(lost.damped, 0.5 * mass * 4 * (1 - 0.25), 1e-3);
    EXPECT_NEAR(body.energy(contact) - before, lost.supplied - lost.damped - lost.rubbed, 1e-4);
  }
}

// Fixed vertices have no part in it, and driven ones do not give way.
TEST(ContactImpulses, LeaveFixedVerticesAlone) {
  for (const double driven : {0.0, -0.5}) {
    TouchingVertices body;
    body.x = {{0, 0, -0.001}, {1, 0, -0.001}, {0, 1, -0.001}};
    body.v = {{0, 0, driven}, {0.5, 0, -1}, {0, 0, -1}};
    body.inverse_mass.assign(3, 1.0 / mass);
    body.fixed = {1, 0, 0};
    body.samples = {{{0}, 1, area}, {{0, 1, 2, 0}, 3, area}};
    ObstacleContact contact({contact_law(3, 0.5, 0.3)}, {{HalfSpace{}}}, body.samples);
    ContactImpulses impulses(&contact);
    const auto kinetic = [&] { return 0.5 * mass * (body.v[1].squaredNorm() + body.v[2].squaredNorm()); };
    const double before = kinetic();
    const auto none = [](std::span<const Vector3d>, std::span<const Vector3d>, std::span<Vector3d> a) {
      std::ranges::fill(a, Vector3d(0, 0, 0));
    };
    EXPECT_TRUE(impulses.begin(0.0, 1e-3, body.inverse_mass, body.fixed, body.x, body.v, none));
    EXPECT_EQ(body.v[0], Vector3d(0, 0, driven));
    EXPECT_GT(body.v[1][2], -1.0);
    EXPECT_EQ(contact.frozen_friction().size(), 1u);
    EXPECT_LT(contact.frozen_friction()[0].force[0], 0.0);
    const ContactLosses& lost = impulses.losses();
    EXPECT_NEAR(kinetic() - before, lost.supplied - lost.damped, 1e-15 * before);
    EXPECT_EQ(lost.supplied == 0.0, driven == 0.0);
    EXPECT_TRUE(impulses.end(0.0, 1e-3, body.inverse_mass, body.fixed, body.x, body.v));
    EXPECT_TRUE(contact.frozen_friction().empty());
  }
}

// A vertex on a rail along x meets a slope of 45 degrees: an impulse along the normal gives it half the effect along it
// of a free one, and nothing along z. The speed along the normal decays by that, and the account is even.
TEST(ContactImpulses, LeaveAVertexOnItsRail) {
  TouchingVertices body = one_vertex({-0.001, 0, 0}, {-2, 0, 0});
  const std::vector<HeldAxes> rail{6};
  Obstacle slope{HalfSpace{{0, 0, 0}, Vector3d(1, 0, 1).normalized()}};
  const ContactLaw law = contact_law(3, 0.5, 0.0);
  ObstacleContact contact({law}, {slope}, body.samples);
  ContactImpulses impulses(&contact);
  // half of 1 / mass is along the normal, and it starts inside as if it had come in at `first`
  const double h = 1e-3, depth = 0.001 / std::sqrt(2.0), mobility = 0.5 / mass,
               first = std::sqrt(2.0 + 2.0 * law.energy(area, depth) * mobility),
               decay = law.loss() * law.force(area, depth) * mobility / first;
  impulses.begin(0.0, h, body.inverse_mass, {body.fixed, rail}, body.x, body.v, {});
  EXPECT_EQ(body.v[0][2], 0.0);
  EXPECT_EQ(body.v[0][1], 0.0);
  EXPECT_NEAR(body.v[0][0], -2 * std::exp(-decay * (h / 2)), 1e-14);
  EXPECT_LT(body.v[0][0], -1.0);
  EXPECT_GT(body.v[0][0], -1.999);
  EXPECT_NEAR(impulses.losses().damped, 0.5 * mass * (4 - body.v[0].squaredNorm()), 1e-14);
}

// A plane that leaves a vertex inside it faster than it follows pushes it, or not, and never pulls: neither at rest nor
// with gravity, which takes g t of its speed. At a constant relative speed the impulses take what the step has pushed.
TEST(ContactImpulses, OnlyPushWhatAnObstacleLeaves) {
  for (const int p : {2, 3, 4})
    for (const double e : {0.9, 0.5, 0.2, 0.05})
      for (const double leaves : {0.01, 1.0, 100.0})
        for (const double g : {0.0, 9.81})
          for (const double h : {1e-5, 1e-4, 1e-3}) {
            TouchingVertices body = one_vertex({0, 0, -0.001}, {0, 0, 0});
            body.gravity = {0, 0, -g};
            ObstacleContact contact({contact_law(p, e, 0.0)}, {{HalfSpace{}, {0, 0, -leaves}}}, body.samples);
            ContactImpulses impulses(&contact);
            double before = 0.0;
            for (int k = 0; k < 50; ++k) {
              body.step(contact, impulses, h);
              ASSERT_GE(body.v[0][2] - before, -g * h - 1e-12 * std::max(1.0, leaves))
                  << p << ' ' << e << ' ' << leaves << ' ' << g << ' ' << h;
              before = body.v[0][2];
            }
            EXPECT_GE(impulses.losses().damped, 0.0);
          }
}

// At rest, so little inside that its force and its energy are zero to rounding: it stays there.
TEST(ContactImpulses, LeaveASampleAtRestWhoseForceVanishes) {
  for (const int p : {2, 3, 4})
    for (const double depth : {1e-100, 1e-170, 5e-324}) {
      TouchingVertices body = one_vertex({0, 0, -depth}, {0, 0, 0});
      ObstacleContact contact({contact_law(p, 0.5, 0.3)}, {{HalfSpace{}}}, body.samples);
      ContactImpulses impulses(&contact);
      body.step(contact, impulses, 1e-4);
      EXPECT_GE(body.v[0][2], 0.0) << p << ' ' << depth;
      EXPECT_LE(body.v[0].norm(), 1e-90) << p << ' ' << depth;
    }
}

// In a law too soft to matter, a vertex that is slowed down meets the surface within a step, at the speed that is left
// there. The moment is that of the mean speed: off by (g h)^2 / 8 v at most.
TEST(ContactImpulses, BeginAtTheSpeedAtWhichASampleMeetsTheSurface) {
  for (const double height : {0.001, 0.02, 0.05, 0.085}) {
    const double g = -2.0, h = 0.1, speed = 1.0, met = std::sqrt(speed * speed + 2.0 * g * height);
    ContactLaw law = contact_law(3, 0.5, 0.0);
    law.pressure = 1e-12;
    TouchingVertices body = one_vertex({0, 0, height}, {0, 0, -speed});
    ObstacleContact contact({law}, {{HalfSpace{}}}, body.samples);
    Bounces bounces(&contact);
    ContactLosses losses;
    const HeldVertices free;
    bounces.before({0.0, h, &contact, body.inverse_mass, free, body.x, body.v}, losses);
    body.x[0][2] -= speed * h + 0.5 * g * h * h;
    body.v[0][2] -= g * h;
    bounces.after({h, h, &contact, body.inverse_mass, free, body.x, body.v}, losses);
    // the factor is 1 + s rate / first
    const double rate = 0.5,
                 first = law.loss() * rate / (bounces.factor({.sample = 0, .obstacle = 0, .law = &law}, rate) - 1.0);
    EXPECT_NEAR(first, met, g * h * g * h / (8 * (speed + g * h / 2))) << height;
  }
}

// A sample keeps the rate at which it met the surface when samples are numbered anew, and when a step is taken back.
TEST(ContactImpulses, KnowTheFirstRateOfASampleByItsVertices) {
  const auto run = [](bool disturbed) {
    TouchingVertices two;
    two.x = {{0, 0, 1e-4}, {1, 0, 2e-3}};
    two.v = {{0, 0, -1}, {0, 0, -3}};
    two.inverse_mass.assign(2, 1.0 / mass);
    two.samples = {{{0}, 1, area}, {{1}, 1, area}};
    ObstacleContact contact({contact_law(3, 0.3, 0.0)}, {{HalfSpace{}}}, two.samples);
    ContactImpulses impulses(&contact);
    const double h = 2e-5;
    for (int k = 0; k < 1500; ++k) {
      two.step(contact, impulses, h);
      if (!disturbed) continue;
      std::swap(two.samples[0], two.samples[1]);
      const std::vector<Vector3d> v = two.v;
      impulses.begin(two.time, h, two.inverse_mass, {}, two.x, two.v, {});
      impulses.take_back();
      two.v = v;
    }
    return two.v;
  };
  const std::vector<Vector3d> left = run(false);
  EXPECT_NEAR(left[0][2], 0.3, 1e-3);
  EXPECT_NEAR(left[1][2], 0.9, 3e-3);
  EXPECT_EQ(run(true), left);
}

// The memory of an integrator stays valid as long as nothing touches and nothing moves.
TEST(ContactImpulses, TellWhetherAnythingHasChanged) {
  const auto none = [](std::span<const Vector3d>, std::span<const Vector3d>, std::span<Vector3d>) {
    FAIL() << "no accelerations are needed where nothing touches";
  };
  const auto changes = [&](const ContactLaw& law, const Obstacle& obstacle, const Vector3d& x) {
    TouchingVertices body = one_vertex(x, {0, 0, -1});
    ObstacleContact contact({law}, {obstacle}, body.samples);
    ContactImpulses impulses(&contact);
    const bool begin = impulses.begin(0.0, 1e-3, body.inverse_mass, body.fixed, body.x, body.v, none);
    const bool end = impulses.end(0.0, 1e-3, body.inverse_mass, body.fixed, body.x, body.v);
    EXPECT_EQ(begin, end);
    return begin;
  };
  const Obstacle still{HalfSpace{}}, moving{HalfSpace{}, {0, 0, 1}}, later{HalfSpace{}, {0, 0, 1}, 5.0};
  EXPECT_FALSE(changes(contact_law(3, 0.5, 0.5), still, {0, 0, 1}));
  EXPECT_FALSE(changes(contact_law(3, 0.5, 0.5), later, {0, 0, 1}));
  EXPECT_FALSE(changes(contact_law(3, 0.5, 0.5), moving, {0, 0, 1}));
  EXPECT_TRUE(changes(contact_law(3, 1.0, 0.0), moving, {0, 0, -0.001}));
  EXPECT_TRUE(changes(contact_law(3, 0.5, 0.0), still, {0, 0, -0.001}));
  EXPECT_FALSE(changes(contact_law(3, 1.0, 0.0), still, {0, 0, -0.001}));
}

}  // namespace
}  // namespace dartboard::contact_impulses_test
