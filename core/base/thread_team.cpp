#include "core/base/thread_team.h"

#include <algorithm>
#include <memory>
#include <utility>

namespace dartboard {
namespace {

constexpr int looks = 4000;  // before a thread that waits goes to sleep, some microseconds each hundred

/// Returns when the number is not `old` any more.
void wait_for_change(const std::atomic<std::uint32_t>& number, std::uint32_t old) {
  for (int k = 0; k < looks; ++k) {
    if (number.load(std::memory_order_acquire) != old) return;
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }
  number.wait(old, std::memory_order_acquire);
}

unsigned in_use = 1;
std::unique_ptr<ThreadTeam> team;

}  // namespace

ThreadTeam::ThreadTeam(unsigned size) {
  for (unsigned number = 1; number < size; ++number) helpers_.emplace_back([this, number] { help(number); });
}

ThreadTeam::~ThreadTeam() {
  ends_ = true;
  started_.fetch_add(1, std::memory_order_release);
  started_.notify_all();
  for (std::thread& helper : helpers_) helper.join();
}

void ThreadTeam::run(const std::function<void(unsigned)>& task) {
  task_ = &task;
  working_.store(size() - 1, std::memory_order_relaxed);
  started_.fetch_add(1, std::memory_order_release);
  started_.notify_all();
  carry_out(0);
  for (std::uint32_t left = working_.load(std::memory_order_acquire); left != 0;
       left = working_.load(std::memory_order_acquire))
    wait_for_change(working_, left);
  if (failure_) std::rethrow_exception(std::exchange(failure_, nullptr));
}

void ThreadTeam::help(unsigned number) {
  for (std::uint32_t done = 0;; ++done) {
    wait_for_change(started_, done);
    if (ends_) return;
    carry_out(number);
    if (working_.fetch_sub(1, std::memory_order_acq_rel) == 1) working_.notify_one();
  }
}

void ThreadTeam::carry_out(unsigned number) {
  try {
    (*task_)(number);
  } catch (...) {
    const std::lock_guard lock(failing_);
    if (!failure_) failure_ = std::current_exception();
  }
}

unsigned use_threads(unsigned count) {
  if (count == 0) count = std::max(1u, std::thread::hardware_concurrency());
  const unsigned before = std::exchange(in_use, count);
  if (count != before) team.reset();
  return before;
}

unsigned threads_in_use() { return in_use; }

ThreadTeam& thread_team() {
  if (!team) team = std::make_unique<ThreadTeam>(in_use);
  return *team;
}

}  // namespace dartboard
