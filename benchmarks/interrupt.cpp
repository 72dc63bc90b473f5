#include "benchmarks/interrupt.h"

namespace dartboard {
namespace {

volatile sig_atomic_t interrupted = 0;

}  // namespace

Interrupt::Interrupt() {
  interrupted = 0;
  sigaction(SIGINT, nullptr, &before_);
  if (before_.sa_handler == SIG_IGN) return;  // in the background of a script, where Ctrl-C means another
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = 1; };
  action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART);  // the second one meets the default
  sigemptyset(&action.sa_mask);
  sigaction(SIGINT, &action, nullptr);
}

// Not given back once it has been used: an impatient user must be able to end what follows.
Interrupt::~Interrupt() {
  if (!asked()) sigaction(SIGINT, &before_, nullptr);
}

bool Interrupt::asked() { return interrupted != 0; }

}  // namespace dartboard
