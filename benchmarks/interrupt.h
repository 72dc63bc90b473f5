#pragma once
// Ctrl-C that ends a run in good order.

#include <signal.h>

namespace dartboard {

/// While one is alive, the first SIGINT is only noted; the next ends the process at once, as it does without.
/// pre  one at a time
class Interrupt {
 public:
  static constexpr int exit_code = 128 + SIGINT;  // what a shell reports of a process that SIGINT ended

  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  static bool asked();

 private:
  struct sigaction before_ {};
};

}  // namespace dartboard
