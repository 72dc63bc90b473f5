#include "core/base/share_jobs.h"

#include <atomic>

#include "core/base/thread_team.h"

namespace dartboard {
namespace {

constexpr std::size_t worth_sharing = 20'000;  // cells: jobs take 100 ns or more for each

}  // namespace

void share_jobs(std::size_t cells, std::span<const std::function<void()>> jobs) {
  if (threads_in_use() == 1 || cells < worth_sharing) {
    for (const auto& job : jobs) job();
    return;
  }
  std::atomic<std::size_t> next{0};
  thread_team().run([&](unsigned) {
    for (std::size_t k = next++; k < jobs.size(); k = next++) jobs[k]();
  });
}

}  // namespace dartboard
