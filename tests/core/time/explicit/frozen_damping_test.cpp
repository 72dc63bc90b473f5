#include "core/time/explicit/frozen_damping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

#include "core/base/lanes.h"
#include "core/time/system/energy.h"
#include "tests/support/bodies/net_of_springs.h"
#include "tests/support/meshes_for_tests.h"
#include "tests/support/spring_arrays_for_tests.h"

namespace dartboard::frozen_damping_test {
namespace {

using Eigen::Vector3d;
constexpr double u = std::numeric_limits<double>::epsilon() / 2;  // unit roundoff

SpringArrays pair(double c) {
  SpringArrays arrays;
  arrays.add_vertex(1.0, {0, 0, 0}, {1, 2, 0});
  arrays.add_vertex(3.0, {2, 0, 0}, {-1, 0, 5});
  arrays.add_spring(0, 1, 1.0, 2.0, c);
  return arrays;
}

TEST(FrozenDamping, LetsTheRelativeSpeedAlongOneSpringDecayExactly) {
  SpringArrays arrays = pair(1.5);  // mu = 3/4: rate 2
  FrozenDamping damping;
  const Terms terms{.damping = true};
  damping.freeze(arrays.system(), terms, arrays.x);
  damping.decay_symmetric(arrays.system(), terms, 0.5, arrays.v);
  EXPECT_NEAR(arrays.v[1].x() - arrays.v[0].x(), -2.0 * std::exp(-1.0), 100 * u);
  EXPECT_NEAR(arrays.v[0].x() + 3.0 * arrays.v[1].x(), -2.0, 20 * u);
  EXPECT_EQ(arrays.v[0].y(), 2.0);  // no force acts across the spring
  EXPECT_EQ(arrays.v[1].z(), 5.0);
}

TEST(FrozenDamping, LetsVelocitiesDecayByViscosityExactly) {
  SpringArrays arrays = pair(0.0);
  arrays.viscosity = {0.5, 1.5};  // rate 1/2 for both
  FrozenDamping damping;
  const Terms terms{.viscosity = true};
  damping.freeze(arrays.system(), terms, arrays.x);
  damping.decay_symmetric(arrays.system(), terms, 4.0, arrays.v);
  EXPECT_NEAR(arrays.v[0].y(), 2.0 * std::exp(-2.0), 100 * u);
  EXPECT_NEAR(arrays.v[1].z(), 5.0 * std::exp(-2.0), 100 * u);
}

SpringArrays moving_body(double damping) {
  Problem problem;
  problem.mesh = kuhn_grid(2, 2, 2, 0.5, 0.1, 2);
  problem.material.damping = damping;
  problem.material.viscosity = 0.0;
  SpringArrays arrays = arrays_of(build_body<TetMap, Held::by_one_dart>(problem));
  disturb(arrays);
  return arrays;
}

TEST(FrozenDamping, TakesEnergyAndNoMomentumHoweverLongTheStep) {
  for (const double h : {1e-3, 1.0, 1e3, 1e9}) {
    SpringArrays arrays = moving_body(2.0);
    const auto system = arrays.system();
    const Terms terms = terms_of(system);
    const Vector3d p = linear_momentum(system, arrays.v), L = angular_momentum(system, arrays.x, arrays.v);
    const double energy = kinetic_energy(system, arrays.v);
    FrozenDamping damping;
    damping.freeze(system, terms, arrays.x);
    damping.decay_symmetric(system, terms, h, arrays.v);
    EXPECT_LT(kinetic_energy(system, arrays.v), energy) << h;
    // 27 vertices of up to 125 kg at 1 m/s and 2 m; each of the 2 * 98 impulses is rounded twice at that size at most
    const double roundings = 2 * 98 * 8 * u * 125;
    EXPECT_LT((linear_momentum(system, arrays.v) - p).norm(), roundings) << h;
    EXPECT_LT((angular_momentum(system, arrays.x, arrays.v) - L).norm(), 2 * roundings) << h;
  }
}

// The sweep is symmetric: a step of -h undoes one of h.
TEST(FrozenDamping, IsUndoneByTheOppositeStep) {
  SpringArrays arrays = moving_body(2.0);
  const auto start = arrays.v;
  const auto system = arrays.system();
  const Terms terms = terms_of(system);
  FrozenDamping damping;
  damping.freeze(system, terms, arrays.x);
  damping.decay_symmetric(system, terms, 0.25, arrays.v);
  EXPECT_GT((arrays.v[0] - start[0]).norm(), 1e-3);
  damping.decay_symmetric(system, terms, -0.25, arrays.v);
  // 4 * 98 impulses of 8 roundings at size 1; growth by the return, exp of at most 0.25 * 2 * 98 * 2 / 20, is below 1e2
  for (std::size_t i = 0; i < start.size(); ++i) EXPECT_LT((arrays.v[i] - start[i]).norm(), 4 * 98 * 8 * u * 1e2);
}

TEST(FrozenDamping, MultipliesWithTheDampingThatTheAccelerationsContain) {
  SpringArrays arrays = moving_body(2.0);
  for (std::size_t i = 0; i < arrays.viscosity.size(); ++i) arrays.viscosity[i] = 0.3 * arrays.mass[i];
  arrays.fixed[4] = 1;
  const auto system = arrays.system();
  const Terms terms = terms_of(system);
  std::vector<Vector3d> lossy(arrays.x.size()), lossless(arrays.x.size()), product(arrays.x.size());
  accelerations(system, terms, arrays.x, arrays.v, lossy);
  accelerations(system, {.fixed = true}, arrays.x, arrays.v, lossless);
  FrozenDamping damping;
  damping.freeze(system, terms, arrays.x);
  damping.apply(system, terms, arrays.v, product);
  // sums of up to 14 forces of some 10 roundings, all accelerations below 50
  for (std::size_t i = 0; i < product.size(); ++i)
    EXPECT_LT((lossless[i] - lossy[i] - product[i]).norm(), 14 * 10 * u * 50) << i;
  EXPECT_EQ(product[4], Vector3d(0, 0, 0));
  EXPECT_GT(product[5].norm(), 1e-3);
}

// A vertex on a rail along x, with a damper at 45 degrees to it: c / 2 acts along the rail, and its flow is exact.
TEST(FrozenDamping, LetsAVertexOnARailDecayByWhatActsAlongIt) {
  SpringArrays arrays;
  arrays.add_vertex(1.0, {0, 0, 0}, {0, 0, 0}, true);
  arrays.add_vertex(3.0, {2, 2, 0}, {1, 0, 0});
  arrays.add_spring(0, 1, 1.0, 2.0, 1.5);
  arrays.held_axes = {0, 6};
  FrozenDamping damping;
  const Terms terms{.damping = true, .fixed = true};
  damping.freeze(arrays.system(), terms, arrays.x);
  std::vector<Vector3d> rate(2);
  damping.apply(arrays.system(), terms, arrays.v, rate);
  EXPECT_NEAR(rate[1].x(), 0.25, 4 * u);
  EXPECT_EQ(rate[1].y(), 0.0);
  damping.decay_symmetric(arrays.system(), terms, 8.0, arrays.v);
  EXPECT_NEAR(arrays.v[1].x(), std::exp(-2.0), 8 * u);
  EXPECT_EQ(arrays.v[1].y(), 0.0);
}

TEST(FrozenDamping, LeavesFixedVerticesAloneAndSpringsWithoutLength) {
  SpringArrays arrays = pair(1.5);
  arrays.fixed[0] = 1;
  FrozenDamping damping;
  const Terms terms{.damping = true, .fixed = true};
  damping.freeze(arrays.system(), terms, arrays.x);
  damping.decay_symmetric(arrays.system(), terms, 1e6, arrays.v);
  EXPECT_EQ(arrays.v[0], Vector3d(1, 2, 0));
  EXPECT_NEAR(arrays.v[1].x(), 1.0, 8 * u);  // follows

  arrays = pair(1.5);
  arrays.x[1] = arrays.x[0];
  const auto before = arrays.v;
  damping.forget();
  damping.freeze(arrays.system(), {.damping = true}, arrays.x);
  damping.decay_symmetric(arrays.system(), {.damping = true}, 1.0, arrays.v);
  EXPECT_EQ(arrays.v, before);
}

/// The velocities after both kinds of decay; `padded` is whether the processor does it in rows of four.
std::vector<Vector3d> decayed(const SpringSystem& system, std::vector<Vector3d> v, std::span<const Vector3d> x,
                              bool padded) {
  const bool before = use_lanes(padded);
  FrozenDamping damping;
  const Terms terms = terms_of(system);
  damping.freeze(system, terms, x);
  damping.decay_symmetric(system, terms, 0.25, v);
  damping.decay_once(system, terms, 0.5, v);
  use_lanes(before);
  return v;
}

// Sweeps take springs from eight distant places: counts below, at and above multiples of that, with vertices that are
// fixed, springs without length, one whose ends are one vertex, and a speed that is not finite.
TEST(FrozenDamping, LeavesTheSameBitsInPaddedRows) {
  for (const std::uint32_t springs : {1u, 2u, 7u, 8u, 9u, 63u, 64u, 65u, 3001u})
    for (const double speed : {1.0, std::numeric_limits<double>::infinity()}) {
      Net net(100, springs);
      net.ends[springs / 2] = {5, 5};
      net.v[5] = {-0.0, 0.0, -0.0};
      net.v[7].y() = speed;
      net.held.clear();
      const SpringSystem system = net.system(net.damped);
      const auto padded = decayed(system, net.v, net.x, true), plain = decayed(system, net.v, net.x, false);
      EXPECT_EQ(std::memcmp(padded.data(), plain.data(), sizeof(Vector3d) * plain.size()), 0)
          << springs << ' ' << speed;
      EXPECT_NE(std::memcmp(padded.data(), net.v.data(), sizeof(Vector3d) * plain.size()), 0);
    }
}

}  // namespace
}  // namespace dartboard::frozen_damping_test
