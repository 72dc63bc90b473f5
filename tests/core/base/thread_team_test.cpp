#include "core/base/thread_team.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <stdexcept>
#include <vector>

namespace dartboard::thread_team_test {
namespace {

TEST(ThreadTeam, CarriesOutEachPartOfATaskOnceBeforeItReturns) {
  ThreadTeam team(4);
  EXPECT_EQ(team.size(), 4u);
  std::vector<int> done(4, 0);
  for (int task = 1; task <= 300; ++task) {
    team.run([&](unsigned thread) { ++done[thread]; });
    ASSERT_EQ(done, std::vector<int>(4, task));
  }
}

// Each part waits until all have begun.
TEST(ThreadTeam, CarriesOutThePartsAtOnce) {
  ThreadTeam team(3);
  std::atomic<int> begun{0};
  team.run([&](unsigned) {
    ++begun;
    while (begun < 3) std::this_thread::yield();
  });
  EXPECT_EQ(begun, 3);
}

TEST(ThreadTeam, ThrowsWhatAPartThrowsAndGoesOn) {
  ThreadTeam team(2);
  for (const unsigned wrong : {0u, 1u})
    EXPECT_THROW(team.run([&](unsigned thread) {
      if (thread == wrong) throw std::runtime_error("wrong");
    }),
                 std::runtime_error);
  std::atomic<int> done{0};
  team.run([&](unsigned) { ++done; });
  EXPECT_EQ(done, 2);
}

TEST(ThreadTeam, HasAsManyThreadsAsAreInUse) {
  EXPECT_EQ(use_threads(3), 1u);
  EXPECT_EQ(threads_in_use(), 3u);
  EXPECT_EQ(thread_team().size(), 3u);
  EXPECT_EQ(use_threads(0), 3u);
  EXPECT_EQ(threads_in_use(), std::max(1u, std::thread::hardware_concurrency()));
  use_threads(1);
}

}  // namespace
}  // namespace dartboard::thread_team_test
