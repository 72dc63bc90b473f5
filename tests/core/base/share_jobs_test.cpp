#include "core/base/share_jobs.h"

#include <gtest/gtest.h>

#include <atomic>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/base/thread_team.h"

namespace dartboard::share_jobs_test {
namespace {

constexpr std::size_t few = 100, many = 1'000'000;

class Threads : public testing::Test {
 protected:
  ~Threads() override { use_threads(before_); }

 private:
  unsigned before_ = use_threads(2);
};
using ShareJobs = Threads;

TEST_F(ShareJobs, DoesEachJobOnce) {
  for (const std::size_t cells : {few, many}) {
    std::vector<std::atomic<int>> done(5);
    std::vector<std::function<void()>> jobs;
    for (auto& count : done) jobs.emplace_back([&count] { ++count; });
    share_jobs(cells, jobs);
    for (const auto& count : done) EXPECT_EQ(count, 1) << cells;
  }
}

// Each job waits until the other has begun.
TEST_F(ShareJobs, DoesTwoJobsAtOnceForManyCells) {
  std::atomic<int> begun{0};
  const auto wait = [&begun] {
    ++begun;
    while (begun < 2) std::this_thread::yield();
  };
  const std::function<void()> jobs[]{wait, wait};
  share_jobs(many, jobs);
  EXPECT_EQ(begun, 2);
}

TEST_F(ShareJobs, DoesThemInTheirOrderForFewCellsOrOnOneThread) {
  for (const std::size_t cells : {few, many}) {
    if (cells == many) use_threads(1);
    std::vector<int> order;
    const std::function<void()> jobs[]{[&] { order.push_back(1); }, [&] { order.push_back(2); },
                                       [&] { order.push_back(3); }};
    share_jobs(cells, jobs);
    EXPECT_EQ(order, (std::vector{1, 2, 3}));
  }
}

TEST_F(ShareJobs, ThrowsWhatAJobThrows) {
  const std::function<void()> jobs[]{[] {}, [] { throw std::runtime_error("wrong"); }};
  for (const std::size_t cells : {few, many}) EXPECT_THROW(share_jobs(cells, jobs), std::runtime_error);
}

}  // namespace
}  // namespace dartboard::share_jobs_test
