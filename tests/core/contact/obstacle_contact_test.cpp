#include "core/contact/obstacle_contact.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

#include "core/contact/contacts.h"
#include "core/plain/error.h"
#include "tests/support/bodies/term_checks_for_tests.h"

namespace dartboard::obstacle_contact_test {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Places = std::vector<Vector3d>;

ContactLaw law_of(int exponent, double pressure = 2000.0, double depth = 0.1) {
  ContactLaw law;
  law.pressure = pressure;
  law.depth = depth;
  law.exponent = exponent;
  return law;
}

std::vector<Obstacle> obstacles() {
  return {{HalfSpace{{0.1, -0.2, -0.3}, Vector3d(1, 2, 2) / 3.0}},
          {Ball{{0.2, 0.1, -0.3}, 0.6}},
          {Block{{-0.5, -0.6, -0.7}, {0.5, 0.4, 0.9}}}};
}

/// Vertices, and samples of one, three and four of them each, about as large as the obstacles that contain them.
struct Cloud {
  Places x, w;
  std::vector<SkinSample> samples;

  explicit Cloud(std::uint64_t seed, std::uint32_t count = 60) {
    SplitMix64 random(seed);
    for (std::uint32_t k = 0; k < count; ++k) {
      x.emplace_back(random.next_signed(), random.next_signed(), random.next_signed());
      w.emplace_back(random.next_signed(), random.next_signed(), random.next_signed());
      samples.push_back({{k}, 1, 0.01 + 0.0001 * k});
    }
    // corners that are near each other, as those of faces
    for (std::uint32_t k = 0; k + 3 < count; k += 4) {
      for (std::uint32_t j = 1; j < 4; ++j) x[k + j] = x[k] + 0.1 * x[k + j];
      samples.push_back({{k, k + 1, k + 2, 0}, 3, 0.02});
      samples.push_back({{k + 3, k, k + 2, k + 1}, 4, 0.03});
    }
  }
};

std::vector<ContactLaw> laws_of(int exponent) {
  return {law_of(exponent), law_of(exponent, 3000.0), law_of(exponent, 1000.0, 0.05)};
}

Places discrete_forces(const ForceTerm& term, const Places& x, const Places& w, double t) {
  Places force(x.size(), Vector3d(0, 0, 0));
  term.add_discrete_forces({x, w, t / 2}, force);
  return force;
}

// Differences of a step d = 1e-5 at d and 2 d, so that errors of d^2 cancel. p = 2 has a jump of its stiffness at the
// surface, and the block jumps of its normals: only places that are not within 2 d of either are used.
TEST(ObstacleContact, PullsAlongTheSlopeOfItsEnergyAndStiffensAsThatDoes) {
  for (const int p : {2, 3, 4})
    for (std::size_t of = 0; of < 3; ++of) {
      const Cloud cloud(3);
      const ObstacleContact term({laws_of(p)[of]}, {obstacles()[of]}, cloud.samples);
      const Places &x = cloud.x, &w = cloud.w;
      const auto force = forces_of(term, x);
      const double size = size_of(force), d = 1e-5, power = dot(force, w);
      ASSERT_GT(size, 1.0);
      const auto slope = [&](double step) {
        return (term.energy(moved(x, w, -step)) - term.energy(moved(x, w, step))) / (2 * step);
      };
      EXPECT_NEAR((4 * slope(d) - slope(2 * d)) / 3, power, 1e-8 * size) << p << ' ' << of;
      const auto product = product_of(term, x, w);
      const auto change = [&](double step) {
        auto down = forces_of(term, moved(x, w, -step));
        const auto up = forces_of(term, moved(x, w, step));
        for (std::size_t i = 0; i < down.size(); ++i) down[i] = (down[i] - up[i]) / (2 * step);
        return down;
      };
      const auto near = change(d), far = change(2 * d);
      double worst = 0.0;
      for (std::size_t i = 0; i < w.size(); ++i)
        worst = std::max(worst, ((4 * near[i] - far[i]) / 3 - product[i]).norm());
      EXPECT_LE(worst, 1e-7 * size_of(product)) << p << ' ' << of;
      EXPECT_GE(dot(product_of(term, x, w, Compression::projected), w), dot(product, w) - 1e-12 * size);
      std::vector<std::uint32_t> all(term.size());
      for (std::uint32_t k = 0; k < all.size(); ++k) all[k] = k;
      EXPECT_NEAR(term.power(all, x, w), power, 1e-12 * size);
    }
}

// A ball gives way to a sample that slides off it: exact tangents have this negative stiffness, projected ones do not.
TEST(ObstacleContact, LeavesOutTheCurvatureOfABallWhereItIsProjected) {
  const std::vector<SkinSample> samples{{{0}, 1, 0.5}};
  const ObstacleContact term({law_of(3)}, {{Ball{}}}, samples);
  const Places x{{0, 0, 0.875}}, along{{1, 0, 0}}, out{{0, 0, 1}};
  const double force = 0.5 * 2000.0 * 1.25 * 1.25, stiffness = 2 * 0.5 * 2000.0 * 1.25 / 0.1;
  EXPECT_NEAR(product_of(term, x, along)[0][0], -force / 0.875, 1e-9);
  EXPECT_EQ(product_of(term, x, along, Compression::projected)[0][0], 0.0);
  for (const Compression compression : {Compression::exact, Compression::projected})
    EXPECT_NEAR(product_of(term, x, out, compression)[0][2], stiffness, 1e-9);
}

// Long ways, from outside to outside and past the edges of the block, in obstacles that overlap.
TEST(ObstacleContact, HasDiscreteForcesAndChangesOfEnergyThatAreExact) {
  for (const int p : {2, 3, 4})
    for (const double t : {1e-7, 0.01, 0.5, 2.0, -0.3}) {
      const Cloud cloud(5);
      const ObstacleContact term(laws_of(p), obstacles(), cloud.samples);
      const Places &x = cloud.x, &w = cloud.w;
      const Places there = moved(x, w, t), half_way = moved(x, w, t / 2);
      const double before = term.energy(x), after = term.energy(there);
      EXPECT_NEAR(dot(discrete_forces(term, x, w, t), w) * t, before - after, 1e-14 * (before + after))
          << p << ' ' << t;
      const EnergyChange found = term.energy_change({x}, w, t), rest = term.energy_change({x, w, t / 2}, w, t / 2);
      EXPECT_NEAR(found.value, after - before, 1e-14 * (before + after)) << p << ' ' << t;
      EXPECT_NEAR(rest.value, after - term.energy(half_way), 1e-14 * (before + after)) << p << ' ' << t;
      EXPECT_GE(found.sizes, std::abs(found.value));
      if (std::abs(t) < 1e-6) {  // where energies themselves cancel: to second order the work of the mean force
        const auto f = forces_of(term, half_way);
        EXPECT_NEAR(found.value, -dot(f, w) * t, 1e-10 * size_of(f) * t);
      }
    }
}

// For every single sample and both ways: the force does not depend on the direction, and for no way it is the force.
TEST(ObstacleContact, HasDiscreteForcesThatKnowNoDirectionOfTime) {
  const Cloud cloud(8);
  const ObstacleContact term(laws_of(3), obstacles(), cloud.samples);
  for (const double t : {0.02, 0.7}) {
    const auto there = discrete_forces(term, cloud.x, cloud.w, t),
               back = discrete_forces(term, moved(cloud.x, cloud.w, t), cloud.w, -t);
    for (std::size_t i = 0; i < there.size(); ++i) EXPECT_LE((there[i] - back[i]).norm(), 1e-13 * size_of(there)) << i;
  }
  const auto still = discrete_forces(term, cloud.x, cloud.w, 0.0), force = forces_of(term, cloud.x);
  for (std::size_t i = 0; i < still.size(); ++i) EXPECT_LE((still[i] - force[i]).norm(), 1e-14 * size_of(force)) << i;
}

TEST(ObstacleContact, HasForcesOnTheWayOfAStep) {
  const Cloud cloud(9);
  const ObstacleContact term(laws_of(4), obstacles(), cloud.samples);
  const auto there = forces_of(term, moved(cloud.x, cloud.w, 0.1));
  Places on_the_way(there.size(), Vector3d(0, 0, 0));
  term.add_forces({cloud.x, cloud.w, 0.1}, on_the_way);
  for (std::size_t i = 0; i < there.size(); ++i) EXPECT_LE((there[i] - on_the_way[i]).norm(), 1e-14 * size_of(there));
}

// The forces of a half-space, of any kind, have no part along its surface: a sliding vertex keeps its speed to the bit.
TEST(ObstacleContact, OfAPlaneAlongTheAxesPushesAcrossItAlone) {
  const Cloud cloud(6);
  const ObstacleContact term({law_of(3)}, {{HalfSpace{}}}, cloud.samples);
  for (const Places& force : {forces_of(term, cloud.x), discrete_forces(term, cloud.x, cloud.w, 0.3)}) {
    EXPECT_GT(size_of(force), 1.0);
    for (const Vector3d& f : force) {
      EXPECT_EQ(f[0], 0.0);
      EXPECT_EQ(f[1], 0.0);
      EXPECT_GE(f[2], 0.0);
    }
  }
}

// Energies of what a sample is inside add up, in closed form: a corner of the block, the ball and the plane.
TEST(ObstacleContact, IsTheSumOverAllObstaclesThatASampleIsInside) {
  const std::vector<SkinSample> samples{{{0}, 1, 0.5}, {{0, 1, 2, 0}, 3, 0.25}, {{0, 1, 2, 3}, 4, 0.125}};
  const Places x{{0.25, 0, -0.25}, {0.5, 0, 0.25}, {0.75, 0, -0.75}, {0.5, 0, -0.25}};
  const ContactLaw law = law_of(2, 8.0, 1.0);
  ObstacleContact term({law, law}, {{HalfSpace{}}, {Ball{{0, 0, -0.25}, 0.5}}}, samples);
  // the means are at x = 1/4 and 1/2, z = -1/4: all are 1/4 below the plane, the first 1/4 deep in the ball too
  EXPECT_EQ(term.energy(x), 0.5 * 4.0 / 16 * 2 + 0.25 * 4.0 / 16 + 0.125 * 4.0 / 16);
  EXPECT_EQ(term.energy(x, 1, 2), 0.25 * 4.0 / 16);
  const auto force = forces_of(term, x);
  const double third = 0.25 * 2.0 / 3.0, fourth = 0.125 * 2.0 / 4.0;
  EXPECT_LE((force[0] - Vector3d(0.5 * 2.0, 0, 0.5 * 2.0 + third + fourth)).norm(), 1e-15);
  EXPECT_LE((force[2] - Vector3d(0, 0, third + fourth)).norm(), 1e-15);
  EXPECT_LE((force[3] - Vector3d(0, 0, fourth)).norm(), 1e-15);
  const ContactState state = Contacts(&term).state_at(x);
  EXPECT_EQ(state.contacts, 4u);
  EXPECT_EQ(state.area, 0.5 + 0.5 + 0.25 + 0.125);
  EXPECT_EQ(state.energy, term.energy(x));
  EXPECT_EQ(state.deepest, 0.25);
  EXPECT_EQ(state.deepest_share, 0.25);
  EXPECT_EQ(state.sample, 0u);
  EXPECT_EQ(state.obstacle, 0u);
  EXPECT_EQ(state.force_on[0], Vector3d(0, 0, -(0.5 + 0.25 + 0.125) * 2.0));
  EXPECT_EQ(state.force_on[1], Vector3d(-1, 0, 0));
  const ContactState none = Contacts(&term).state_at(Places(4, Vector3d(0, 0, 3)));
  EXPECT_EQ(none.contacts, 0u);
  EXPECT_EQ(none.sample, ContactState::none);
  EXPECT_EQ(none.deepest, 0.0);
}

TEST(ObstacleContact, IsShiftedWithItsObstacles) {
  const Cloud cloud(7);
  std::vector<Obstacle> moving = obstacles();
  for (Obstacle& o : moving) o.velocity = {0.1, -0.2, 0.3};
  moving[1].until = 0.5;
  ObstacleContact term(laws_of(3), moving, cloud.samples);
  const double at_first = term.energy(cloud.x), work = term.work_of_placing(1.0, cloud.x).value;
  EXPECT_TRUE(term.place_at(1.0));
  EXPECT_FALSE(term.place_at(1.0));
  const double after = term.energy(cloud.x);
  EXPECT_GT(std::abs(work), 1e-3 * at_first);
  EXPECT_NEAR(after, at_first + work, 1e-14 * (at_first + after));
  EXPECT_EQ(term.work_of_placing(1.0, cloud.x).sizes, 0.0);
  // the ball has stopped half way
  std::vector<Obstacle> there = obstacles();
  std::get<HalfSpace>(there[0].shape).point += Vector3d(0.1, -0.2, 0.3);
  std::get<Ball>(there[1].shape).centre += Vector3d(0.05, -0.1, 0.15);
  for (Vector3d* corner : {&std::get<Block>(there[2].shape).low, &std::get<Block>(there[2].shape).high})
    *corner += Vector3d(0.1, -0.2, 0.3);
  const ObstacleContact still(laws_of(3), there, cloud.samples);
  EXPECT_NEAR(still.energy(cloud.x), after, 1e-14 * after);
  const auto a = forces_of(term, cloud.x), b = forces_of(still, cloud.x);
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_LE((a[i] - b[i]).norm(), 1e-14 * size_of(a)) << i;
  EXPECT_NEAR(Contacts(&term).state_at(cloud.x).energy, after, 1e-15 * after);
}

TEST(ObstacleContact, HasFrozenFrictionThatIsAForceLikeAnyOther) {
  const std::vector<SkinSample> samples{{{0}, 1, 0.5}, {{0, 1, 2, 0}, 3, 0.25}};
  const Places x{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, w{{1, 0, 0}, {0, 2, 0}, {0, 0, 4}};
  ObstacleContact term({law_of(3)}, {{HalfSpace{}}}, samples);  // touched by none
  const Vector3d f(0.5, 0, 0), other(0, 3, 6);
  term.frozen_friction_to_set() = {
      {.sample = 0, .obstacle = 0, .site = ContactSite(samples[0]), .force = f, .from = x[0]},
      {.sample = 1,
       .obstacle = 0,
       .site = ContactSite(samples[1]),
       .force = other,
       .from = (x[0] + x[1] + x[2]) / 3.0}};
  EXPECT_EQ(term.energy(x), 0.0);
  EXPECT_NEAR(term.energy(moved(x, w, 0.5)), -(0.25 + 0.5 * (2.0 + 8.0)), 1e-14);
  EXPECT_NEAR(term.energy(moved(x, w, 0.5), 1, 2), -5.0, 1e-14);
  EXPECT_NEAR(term.energy_change({x, w, 0.25}, w, 0.5).value, -5.25, 1e-14);
  EXPECT_GE(term.energy_change({x, w, 0.25}, w, 0.5).sizes, 5.25);
  for (const Places& force : {forces_of(term, x), discrete_forces(term, x, w, 0.5)}) {
    EXPECT_LE((force[0] - Vector3d(0.5, 1, 2)).norm(), 1e-15);
    EXPECT_LE((force[1] - Vector3d(0, 1, 2)).norm(), 1e-15);
  }
  const std::array<std::uint32_t, 2> all{0, 1};
  EXPECT_NEAR(term.power(all, x, w), 0.5 + 10.0, 1e-14);
  EXPECT_NEAR(term.power(std::span(all).subspan(1), x, w), 10.0, 1e-14);
  std::vector<double> size(3, 0.0);
  term.add_force_sizes({x}, size);
  EXPECT_NEAR(size[0], 0.5 + std::sqrt(45.0) / 3, 1e-15 * 8);
}

// Errors of forces caused by errors of coordinates: shifted with its obstacles far away, a cloud has forces that differ
// by some roundings of their sizes.
TEST(ObstacleContact, KnowsHowWellItsForcesAreKnown) {
  const Cloud cloud(11);
  const Vector3d far(1e6, -2e6, 3e6);
  Places x = cloud.x, away = x;
  for (std::size_t i = 0; i < x.size(); ++i) {
    away[i] += far;
    x[i] = away[i] - far;  // the places that are representable there
  }
  std::vector<Obstacle> shifted{{HalfSpace{far, {0, 0, 1}}}};
  const ObstacleContact here({law_of(3)}, {{HalfSpace{}}}, cloud.samples), there({law_of(3)}, shifted, cloud.samples);
  const auto a = forces_of(here, x), b = forces_of(there, away);
  std::vector<double> size(x.size(), 0.0);
  there.add_force_sizes({away}, size);
  double worst = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    EXPECT_LE((a[i] - b[i]).norm(), 2.3e-16 * size[i]) << i;
    EXPECT_GE(size[i], b[i].norm());
    worst = std::max(worst, (a[i] - b[i]).norm());
  }
  EXPECT_GT(worst, 0.0);
}

// Rows of M^-1 K for samples all at that depth, where K is as large as it can be: by products with the sign of one
// column after the other, in closed form for two vertices and their two samples.
TEST(ObstacleContact, BoundsTheFrequenciesThatItAdds) {
  const std::vector<SkinSample> samples{{{0}, 1, 0.5}, {{0, 1, 2, 0}, 3, 0.75}};
  const ObstacleContact term({law_of(3, 100.0, 0.1), law_of(2, 10.0, 0.5)}, {{HalfSpace{}}, {Ball{}}}, samples);
  const std::vector<double> inverse_mass{2.0, 4.0, 0.0};
  // k = 2 a P0 / delta at the whole depth of the stiffer law: 1000 and 1500
  EXPECT_NEAR(term.frequency_squared(inverse_mass, 1.0), 2.0 * (1000.0 + 1500.0 / 3), 1e-11);
  EXPECT_NEAR(term.frequency_squared(inverse_mass, 0.5), (1000.0 + 1500.0 / 3), 1e-11);
  // of a state with every sample that deep, no w' K w is above it times w' M w
  const Places x{{0, 0, -0.1}, {0, 1, -0.1}, {1, 0, -0.1}};
  SplitMix64 random(3);
  for (int k = 0; k < 20; ++k) {
    Places w(3, Vector3d(0, 0, 0));
    for (std::size_t i = 0; i < 2; ++i) w[i][2] = random.next_signed();
    const double stiff = dot(product_of(ObstacleContact({law_of(3, 100.0, 0.1)}, {{HalfSpace{}}}, samples), x, w), w);
    EXPECT_LE(stiff, term.frequency_squared(inverse_mass, 1.0) * (w[0].squaredNorm() / 2.0 + w[1].squaredNorm() / 4.0));
  }
}

TEST(ObstacleContact, HasAConstantTangentOfTheDepthOfItsLaw) {
  const std::vector<SkinSample> samples{{{0}, 1, 0.5}, {{2, 1, 0, 0}, 3, 0.25}};
  const ObstacleContact term({law_of(3, 100.0, 0.1), law_of(2, 10.0, 0.1)}, {{HalfSpace{}}, {Ball{}}}, samples);
  std::vector<std::pair<std::size_t, double>> found;
  term.for_each_constant_tangent([&](ForceTerm::Nodes n, std::span<const Matrix3d> blocks) {
    for (const Matrix3d& block : blocks) EXPECT_LE((block - block(0, 0) * Matrix3d::Identity()).norm(), 0.0);
    for (const Matrix3d& block : blocks) EXPECT_EQ(block, blocks[0]);
    found.emplace_back(blocks.size(), blocks[0](0, 0) * static_cast<double>(n.size() * n.size()));
  });
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].first, 1u);
  EXPECT_NEAR(found[0].second, 2 * 0.5 * 1000.0, 1e-10);
  EXPECT_EQ(found[1].first, 6u);
  EXPECT_NEAR(found[1].second, 2 * 0.25 * 1000.0, 1e-10);
}

// Samples that nothing touches stay in the pattern, with nothing in it.
TEST(ObstacleContact, HasThePiecesOfItsSamplesWhetherTheyTouchOrNot) {
  Cloud cloud(12);
  const ObstacleContact term(laws_of(3), obstacles(), cloud.samples);
  ASSERT_EQ(term.size(), cloud.samples.size());
  std::size_t visited = 0, stiff = 0;
  term.for_each_tangent({cloud.x}, Compression::exact, [&](ForceTerm::Nodes n, std::span<const Matrix3d> blocks) {
    EXPECT_TRUE(std::ranges::equal(n, term.nodes(visited)));
    if (!blocks[0].isZero(0.0)) ++stiff;
    ++visited;
  });
  EXPECT_EQ(visited, term.size());
  EXPECT_GT(stiff, 10u);
  EXPECT_LT(stiff, visited);
  EXPECT_TRUE(term.virial(cloud.x, 0).tensor.isZero(0.0));
}

TEST(ObstacleContact, NeedsALawForEachObstacle) {
  const std::vector<SkinSample> none;
  EXPECT_THROW(ObstacleContact({law_of(3)}, {}, none), InputError);
  EXPECT_THROW(ObstacleContact({ContactLaw{}}, {{Ball{}}}, none), InputError);
  EXPECT_THROW(ObstacleContact({law_of(3)}, {{Ball{{0, 0, 0}, -1.0}}}, none), InputError);
  ContactLaw rough = law_of(3), soft = law_of(3);
  rough.friction = 0.5;
  soft.restitution = 0.5;
  const ObstacleContact one({rough}, {{Ball{}}}, none), other({soft}, {{Ball{}}}, none);
  EXPECT_TRUE(one.has_friction() && !one.has_damping());
  EXPECT_TRUE(other.has_damping() && !other.has_friction());
}

// Clouds around each obstacle, and on their way past it.
TEST(ObstacleContact, IsClearOnlyWhereNoSampleIsInside) {
  SplitMix64 random(5);
  for (std::size_t of = 0; of < 3; ++of) {
    std::size_t clear = 0, touching = 0;
    for (std::uint64_t k = 0; k < 300; ++k) {
      Cloud cloud(k, 12);
      const Vector3d aside(2.5 * random.next_signed(), 2.5 * random.next_signed(), 2.5 * random.next_signed());
      for (Vector3d& x : cloud.x) x = 0.3 * x + aside;
      const double t = k % 2 == 0 ? 0.0 : random.next_signed();
      ObstacleContact term({laws_of(3)[of]}, {obstacles()[of]}, cloud.samples);
      const bool found_clear = t == 0.0 ? term.is_clear(cloud.x) : term.is_clear(cloud.x, cloud.w, t);
      const std::size_t inside = Contacts(&term).state_at(moved(cloud.x, cloud.w, t)).contacts;
      EXPECT_FALSE(found_clear && inside > 0) << of << ' ' << k;
      clear += found_clear ? 1 : 0;
      touching += inside > 0 ? 1 : 0;
    }
    EXPECT_GT(clear, 60u) << of;
    EXPECT_GT(touching, 5u) << of;
  }
}

TEST(ObstacleContact, IsClearOfAnObstacleAtItsPresentPlace) {
  const Cloud cloud(1, 12);
  Obstacle ball{Ball{{0, 0, 9}, 1.0}};
  ball.velocity = {0, 0, -1};
  ObstacleContact term({law_of(3)}, {ball}, cloud.samples);
  EXPECT_TRUE(term.is_clear(cloud.x));
  term.place_at(9.0);
  EXPECT_FALSE(term.is_clear(cloud.x));
  EXPECT_GT(Contacts(&term).state_at(cloud.x).contacts, 0u);
}

}  // namespace
}  // namespace dartboard::obstacle_contact_test
