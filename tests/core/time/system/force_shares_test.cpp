#include "core/time/system/force_shares.h"

#include <gtest/gtest.h>

#include <bit>
#include <vector>

#include "core/base/thread_team.h"
#include "core/time/system/accelerations.h"
#include "tests/support/bodies/net_of_springs.h"

namespace dartboard::force_shares_test {
namespace {

using Eigen::Vector3d;

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
