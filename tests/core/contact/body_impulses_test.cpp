// Losses of contact between bodies by restitution and friction, on both of them.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "core/base/archive.h"
#include "core/contact/contact_impulses.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/random.h"
#include "tests/support/bodies/touching_bodies_for_tests.h"

namespace dartboard::body_impulses_test {
namespace {

using Eigen::Vector3d;

/// Two balls that overlap, with random masses and velocities.
struct Balls {
  Mesh mesh;
  std::unique_ptr<MeshSkin> skin;
  std::vector<Vector3d> x, v;
  std::vector<double> inverse_mass;
  std::vector<std::uint8_t> fixed;
  BodyContact contact;
  ContactImpulses impulses;

  Balls(double restitution, double friction, double apart = 0.0)
      : mesh(together(tetrahedron_ball(2, 0.5), shifted(tetrahedron_ball(3, 0.4), {0.3 + apart, 0.5, 0.35}))),
        skin(std::make_unique<MeshSkin>(skin_of_mesh<Map3>(mesh, 64))),
        x(mesh.points),
        contact(skin->samples, skin->solids, {{0, 1, law(restitution, friction)}}),
        impulses(Contacts(nullptr, &contact)) {
    SplitMix64 random(5);
    for (std::size_t i = 0; i < x.size(); ++i) {
      Vector3d speed(0, 0, 0);
      for (double& c : speed) c = random.next_signed();
      v.push_back(speed);
      inverse_mass.push_back(1.0 + 0.5 * random.next_signed());
    }
  }
  static ContactLaw law(double restitution, double friction) {
    ContactLaw law = law_between(3, 1000.0, 0.1);
    law.restitution = restitution;
    law.friction = friction;
    return law;
  }
  static void no_acceleration(std::span<const Vector3d>, std::span<const Vector3d>, std::span<Vector3d> a) {
    std::ranges::fill(a, Vector3d(0, 0, 0));
  }
  bool begin(double h) { return impulses.begin(0.0, h, inverse_mass, fixed, x, v, no_acceleration); }
  bool end(double h) { return impulses.end(0.0, h, inverse_mass, fixed, x, v); }
  bool moves(std::size_t i) const { return fixed.empty() || fixed[i] == 0; }
  double kinetic() const {
    double sum = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (moves(i)) sum += 0.5 * v[i].squaredNorm() / inverse_mass[i];
    return sum;
  }
  Vector3d momentum() const {
    Vector3d sum(0, 0, 0);
    for (std::size_t i = 0; i < x.size(); ++i) sum += v[i] / inverse_mass[i];
    return sum;
  }
  Vector3d spin() const {
    Vector3d sum(0, 0, 0);
    for (std::size_t i = 0; i < x.size(); ++i) sum += x[i].cross(v[i]) / inverse_mass[i];
    return sum;
  }
};

TEST(BodyImpulses, LoseWhatTheyTellAndNoMomentum) {
  Balls balls(0.5, 0.0);
  const double before = balls.kinetic(), size = before;
  const Vector3d momentum = balls.momentum(), spin = balls.spin();
  EXPECT_TRUE(balls.begin(0.01));
  const ContactLosses& lost = balls.impulses.losses();
  EXPECT_GT(lost.damped, 1e-3 * before);
  EXPECT_NEAR(balls.kinetic() + lost.damped, before, 1e-14 * before);
  EXPECT_EQ(lost.supplied, 0.0);
  EXPECT_EQ(lost.rubbed, 0.0);
  EXPECT_LE((balls.momentum() - momentum).norm(), 1e-14 * size);
  EXPECT_LE((balls.spin() - spin).norm(), 1e-14 * size);
  EXPECT_TRUE(balls.end(0.01));
  // however long the step: damping never reverses the velocity of a contact
  Balls stiff(0.01, 0.0);
  const double least = stiff.kinetic();
  stiff.begin(1e6);
  EXPECT_LT(stiff.kinetic(), least);
}

// Driven vertices do not give way, and their drive does work.
TEST(BodyImpulses, LeaveFixedVerticesAlone) {
  Balls balls(0.5, 0.0);
  balls.fixed.assign(balls.x.size(), 0);
  for (std::size_t i = 0; i < balls.x.size(); i += 2) balls.fixed[i] = 1;
  const std::vector<Vector3d> v = balls.v;
  const double before = balls.kinetic();
  balls.begin(0.01);
  for (std::size_t i = 0; i < v.size(); i += 2) EXPECT_EQ(balls.v[i], v[i]);
  const ContactLosses& lost = balls.impulses.losses();
  EXPECT_NE(lost.supplied, 0.0);
  EXPECT_NEAR(balls.kinetic() - before, lost.supplied - lost.damped, 1e-14 * before);
  balls.fixed.assign(balls.x.size(), 1);
  const std::vector<Vector3d> all = balls.v;
  balls.begin(0.01);
  EXPECT_EQ(balls.v, all);
}

// At most mu times the normal force half way through the step, perpendicular to it, and at one place there.
TEST(BodyImpulses, HaveFrictionWithoutTorqueHalfWay) {
  const double h = 1e-3, mu = 0.3;
  Balls balls(1.0, mu);
  EXPECT_TRUE(balls.begin(h));
  std::vector<Vector3d> half = balls.x;
  for (std::size_t i = 0; i < half.size(); ++i) half[i] += (h / 2) * balls.v[i];
  const auto touches = balls.contact.touching({half});
  const auto frozen = balls.contact.frozen_friction();
  ASSERT_GT(frozen.size(), 10u);
  ASSERT_EQ(frozen.size(), touches.size());
  std::size_t sliding = 0;
  for (std::size_t k = 0; k < frozen.size(); ++k) {
    const BodyTouch& t = touches[k];
    ASSERT_EQ(frozen[k].sample, t.sample);
    const double most = mu * balls.contact.laws()[0].force(t.area, t.depth), size = frozen[k].force.norm();
    EXPECT_LE(size, most * (1 + 1e-12));
    EXPECT_LE(std::abs(frozen[k].force.dot(t.normal)), 1e-14 * most);
    EXPECT_LE(frozen[k].site.difference(half).norm(), 1e-15);
    if (size > most * (1 - 1e-12)) ++sliding;
    EXPECT_LE(frozen[k].force.dot(frozen[k].site.difference(balls.v)), 0.1 * size);
  }
  EXPECT_GT(sliding, 5u);
  // friction forces are forces like any others, with an energy that is the work lost
  std::vector<Vector3d> force(balls.x.size(), Vector3d(0, 0, 0)), without = force;
  balls.contact.add_forces({balls.x}, force);
  const auto friction = balls.contact.frozen_friction_to_set();
  balls.contact.frozen_friction_to_set().clear();
  const double energy = balls.contact.energy(balls.x);
  balls.contact.add_forces({balls.x}, without);
  balls.contact.frozen_friction_to_set() = friction;
  double worst = 0.0, sum = 0.0, power = 0.0;
  std::vector<std::uint32_t> all(balls.contact.size());
  for (std::uint32_t k = 0; k < all.size(); ++k) all[k] = k;
  for (std::size_t i = 0; i < force.size(); ++i) {
    sum += (force[i] - without[i]).norm();
    power += force[i].dot(balls.v[i]);
  }
  for (const ContactFriction& f : friction) worst = std::max(worst, f.force.norm());
  EXPECT_GT(sum, worst);
  EXPECT_NEAR(balls.contact.power(all, balls.x, balls.v), power, 1e-13 * std::abs(power) + 1e-13);
  EXPECT_NEAR(balls.contact.energy(balls.x), energy, 1e-15 * energy);
  const std::vector<Vector3d> from = balls.x;
  for (std::size_t i = 0; i < half.size(); ++i) balls.x[i] += h * balls.v[i];
  const double at_end = balls.contact.energy(balls.x), change = balls.contact.energy_change({from}, balls.v, h).value;
  balls.end(h);
  EXPECT_TRUE(balls.contact.frozen_friction().empty());
  const double rubbed = balls.impulses.losses().rubbed;
  EXPECT_GT(rubbed, 0.0);
  EXPECT_NEAR(at_end - balls.contact.energy(balls.x), rubbed, 1e-13 * energy);
  EXPECT_NEAR(change, at_end - energy, 1e-13 * energy);
}

// Nothing touches yet, and a list says so, when the step begins.
TEST(BodyImpulses, HaveFrictionInTheStepThatBringsBodiesTogether) {
  const double h = 1e-3, apart = 3.0;
  Balls balls(1.0, 0.3, apart);
  EXPECT_TRUE(balls.contact.touching({balls.x}).empty());
  ASSERT_GT(balls.contact.room_at(balls.x), 0.0);
  for (std::size_t i = 0; i < balls.v.size(); ++i)
    if (balls.x[i][0] > 1.5) balls.v[i][0] -= apart / (h / 2);
  EXPECT_TRUE(balls.begin(h));
  EXPECT_GT(balls.contact.frozen_friction().size(), 10u);
}

TEST(BodyImpulses, TellNothingWhereNothingTouches) {
  Balls apart(0.5, 0.5, 3.0);
  const auto v = apart.v;
  EXPECT_FALSE(apart.begin(1e-3));
  EXPECT_FALSE(apart.end(1e-3));
  EXPECT_EQ(apart.v, v);
  Balls elastic(1.0, 0.0);
  EXPECT_FALSE(elastic.begin(1e-3));
  EXPECT_FALSE(elastic.end(1e-3));
}

TEST(BodyImpulses, CanBeTakenBack) {
  Balls once(0.5, 0.5), twice(0.5, 0.5);
  for (Balls* balls : {&once, &twice})
    for (int k = 0; k < 3; ++k) {
      if (balls == &twice) {
        const auto v = balls->v;
        balls->begin(1e-3);
        balls->impulses.take_back();
        EXPECT_TRUE(balls->contact.frozen_friction().empty());
        balls->v = v;
      }
      balls->begin(1e-3);
      balls->end(1e-3);
    }
  EXPECT_EQ(once.v, twice.v);
  Archive a, b;
  once.impulses.state(a);
  twice.impulses.state(b);
  EXPECT_EQ(a.written(), b.written());
}

TEST(BodyImpulses, AreKeptInACheckpoint) {
  Balls balls(0.5, 0.5), other(0.5, 0.5);
  balls.begin(1e-3);
  balls.end(1e-3);
  Archive written, again;
  balls.impulses.state(written);
  Archive read(written.written(), "file");
  other.impulses.state(read);
  read.require_end();
  other.impulses.state(again);
  EXPECT_EQ(again.written(), written.written());
  // and the data from which friction begins are there
  other.x = balls.x;
  other.v = balls.v;
  balls.begin(1e-3);
  other.begin(1e-3);
  ASSERT_EQ(other.contact.frozen_friction().size(), balls.contact.frozen_friction().size());
  for (std::size_t k = 0; k < balls.contact.frozen_friction().size(); ++k)
    EXPECT_EQ(other.contact.frozen_friction()[k].force, balls.contact.frozen_friction()[k].force);
}

}  // namespace
}  // namespace dartboard::body_impulses_test
