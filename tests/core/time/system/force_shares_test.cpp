#include "core/time/system/force_shares.h"

#include <gtest/gtest.h>

#include <bit>
#include <random>
#include <vector>

#include "core/base/thread_team.h"
#include "core/time/system/accelerations.h"

namespace dartboard::force_shares_test {
namespace {

using Eigen::Vector3d;

/// Springs between vertices, most of which are near each other in number, with all that may act on these.
struct Net {
  std::vector<SpringEnds> ends;
  std::vector<Spring> damped;
  std::vector<UndampedSpring> undamped;
  std::vector<Vector3d> x, v, pull;
  std::vector<double> mass, inverse_mass, viscosity;
  std::vector<std::uint8_t> fixed, held;

  Net() {
    constexpr std::uint32_t vertices = 2000, springs = 60001;
    std::mt19937 random(7);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    const auto vector = [&] { return Vector3d(number(random), number(random), number(random)); };
    for (std::uint32_t i = 0; i < vertices; ++i) {
      x.push_back(vector());
      v.push_back(vector());
      pull.push_back(vector());
      mass.push_back(2.0 + number(random));
      inverse_mass.push_back(1.0 / mass.back());
      viscosity.push_back(0.5 * mass.back());
      fixed.push_back(i % 17 == 0);
      held.push_back(i % 13 == 1 ? 2 : 0);
    }
    x[8] = x[9];  // a spring without a length
    for (std::uint32_t s = 0; s < springs; ++s) {
      const auto a = static_cast<std::uint32_t>(std::uint64_t{s} * vertices / springs);
      const auto reach = s % 50 == 0 ? vertices - 1 : 20u;
      ends.push_back({a, (a + 1 + static_cast<std::uint32_t>(random() % reach)) % vertices});
      damped.push_back({1.0 + 0.5 * number(random), 10.0 + number(random), 0.2 + 0.1 * number(random)});
      undamped.push_back({damped.back().rest_length, damped.back().stiffness});
    }
  }
  SpringSystem system(SpringSpan springs) const {
    SpringSystem made{.ends = ends,
                      .springs = springs,
                      .mass = mass,
                      .inverse_mass = inverse_mass,
                      .viscosity = viscosity,
                      .fixed = fixed,
                      .gravity = {0, 0, -9.81},
                      .pull = pull};
    made.held_axes = held;
    return made;
  }
};

std::vector<std::uint64_t> bits_of_accelerations(const Net& net, SpringSpan springs, unsigned threads) {
  const unsigned before = use_threads(threads);
  const SpringSystem system = net.system(springs);
  const Terms terms = terms_of(system);
  EXPECT_EQ(terms.is_shared(), threads > 1);
  std::vector<Vector3d> a(net.x.size());
  accelerations(system, terms, net.x, net.v, a);
  use_threads(before);
  std::vector<std::uint64_t> bits;
  for (const Vector3d& row : a)
    for (const double component : row) bits.push_back(std::bit_cast<std::uint64_t>(component));
  return bits;
}

TEST(ForceShares, GiveTheBitsOfOneThread) {
  const Net net;
  for (const SpringSpan springs : {SpringSpan(net.damped), SpringSpan(net.undamped)}) {
    const auto alone = bits_of_accelerations(net, springs, 1);
    for (const unsigned threads : {2u, 3u, 4u, 7u})
      EXPECT_TRUE(bits_of_accelerations(net, springs, threads) == alone) << threads << " threads";
  }
}

TEST(ForceShares, AreAllVerticesOnceAndAboutTheSameWork) {
  const Net net;
  const unsigned before = use_threads(4);
  const std::vector<ForceShare> shares = share_forces(net.system(net.damped));
  use_threads(before);
  ASSERT_EQ(shares.size(), 4u);
  std::uint32_t next = 0;
  for (const ForceShare& share : shares) {
    EXPECT_EQ(share.own.first, next);
    next = share.own.last;
    std::size_t springs = 0;
    for (const PieceRun run : share.springs) springs += run.last - run.first;
    EXPECT_NEAR(static_cast<double>(springs), 0.25 * 60001, 0.05 * 60001);
  }
  EXPECT_EQ(next, net.x.size());
  EXPECT_GT(bytes_of_shares(shares), 0u);
}

TEST(ForceShares, AreNoneOfASmallSystemOrOfOneThread) {
  Net net;
  EXPECT_TRUE(share_forces(net.system(net.damped)).empty());
  net.ends.resize(5000);
  net.damped.resize(5000);
  const unsigned before = use_threads(4);
  EXPECT_TRUE(share_forces(net.system(net.damped)).empty());
  use_threads(before);
}

}  // namespace
}  // namespace dartboard::force_shares_test
