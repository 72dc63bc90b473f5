#pragma once
// Ctrl-C, and other polite requests to end, that end a run in good order.

#include <signal.h>

#include <array>

#include "core/time/solve/stop_request.h"

namespace dartboard {

/// While one is alive, the first SIGINT, SIGTERM or SIGHUP is only noted, and a factorisation that takes long is given
/// up; the next ends the process at once, as it does without.
/// pre  one at a time
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  static bool asked();
  /// What a shell reports of a process that this signal ended: 128 and its number.
  static int exit_code();

 private:
  static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};

  std::array<struct sigaction, signals.size()> before_{};
  StopRequest stop_{&asked};
};

}  // namespace dartboard
