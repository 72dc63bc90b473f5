#include "benchmarks/cli/interrupt.h"

namespace dartboard {
namespace {

volatile sig_atomic_t interrupted_by = 0;

}  // namespace

Interrupt::Interrupt() {
  interrupted_by = 0;
  struct sigaction action {};
  action.sa_handler = [](int signal) {
    interrupted_by = signal;
    // the second signal, of either kind, meets the default
    struct sigaction standard {};
    standard.sa_handler = SIG_DFL;
    for (const int each : signals) sigaction(each, &standard, nullptr);
  };
  action.sa_flags = SA_RESTART;
  for (const int each : signals) sigaddset(&action.sa_mask, each);
  for (std::size_t k = 0; k < signals.size(); ++k) {
    sigaction(signals[k], nullptr, &before_[k]);
    // a script's Ctrl-C is not meant for its background jobs; nohup ignores a lost terminal
    if (before_[k].sa_handler != SIG_IGN) sigaction(signals[k], &action, nullptr);
  }
}

// The default is not restored once a signal was caught: an impatient user must be able to end the rest.
Interrupt::~Interrupt() {
  if (asked()) return;
  for (std::size_t k = 0; k < signals.size(); ++k) sigaction(signals[k], &before_[k], nullptr);
}

bool Interrupt::asked() { return interrupted_by != 0; }

int Interrupt::exit_code() { return 128 + interrupted_by; }

}  // namespace dartboard
