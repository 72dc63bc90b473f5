// Contact with obstacles in time: bodies that bounce, rest and stick, by every integrator.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "core/contact/contact_impulses.h"
#include "core/contact/contacts.h"
#include "core/mechanics/mass_spring_body.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/time/integrators.h"
#include "core/time/system/accelerations.h"
#include "core/time/system/energy.h"
#include "core/views/skin.h"
#include "tests/support/bodies/element_body_for_tests.h"

namespace dartboard::contact_motion_test {
namespace {

using Eigen::Vector3d;

ContactLaw law_of(int exponent, double pressure, double depth) {
  ContactLaw law;
  law.pressure = pressure;
  law.depth = depth;
  law.exponent = exponent;
  return law;
}

/// The samples of a mesh by its own points.
std::vector<SkinSample> samples_of(const Mesh& mesh) {
  Problem problem;
  problem.mesh = mesh;
  problem.material = {.density = 1000.0, .stiffness = 4.0};
  auto body = build_body<TetMap, Held::by_every_dart>(problem);
  body.vertices.keep_rest();
  Skin skin;
  skin.rebuild(body);
  std::vector<SkinSample> samples = skin.samples();
  for (SkinSample& s : samples)
    for (std::uint32_t k = 0; k < s.count; ++k) s.nodes[k] = body.vertices.point[s.nodes[k]];
  return samples;
}

/// A body of elements among obstacles.
struct TouchingBody {
  ElementBody body;
  std::unique_ptr<std::vector<SkinSample>> samples;
  std::unique_ptr<ObstacleContact> contact;
  std::array<const ForceTerm*, 2> terms;

  TouchingBody(const Mesh& mesh, double young, std::vector<ContactLaw> laws, std::vector<Obstacle> obstacles)
      : body(mesh, Model::neo_hookean, young, 0.3),
        samples(std::make_unique<std::vector<SkinSample>>(samples_of(mesh))),
        contact(std::make_unique<ObstacleContact>(std::move(laws), std::move(obstacles), *samples)),
        terms{body.term.get(), contact.get()} {}
  SpringSystem system() const {
    SpringSystem system = body.system();
    system.terms = terms;
    return system;
  }
  void shift(const Vector3d& by) {
    for (Vector3d& x : body.x) x += by;
  }
  double energy() const { return total_energy(system(), body.x, body.v); }
  StepResult run(std::string_view integrator, double duration, int steps) {
    const auto method = make_integrator(integrator);
    StepResult result;
    for (int k = 0; k < steps && result.ok(); ++k) result = method->step(system(), body.motion(), duration / steps);
    return result;
  }
};

/// A body with restitution and friction, with impulses around each step.
struct RubbingBody : TouchingBody {
  ContactImpulses impulses;
  std::unique_ptr<Integrator> method;
  double time = 0.0;

  RubbingBody(std::string_view integrator, const Mesh& mesh, double young, const ContactLaw& law,
              const Obstacle& obstacle)
      : TouchingBody(mesh, young, {law}, {obstacle}), impulses(contact.get()), method(make_integrator(integrator)) {}
  StepResult step(double h) {
    const SpringSystem now = system();
    const Terms parts = terms_of(now);
    const auto acceleration = [&](std::span<const Vector3d> at, std::span<const Vector3d> speed,
                                  std::span<Vector3d> a) { accelerations(now, parts, at, speed, a); };
    if (impulses.begin(time, h, body.inverse_mass, body.fixed, body.x, body.v, acceleration)) method->restart();
    const StepResult result = method->step(now, body.motion(), h);
    if (impulses.end(time, h, body.inverse_mass, body.fixed, body.x, body.v)) method->restart();
    time += h;
    return result;
  }
  Vector3d speed() const {
    double all = 0.0;
    for (const double m : body.mass) all += m;
    return linear_momentum(system(), body.v) / all;
  }
  std::size_t contacts() const { return Contacts(contact.get()).state_at(body.x).contacts; }
};

/// A soft box that falls on the plane z = 0, a little askew.
TouchingBody falling_box(int exponent, double height = 0.005, double speed = 0.6) {
  TouchingBody box(kuhn_box(2, 2, 2, 0.1), 2e4, {law_of(exponent, 2e3, 0.02)}, {{HalfSpace{}}});
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(0.1, Vector3d(1, 2, 0).normalized()).toRotationMatrix();
  double lowest = 1.0;
  for (Vector3d& x : box.body.x) {
    x = turn * x;
    lowest = std::min(lowest, x[2]);
  }
  box.shift({0, 0, height - lowest});
  for (Vector3d& v : box.body.v) v = {0.1, 0, -speed};
  return box;
}

double distance(const TouchingBody& a, const TouchingBody& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.body.x.size(); ++i) sum += (a.body.x[i] - b.body.x[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(a.body.x.size()));
}

// In a contact with depth^p the derivative of order p jumps as a sample comes in and goes out: the moment of that
// within the step is random, so the errors of several heights are combined. The body touches and leaves again.
TEST(ContactMotion, HasTheOrderOfTheExponentUpToFour) {
  for (const int p : {2, 3, 4}) {
    const double duration = 0.25;
    const int coarse = p == 3 ? 192 : 64;  // where the smooth part, of order 4, is a smaller part of the error
    const int heights = p == 2 ? 20 : 8;
    double first = 0.0, last = 0.0;
    for (int k = 0; k < heights; ++k) {
      const double height = 0.004 + 0.00017 * k;
      TouchingBody truth = falling_box(p, height), once = falling_box(p, height), eightfold = falling_box(p, height);
      ASSERT_TRUE(truth.run("blanes-moan-4", duration, 4 * 8 * coarse).ok());
      ASSERT_TRUE(once.run("blanes-moan-4", duration, coarse).ok());
      ASSERT_TRUE(eightfold.run("blanes-moan-4", duration, 8 * coarse).ok());
      if (k == 0) {
        TouchingBody half = falling_box(p, height);
        ASSERT_TRUE(half.run("blanes-moan-4", duration / 3, coarse).ok());
        EXPECT_GT(Contacts(half.contact.get()).state_at(half.body.x).contacts, 5u);
        EXPECT_EQ(Contacts(truth.contact.get()).state_at(truth.body.x).contacts, 0u);
      }
      first += std::pow(distance(once, truth), 2);
      last += std::pow(distance(eightfold, truth), 2);
    }
    const double order = std::log2(first / last) / 2 / 3;
    EXPECT_NEAR(order, p, 0.3) << std::sqrt(first / heights) << ' ' << std::sqrt(last / heights);
  }
}

// With a plane, a ball and a block, in steps of half the time that the contact takes.
TEST(ContactMotion, KeepsItsEnergyWithEnergyMomentumAmongObstaclesOfEveryKind) {
  for (const int p : {2, 3, 4}) {
    TouchingBody box(kuhn_box(2, 2, 2, 0.1), 2e4, {law_of(p, 2e3, 0.02), law_of(p, 4e3, 0.02), law_of(p, 1e3, 0.02)},
                     {{HalfSpace{}}, {Ball{{0.1, 0.1, -0.05}, 0.1}}, {Block{{0.18, -0.1, -0.1}, {0.4, 0.12, 0.15}}}});
    box.shift({0, 0, 0.06});
    for (Vector3d& v : box.body.v) v = {0.3, 0.2, -0.8};
    const double before = box.energy();
    std::size_t contacts = 0;
    const auto method = make_integrator("energy-momentum");
    for (int k = 0; k < 60; ++k) {
      const StepResult result = method->step(box.system(), box.body.motion(), 0.004);
      ASSERT_TRUE(result.ok()) << p << ": " << to_string(result) << " in step " << k;
      ASSERT_NEAR(box.energy() / before, 1.0, 1e-10) << p << ", step " << k;
      contacts += Contacts(box.contact.get()).state_at(box.body.x).contacts;
    }
    EXPECT_GT(contacts, 100u);
  }
}

// Every integrator treats contact as a force like any other: all arrive at the same place, up to their errors.
TEST(ContactMotion, IsTakenByEveryIntegrator) {
  const double duration = 0.06;
  TouchingBody truth = falling_box(3);
  ASSERT_TRUE(truth.run("rk4", duration, 4096).ok());
  ASSERT_GT(Contacts(truth.contact.get()).state_at(truth.body.x).contacts, 3u);
  for (const IntegratorEntry& entry : integrators()) {
    TouchingBody coarse = falling_box(3), fine = falling_box(3);
    const int steps = 256;
    const StepResult result = coarse.run(entry.name, duration, steps);
    ASSERT_TRUE(result.ok()) << entry.name << ": " << to_string(result);
    ASSERT_TRUE(fine.run(entry.name, duration, 2 * steps).ok()) << entry.name;
    const double first = distance(coarse, truth), second = distance(fine, truth);
    const int order = std::min(scheme_of(entry.name).order, 3);
    EXPECT_LE(second, first / (order == 1 ? 1.6 : 3.0) + 1e-10) << entry.name << ' ' << first;
    EXPECT_LE(first, order == 1 ? 3e-3 : 2e-5) << entry.name;
  }
}

// A plate of 25 by 25 squares lies on a plane: its bottom carries rho g H at the depth of the law, except for its
// border, where vertices have a share of the sides too: an eighth of their area, which is H / 2 L = 1/50 of the bottom.
// The stiff plate hardly bends over that.
TEST(ContactMotion, SinksAsDeepAsItsWeightNeeds) {
  const double g = 9.81, height = 0.02;
  for (const int p : {2, 3, 4}) {
    const ContactLaw law = law_of(p, 5e3, 0.002);
    TouchingBody plate(kuhn_box(25, 25, 1, height), 1e7, {law}, {{HalfSpace{}}});
    plate.body.gravity = {0, 0, -g};
    const double expected = law.depth_at_rest(1000.0 * g * height);
    plate.shift({0, 0, -0.5 * expected});
    // backward Euler damps the oscillations
    ASSERT_TRUE(plate.run("backward-euler", 4.0, 200).ok());
    double sum = 0.0;
    std::size_t count = 0;
    for (std::size_t i = 0; i < plate.body.x.size(); ++i)
      if (plate.body.rest[i][2] == 0.0) {
        sum -= plate.body.x[i][2];
        ++count;
      }
    EXPECT_NEAR(sum / static_cast<double>(count) / expected, std::pow(1.02, -1.0 / (p - 1)), 3e-3) << p;
    const ContactState state = Contacts(plate.contact.get()).state_at(plate.body.x);
    EXPECT_NEAR(-state.force_on[0][2] / (1000.0 * g * height * 0.25), 1.0, 1e-6) << p;
  }
}

// A box of two by two by two cells falls flat. Its own vibrations take some speed, the less the stiffer it is against
// its contact.
TEST(ContactMotion, LeavesABodyItsRestitution) {
  for (const int p : {2, 3})
    for (const double e : {0.8, 0.5, 0.2})
      for (const double speed : {0.05, 0.5}) {
        ContactLaw law = law_of(p, 2e3, 0.02);
        law.restitution = e;
        RubbingBody box("verlet", kuhn_box(2, 2, 2, 0.1), 1e7, law, {HalfSpace{}});
        for (Vector3d& v : box.body.v) v[2] = -speed;
        const double before = box.energy();
        do ASSERT_TRUE(box.step(1e-4).ok());
        while (box.contacts() > 0 || box.speed()[2] < 0.0);
        EXPECT_NEAR(box.speed()[2] / speed, e, 0.01) << p << ' ' << e << ' ' << speed;
        EXPECT_NEAR((box.energy() + box.impulses.losses().damped) / before, 1.0, 1e-3);
      }
}

/// Mean position of the bottom along x.
double bottom_of(const RubbingBody& box) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < box.body.x.size(); ++i)
    if (box.body.rest[i][2] == 0.0) {
      sum += box.body.x[i][0];
      count += 1.0;
    }
  return sum / count;
}

// The box slides down a slope, or its bottom stays while the part above still oscillates undamped. Without friction it
// would move 0.12 m in the time considered.
TEST(ContactMotion, SlidesAsABodyWithTheAccelerationThatIsLeftOrHolds) {
  const double g = 9.81, angle = 0.4, seconds = 0.25;
  for (const double mu : {0.25, 0.5})
    for (const char* integrator : {"verlet", "blanes-moan-4", "backward-euler"}) {
      ContactLaw law = law_of(3, 2e4, 0.005);
      law.restitution = 0.3;
      law.friction = mu;
      RubbingBody box(integrator, kuhn_box(2, 2, 2, 0.1), 1e6, law, {HalfSpace{}});
      box.body.gravity = g * Vector3d(std::sin(angle), 0, -std::cos(angle));
      const double depth = law.depth_at_rest(1000.0 * 0.2 * g * std::cos(angle) / 1.25);
      box.shift({0, 0, -depth});
      const auto run = [&box, seconds] {
        for (int k = 0; k < 500; ++k) ASSERT_TRUE(box.step(seconds / 500).ok());
      };
      run();
      run();
      const Vector3d from = box.speed();
      const double at = bottom_of(box);
      run();
      const double left = g * (std::sin(angle) - mu * std::cos(angle));
      if (left > 0.0) {
        EXPECT_NEAR((box.speed() - from)[0] / seconds, left, 0.01 * left) << integrator;
      } else {
        EXPECT_LE(std::abs(bottom_of(box) - at), 1e-6) << integrator;
      }
    }
}

/// A vertex on a slope, carried by its contact, with every integrator.
struct VertexOnASlope {
  std::vector<Vector3d> x, v{{0, 0, 0}};
  std::vector<double> mass{0.25}, inverse_mass{4.0};
  std::vector<SkinSample> samples{{{0}, 1, 0.03}};
  Vector3d normal, down;
  ObstacleContact contact;
  ContactImpulses impulses;
  const ForceTerm* terms;
  double time = 0.0;
  static constexpr double g = 9.81;

  VertexOnASlope(double angle, const ContactLaw& law)
      : x{{0.3, -0.7, 0.4}},
        normal(Vector3d(std::sin(angle), 0, std::cos(angle)).normalized()),
        down(normal[2], 0, -normal[0]),
        contact({law}, {{HalfSpace{x[0], normal}}}, samples),
        impulses(&contact),
        terms(&contact) {
    x[0] -= law.depth_at_rest(0.25 * g * normal[2] / 0.03) * normal;
  }
  SpringSystem system() const {
    SpringSystem system;
    system.mass = mass;
    system.inverse_mass = inverse_mass;
    system.gravity = {0, 0, -g};
    system.terms = {&terms, 1};
    return system;
  }
  StepResult step(Integrator& method, double h) {
    const auto acceleration = [this](std::span<const Vector3d> at, std::span<const Vector3d> speed,
                                     std::span<Vector3d> a) {
      accelerations(system(), terms_of(system()), at, speed, a);
    };
    if (impulses.begin(time, h, inverse_mass, {}, x, v, acceleration)) method.restart();
    const StepResult result = method.step(system(), {x, v}, h);
    if (impulses.end(time, h, inverse_mass, {}, x, v)) method.restart();
    time += h;
    return result;
  }
};

// Methods do not know friction, but none lets a vertex creep: the holding force leaves no acceleration along the plane.
// On a plane along the axes that holds to the last bit; on a slope too, once rounding has settled across it.
TEST(ContactMotion, SticksByEveryIntegrator) {
  ContactLaw law = law_of(3, 2e3, 0.002);
  law.friction = 0.5;
  law.restitution = 0.5;
  for (const IntegratorEntry& entry : integrators()) {
    VertexOnASlope on(std::atan(0.5) - 1e-6, law);
    const auto method = make_integrator(entry.name);
    for (int k = 0; k < 500; ++k) ASSERT_TRUE(on.step(*method, 1e-3).ok()) << entry.name;
    const Vector3d at = on.x[0];
    for (int k = 0; k < 2000; ++k) ASSERT_TRUE(on.step(*method, 1e-3).ok()) << entry.name;
    EXPECT_LE(std::abs((on.x[0] - at).dot(on.down)), 1e-16) << entry.name << ' ' << (on.x[0] - at).norm();
    VertexOnASlope off(std::atan(0.5) + 1e-3, law);
    const Vector3d from = off.x[0];
    for (int k = 0; k < 500; ++k) ASSERT_TRUE(off.step(*method, 1e-3).ok()) << entry.name;
    EXPECT_GT((off.x[0] - from).dot(off.down), 1e-4) << entry.name;
  }
}

}  // namespace
}  // namespace dartboard::contact_motion_test
