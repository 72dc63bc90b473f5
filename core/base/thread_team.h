#pragma once
// Threads that carry out parts of one task together.

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace dartboard {

/// A caller and its helpers, which wait between tasks: first awake for some microseconds, then asleep.
class ThreadTeam {
 public:
  explicit ThreadTeam(unsigned size);
  ~ThreadTeam();
  ThreadTeam(const ThreadTeam&) = delete;
  ThreadTeam& operator=(const ThreadTeam&) = delete;

  unsigned size() const { return static_cast<unsigned>(helpers_.size()) + 1; }
  /// Calls task(0), ..., task(size - 1) at once, task(0) here, and returns when all have returned.
  ///
  /// pre     one caller at a time
  /// throws  what a task throws, the first of several
  void run(const std::function<void(unsigned)>& task);

 private:
  void help(unsigned number);
  void carry_out(unsigned number);

  std::vector<std::thread> helpers_;
  const std::function<void(unsigned)>* task_ = nullptr;
  std::atomic<std::uint32_t> started_{0}, working_{0};  // tasks so far; helpers that have not returned
  std::atomic<bool> ends_{false};
  std::mutex failing_;
  std::exception_ptr failure_;
};

/// The number of threads that integrators and the making of bodies may use from now on for large systems, 1 at the
/// start: no bit depends on it. 0 means one for each processor. Not while another thread steps.
///
/// returns  the number before
unsigned use_threads(unsigned count);
unsigned threads_in_use();
/// The team of that many threads.
/// pre  threads_in_use() > 1
ThreadTeam& thread_team();

}  // namespace dartboard
