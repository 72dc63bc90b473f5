#pragma once
// Work that takes seconds and cannot be interrupted, given up when the user asks for a stop.

#include <exception>
#include <functional>

namespace dartboard {

/// A stop was asked for, and the work was given up.
struct Stopped : std::exception {
  const char* what() const noexcept override { return "stopped on request"; }
};

/// While one is alive, work of at least so many seconds is given up as soon as `asked` says so.
/// pre  one at a time; `asked` may be called by any thread
class StopRequest {
 public:
  using Asked = bool (*)();
  explicit StopRequest(Asked asked, double least_seconds = 0.2);
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;
};

/// Is there a StopRequest, and is work of so many seconds, as predicted, worth a thread of its own?
bool may_be_stopped(double seconds);

/// throws  Stopped where a stop has been asked for
void throw_if_stopped();

/// Do the work in a thread of its own and wait for its end, or for the request to stop. Given up, the work goes on
/// until the process ends: it must own, or share, all that it touches, and the process must leave by std::_Exit, which
/// waits for no thread.
///
/// pre     there is a StopRequest
/// throws  Stopped within a twentieth of a second of the request; whatever `work` throws
void do_unless_stopped(std::function<void()> work);

/// Has some work been given up that has not ended?
bool work_left_behind();

}  // namespace dartboard
