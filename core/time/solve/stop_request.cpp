#include "core/time/solve/stop_request.h"

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <limits>
#include <memory>
#include <mutex>
#include <system_error>
#include <thread>

namespace dartboard {
namespace {

std::atomic<StopRequest::Asked> asked_now = nullptr;
std::atomic<double> least_seconds_now = std::numeric_limits<double>::infinity();
std::atomic<int> left_behind = 0;

/// The data shared by the thread and its waiting caller.
struct Job {
  std::function<void()> work;
  std::mutex mutex;
  std::condition_variable changed;
  bool ended = false, given_up = false;
  std::exception_ptr error;
};

void carry_out(Job& job) {
  std::exception_ptr error;
  try {
    job.work();
  } catch (...) {
    error = std::current_exception();
  }
  const std::lock_guard lock(job.mutex);
  job.ended = true;
  job.error = error;
  if (job.given_up) --left_behind;
  job.changed.notify_one();
}

}  // namespace

StopRequest::StopRequest(Asked asked, double least_seconds) {
  least_seconds_now = least_seconds;
  asked_now = asked;
}

StopRequest::~StopRequest() { asked_now = nullptr; }

bool may_be_stopped(double seconds) { return asked_now.load() != nullptr && seconds >= least_seconds_now.load(); }

void throw_if_stopped() {
  if (const StopRequest::Asked asked = asked_now; asked != nullptr && asked()) throw Stopped();
}

void do_unless_stopped(std::function<void()> work) {
  constexpr std::chrono::milliseconds between_looks(20);
  throw_if_stopped();
  const auto job = std::make_shared<Job>();
  job->work = std::move(work);
  try {
    std::thread([job] { carry_out(*job); }).detach();
  } catch (const std::system_error&) {  // no thread is available: the work cannot be stopped then
    job->work();
    return;
  }
  std::unique_lock lock(job->mutex);
  while (!job->ended) {
    job->changed.wait_for(lock, between_looks);
    if (job->ended) break;
    const StopRequest::Asked asked = asked_now;
    if (asked == nullptr || !asked()) continue;
    job->given_up = true;
    ++left_behind;
    throw Stopped();
  }
  if (job->error) std::rethrow_exception(job->error);
}

bool work_left_behind() { return left_behind.load() > 0; }

}  // namespace dartboard
