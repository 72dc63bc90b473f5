// Contact between bodies in time: collisions, rest, bounces, sticking and sliding.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "core/contact/contact_impulses.h"
#include "core/contact/contacts.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/error.h"
#include "core/time/integrators.h"
#include "core/time/system/accelerations.h"
#include "core/time/system/energy.h"
#include "tests/support/bodies/element_body_for_tests.h"
#include "tests/support/bodies/touching_bodies_for_tests.h"

namespace dartboard::body_contact_motion_test {
namespace {

using Eigen::Vector3d;

/// Two bodies of elements that touch each other, and obstacles if there are any, with impulses around each step.
struct Colliding {
  ElementBody body;
  std::size_t first;  // points of the first body
  std::unique_ptr<MeshSkin> skin;
  std::unique_ptr<BodyContact> contact;
  std::unique_ptr<ObstacleContact> floor;
  std::vector<const ForceTerm*> terms;
  std::unique_ptr<ContactImpulses> impulses;
  std::unique_ptr<Integrator> method;
  double time = 0.0;

  Colliding(std::string_view integrator, const Mesh& one, const Mesh& other, double young, const ContactLaw& law,
            const std::vector<Obstacle>& obstacles = {}, std::vector<ContactLaw> with_obstacles = {})
      : body(together(one, other), Model::neo_hookean, young, 0.3),
        first(one.points.size()),
        skin(std::make_unique<MeshSkin>(
            skin_of_mesh<TetMap>(together(one, other), static_cast<std::uint32_t>(one.cell_count())))),
        contact(std::make_unique<BodyContact>(skin->samples, skin->solids, std::vector<ContactPair>{{0, 1, law}})),
        method(make_integrator(integrator)) {
    terms = {body.term.get(), contact.get()};
    if (!obstacles.empty()) {
      floor = std::make_unique<ObstacleContact>(std::move(with_obstacles), obstacles, skin->samples);
      terms.push_back(floor.get());
    }
    impulses = std::make_unique<ContactImpulses>(Contacts(floor.get(), contact.get()));
  }
  SpringSystem system() const {
    SpringSystem system = body.system();
    system.terms = terms;
    return system;
  }
  double energy() const { return total_energy(system(), body.x, body.v); }
  StepResult step(double h) {
    const SpringSystem now = system();
    const Terms parts = terms_of(now);
    const auto acceleration = [&](std::span<const Vector3d> at, std::span<const Vector3d> speed,
                                  std::span<Vector3d> a) { accelerations(now, parts, at, speed, a); };
    if (impulses->begin(time, h, body.inverse_mass, body.fixed, body.x, body.v, acceleration)) method->restart();
    const StepResult result = method->step(now, body.motion(), h);
    if (impulses->end(time, h, body.inverse_mass, body.fixed, body.x, body.v)) method->restart();
    time += h;
    return result;
  }
  Vector3d momentum() const { return linear_momentum(system(), body.v); }
  Vector3d spin() const {
    Vector3d sum(0, 0, 0);
    for (std::size_t i = 0; i < body.x.size(); ++i) sum += body.mass[i] * body.x[i].cross(body.v[i]);
    return sum;
  }
  /// Mean velocity of one of the two.
  Vector3d speed(int which) const {
    const std::size_t from = which == 0 ? 0 : first, to = which == 0 ? first : body.x.size();
    double all = 0.0;
    Vector3d sum(0, 0, 0);
    for (std::size_t i = from; i < to; ++i) {
      all += body.mass[i];
      sum += body.mass[i] * body.v[i];
    }
    return sum / all;
  }
  std::size_t contacts() const { return Contacts(nullptr, contact.get()).state_at(body.x).contacts; }
};

Mesh turned(Mesh mesh, const Vector3d& axis, double angle) {
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  for (Vector3d& p : mesh.points) p = turn * p;
  return mesh;
}

/// Two boxes that fly into each other, askew.
Colliding collision(std::string_view integrator, const ContactLaw& law) {
  const Mesh box = kuhn_box(2, 2, 2, 0.1);
  Colliding two(integrator, turned(box, {1, 2, 3}, 0.4), shifted(turned(box, {3, -1, 1}, 0.7), {0.05, 0.07, 0.37}), 2e4,
                law);
  for (std::size_t i = 0; i < two.body.v.size(); ++i)
    two.body.v[i] = i < two.first ? Vector3d(0.1, 0, 0.4) : Vector3d(-0.1, 0.2, -0.5);
  return two;
}

/// Root of the mean square.
double distance(const Colliding& a, const Colliding& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.body.x.size(); ++i) sum += (a.body.x[i] - b.body.x[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.body.x.size()));
}

// Errors of the sums are roundings; that of the energy comes from kinks where another triangle becomes the nearest.
TEST(BodyContactMotion, CollidesWithoutLossOfMomentumSpinOrEnergy) {
  for (const int p : {2, 3, 4})
    for (const char* integrator : {"blanes-moan-4", "verlet"}) {
      Colliding two = collision(integrator, law_between(p, 2e3, 0.02));
      const Vector3d momentum = two.momentum(), spin = two.spin();
      const double before = two.energy();
      double worst = 0.0, size = 0.0, length = 0.0;
      std::size_t contacts = 0;
      for (std::size_t i = 0; i < two.body.x.size(); ++i) size += two.body.mass[i] * two.body.v[i].norm();
      for (const Vector3d& x : two.body.x) length = std::max(length, x.norm());
      for (int k = 0; k < 600; ++k) {
        ASSERT_TRUE(two.step(1e-3).ok());
        worst = std::max(worst, std::abs(two.energy() / before - 1.0));
        contacts = std::max(contacts, two.contacts());
      }
      EXPECT_GT(contacts, 10u);
      EXPECT_EQ(two.contacts(), 0u);
      EXPECT_GT((two.speed(1) - two.speed(0))[2], 0.3);  // they fly apart
      EXPECT_LE((two.momentum() - momentum).norm(), 1e-13 * size) << p << ' ' << integrator;
      EXPECT_LE((two.spin() - spin).norm(), 1e-13 * size * length) << p << ' ' << integrator;
      EXPECT_LE(worst, integrator == std::string("verlet") ? 2e-3 : 5e-4) << p << ' ' << integrator;
    }
}

// All arrive at the same place, up to their errors: orders above two are lost because of the kinks. One method requires
// what kinks do not have, and reports it.
TEST(BodyContactMotion, IsTakenByEveryIntegratorButThatOfDiscreteGradients) {
  Colliding truth = collision("rk4", law_between(3, 2e3, 0.02));
  for (int k = 0; k < 4096; ++k) ASSERT_TRUE(truth.step(0.3 / 4096).ok());
  ASSERT_GT(truth.contacts(), 10u);
  for (const IntegratorEntry& entry : integrators()) {
    Colliding once = collision(entry.name, law_between(3, 2e3, 0.02)),
              twice = collision(entry.name, law_between(3, 2e3, 0.02));
    if (entry.name == "energy-momentum") {
      EXPECT_THROW(once.step(1e-3), SolverError);
      continue;
    }
    for (int k = 0; k < 256; ++k) {
      const StepResult result = once.step(0.3 / 256);
      ASSERT_TRUE(result.ok()) << entry.name << ": " << to_string(result);
    }
    for (int k = 0; k < 512; ++k) ASSERT_TRUE(twice.step(0.3 / 512).ok()) << entry.name;
    const double first = distance(once, truth), second = distance(twice, truth);
    if (scheme_of(entry.name).order == 1) {
      EXPECT_LE(second, first / 1.6) << entry.name << ' ' << first;
      EXPECT_LE(first, 1e-3) << entry.name;
    } else {
      EXPECT_LE(first, 5e-5) << entry.name;
      EXPECT_LE(second, 5e-5) << entry.name;
    }
  }
}

/// A box of n cells a side and of width 0.2 on a slab that is held, h = 0.2 / n wider on each side.
Colliding box_on_slab(std::string_view integrator, int n, double young, const ContactLaw& law) {
  const double h = 0.2 / n;
  Colliding two(integrator, kuhn_box(n + 2, n + 2, 1, h), shifted(kuhn_box(n, n, n, h), {h, h, h}), young, law);
  for (std::size_t i = 0; i < two.first; ++i) two.body.fixed[i] = 1;
  return two;
}

// On the box the sides' lowest vertices carry too, which is h / 2 L = 1/8 more; on the slab those below the border of
// the box have no depth, as its sides are as near as its bottom: 1 - (3/4 + (n - 1)^2 / 4 n^2) less. Half of both.
TEST(BodyContactMotion, RestsAsDeepAsItsWeightNeeds) {
  const double g = 9.81;
  for (const int p : {2, 3, 4}) {
    const ContactLaw law = law_between(p, 5e3, 0.004);
    Colliding two = box_on_slab("backward-euler", 4, 1e7, law);
    two.body.gravity = {0, 0, -g};
    const double expected = law.depth_at_rest(1000.0 * g * 0.2);
    for (std::size_t i = two.first; i < two.body.x.size(); ++i) two.body.x[i][2] -= 0.9 * expected;
    for (int k = 0; k < 60; ++k) {
      const StepResult result = two.step(0.02);
      ASSERT_TRUE(result.ok()) << p << ": " << to_string(result);
    }
    double sum = 0.0, count = 0.0;
    for (std::size_t i = two.first; i < two.body.x.size(); ++i)
      if (two.body.rest[i][2] == two.body.rest[two.first][2]) {
        sum += two.body.rest[i][2] - two.body.x[i][2];
        count += 1.0;
      }
    const double area = 0.5 * (1.125 + 0.75 + 0.25 * 9 / 16);
    EXPECT_NEAR(sum / count / expected, std::pow(area, -1.0 / (p - 1)), 2e-3) << p;
  }
}

// No vertex of either is inside the other, and their edges have no depth: middles alone carry.
TEST(BodyContactMotion, LetsNoAlignedBoxesOfOneCellThroughEachOther) {
  Colliding two("verlet", kuhn_box(1, 1, 1, 0.2), shifted(kuhn_box(1, 1, 1, 0.2), {0, 0, 0.205}), 1e6,
                law_between(3, 1e4, 0.02));
  for (std::size_t i = 0; i < two.body.v.size(); ++i) two.body.v[i][2] = i < two.first ? 0.25 : -0.25;
  std::size_t contacts = 0;
  for (int k = 0; k < 2000; ++k) {
    ASSERT_TRUE(two.step(1e-4).ok());
    contacts = std::max(contacts, two.contacts());
    ASSERT_LE(Contacts(nullptr, two.contact.get()).state_at(two.body.x).deepest, 0.03);
  }
  EXPECT_GE(contacts, 4u);
  EXPECT_GT((two.speed(1) - two.speed(0))[2], 0.45);
}

// Two equal boxes, stiff against their contact, fly flat into each other.
TEST(BodyContactMotion, LeavesTwoStiffBodiesTheRestitutionOfTheirLaw) {
  for (const int p : {2, 3}) {
    ContactLaw law = law_between(p, 2e3, 0.02);
    law.restitution = 0.5;
    for (const double speed : {0.05, 0.5}) {
      Colliding two("verlet", kuhn_box(2, 2, 2, 0.1), shifted(kuhn_box(2, 2, 2, 0.1), {0, 0, 0.2001}), 1e7, law);
      for (std::size_t i = 0; i < two.body.v.size(); ++i) two.body.v[i][2] = i < two.first ? speed / 2 : -speed / 2;
      const double before = two.energy();
      do ASSERT_TRUE(two.step(1e-4).ok());
      while (two.contacts() > 0 || two.speed(1)[2] < two.speed(0)[2]);
      EXPECT_NEAR((two.speed(1) - two.speed(0))[2] / speed, 0.5, 0.01) << p << ' ' << speed;
      EXPECT_NEAR((two.energy() + two.impulses->losses().damped) / before, 1.0, 1e-3);
    }
  }
}

// The upper of two boxes, a little in each other, is drawn off: what it leaves is pushed down or not at all.
TEST(BodyContactMotion, LiftsNothingThatIsLeft) {
  for (const int p : {2, 3, 4})
    for (const double e : {0.9, 0.5, 0.1})
      for (const char* integrator : {"verlet", "rk4"}) {
        ContactLaw law = law_between(p, 2e3, 0.02);
        law.restitution = e;
        Colliding two(integrator, kuhn_box(2, 2, 2, 0.1), shifted(kuhn_box(2, 2, 2, 0.1), {0.03, 0.04, 0.195}), 1e5,
                      law);
        for (std::size_t i = two.first; i < two.body.v.size(); ++i) {
          two.body.fixed[i] = 1;
          two.body.v[i] = {0, 0, 1};
        }
        double before = 0.0;
        for (int k = 0; k < 40; ++k) {
          for (std::size_t i = two.first; i < two.body.x.size(); ++i) two.body.x[i][2] += 2e-4;
          ASSERT_TRUE(two.step(2e-4).ok());
          const double now = two.speed(0)[2];
          EXPECT_LE(now - before, 1e-15) << p << ' ' << e << ' ' << integrator << ' ' << k;
          before = now;
        }
      }
}

// Losses are reported, and no momentum is lost. Verlet takes forces where friction has been found, half way through the
// step, so that the two points of action coincide: there is no torque. Others take forces before and after, too.
TEST(BodyContactMotion, KeepsMomentumAndSpinThroughRestitutionAndFriction) {
  for (const char* integrator : {"verlet", "rk4"}) {
    ContactLaw law = law_between(3, 2e3, 0.02);
    law.restitution = 0.6;
    law.friction = 0.5;
    Colliding two = collision(integrator, law);
    const Vector3d momentum = two.momentum(), spin = two.spin();
    const double before = two.energy();
    double size = 0.0, length = 0.0;
    for (std::size_t i = 0; i < two.body.x.size(); ++i) size += two.body.mass[i] * two.body.v[i].norm();
    for (const Vector3d& x : two.body.x) length = std::max(length, x.norm());
    for (int k = 0; k < 600; ++k) ASSERT_TRUE(two.step(1e-3).ok());
    const ContactLosses& lost = two.impulses->losses();
    EXPECT_GT(lost.damped, 0.1 * before);
    EXPECT_GT(lost.rubbed, 0.1 * before);
    EXPECT_EQ(lost.supplied, 0.0);
    EXPECT_NEAR(two.energy() + lost.damped + lost.rubbed, before, 2e-3 * before) << integrator;
    EXPECT_LE((two.momentum() - momentum).norm(), 1e-13 * size) << integrator;
    EXPECT_LE((two.spin() - spin).norm(), (integrator == std::string("verlet") ? 1e-13 : 1e-6) * size * length);
  }
}

/// Position along x of the bottom of the upper body.
double bottom_of(const Colliding& two) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = two.first; i < two.body.x.size(); ++i)
    if (two.body.rest[i][2] == two.body.rest[two.first][2]) {
      sum += two.body.x[i][0];
      count += 1.0;
    }
  return sum / count;
}

// On a slope, on a slab so large that none of its own samples is below the box: no borders are passed, and the whole
// weight is on half of the area.
TEST(BodyContactMotion, SlidesOnABodyWithTheAccelerationThatIsLeft) {
  const double g = 9.81, angle = 0.4, mu = 0.25, seconds = 0.1;
  for (const char* integrator : {"verlet", "blanes-moan-4", "backward-euler"}) {
    ContactLaw law = law_between(3, 2e4, 0.005);
    law.restitution = 0.3;
    law.friction = mu;
    Colliding two(integrator, kuhn_box(1, 1, 1, 0.8), shifted(kuhn_box(2, 2, 2, 0.1), {0.05, 0.3, 0.8}), 1e6, law);
    for (std::size_t i = 0; i < two.first; ++i) two.body.fixed[i] = 1;
    two.body.gravity = g * Vector3d(std::sin(angle), 0, -std::cos(angle));
    const double depth = law.depth_at_rest(2 * 1000.0 * 0.2 * g * std::cos(angle) / 1.25);
    for (std::size_t i = two.first; i < two.body.x.size(); ++i) two.body.x[i][2] -= depth;
    const auto run = [&two, seconds] {
      for (int k = 0; k < 200; ++k) ASSERT_TRUE(two.step(seconds / 200).ok());
    };
    run();
    run();
    const Vector3d from = two.speed(1);
    run();
    const double left = g * (std::sin(angle) - mu * std::cos(angle));
    EXPECT_NEAR((two.speed(1) - from)[0] / seconds, left, 0.01 * left) << integrator;
  }
}

// With samples of both sides, and more friction than the slope: once it has settled the bottom stays.
TEST(BodyContactMotion, HoldsABoxOnABodyThatSlopes) {
  const double g = 9.81, angle = 0.4;
  for (const char* integrator : {"verlet", "blanes-moan-4"}) {
    ContactLaw law = law_between(3, 2e4, 0.005);
    law.restitution = 0.3;
    law.friction = 0.5;
    Colliding two = box_on_slab(integrator, 2, 1e6, law);
    two.body.gravity = g * Vector3d(std::sin(angle), 0, -std::cos(angle));
    const double depth = law.depth_at_rest(1000.0 * 0.2 * g * std::cos(angle));
    for (std::size_t i = two.first; i < two.body.x.size(); ++i) two.body.x[i][2] -= depth;
    for (int k = 0; k < 1000; ++k) ASSERT_TRUE(two.step(5e-4).ok());
    const double at = bottom_of(two);
    for (int k = 0; k < 500; ++k) ASSERT_TRUE(two.step(5e-4).ok());
    EXPECT_LE(std::abs(bottom_of(two) - at), 1e-6) << integrator;
  }
}

/// Two boxes on each other and on a floor that slopes: by both frictions together they hold.
TEST(BodyContactMotion, HoldsAStackOnASlopeByBothFrictionsTogether) {
  const double g = 9.81, angle = 0.3;
  for (const double between : {0.5, 0.1}) {
    ContactLaw law = law_between(3, 2e4, 0.005), below = law;
    law.restitution = below.restitution = 0.3;
    law.friction = between;
    below.friction = 0.5;
    Colliding two("verlet", kuhn_box(3, 3, 2, 0.1), shifted(kuhn_box(2, 2, 2, 0.1), {0.05, 0.05, 0.198}), 1e6, law,
                  {{HalfSpace{{0, 0, 0.002}, {0, 0, 1}}}}, {below});
    two.body.gravity = g * Vector3d(std::sin(angle), 0, -std::cos(angle));
    for (int k = 0; k < 1000; ++k) ASSERT_TRUE(two.step(5e-4).ok());
    const double at = bottom_of(two);
    for (int k = 0; k < 500; ++k) ASSERT_TRUE(two.step(5e-4).ok());
    const double way = bottom_of(two) - at, free = 0.5 * g * (std::sin(angle) - between * std::cos(angle)) * 0.0625;
    if (between > std::tan(angle)) {
      EXPECT_LE(std::abs(way), 5e-4);  // the remaining oscillation
    } else {
      EXPECT_GT(way, free);  // in addition to the speed that it has by then
    }
  }
}

// The margin determines when lists are made; the run has the same bits with any margin.
TEST(BodyContactMotion, HasBitsThatKnowNothingOfMargins) {
  const auto run = [](double margin, std::uint64_t& made) {
    ContactLaw law = law_between(3, 2e3, 0.02);
    law.restitution = 0.6;
    law.friction = 0.3;
    Colliding two = collision("verlet", law);
    two.contact->set_margin(margin);
    for (int k = 0; k < 600; ++k) EXPECT_TRUE(two.step(1e-3).ok());
    made = two.contact->candidates().times_made();
    return two.body.x;
  };
  std::uint64_t first = 0, made = 0;
  const auto expected = run(0.25, first);
  for (const double margin : {0.01, 0.1, 1.0}) {
    EXPECT_EQ(run(margin, made), expected) << margin;
    EXPECT_NE(made, first) << margin;
  }
  EXPECT_LT(first, 200u);
}

}  // namespace
}  // namespace dartboard::body_contact_motion_test
