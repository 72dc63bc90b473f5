#pragma once
// Ctrl-C and other polite requests to end: they end a run in good order.

#include <signal.h>

#include <array>

#include "core/time/solve/stop_request.h"

namespace dartboard {

/// While an Interrupt is alive, the first SIGINT, SIGTERM or SIGHUP is only noted, and a long factorisation is given
/// up; the second ends the process at once, as it does without an Interrupt.
/// pre  one at a time
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  static bool asked();
  /// The exit status that a shell reports for a process ended by this signal: 128 and its number.
  static int exit_code();

 private:
  static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};

  std::array<struct sigaction, signals.size()> before_{};
  StopRequest stop_{&asked};
};

}  // namespace dartboard
