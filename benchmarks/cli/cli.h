#pragma once
// What the verbs of the command line share.

#include <CLI/App.hpp>
#include <cstdint>
#include <string>

#include "benchmarks/harness/exit_codes.h"

namespace dartboard {

/// The outcome of the verb that ran; main returns it.
struct Outcome {
  int exit_code = exit_agrees;
  std::string command_line;
};

/// A picture that was asked for and could not be drawn, for the reason given, if there is one: exit_io where all else
/// is well. What disagrees, or was interrupted, keeps its own exit code, which says more.
inline void picture_missing(Outcome& outcome, const std::string& trouble) {
  if (!trouble.empty() && outcome.exit_code == exit_agrees) outcome.exit_code = exit_io;
}

/// A check for options: a finite number above 0. CLI11's own prints the limits of a double to who gets it wrong, and
/// lets NaN pass.
CLI::Validator positive_number();

}  // namespace dartboard
