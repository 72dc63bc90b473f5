#pragma once
// Declarations shared by all verbs of the command line.

#include <CLI/App.hpp>
#include <cstdint>
#include <string>
#include <vector>

#include "benchmarks/harness/exit_codes.h"

namespace dartboard {

/// The outcome of the verb that ran; main returns it.
struct Outcome {
  int exit_code = exit_agrees;
  std::vector<std::string> command_line{};  // its words
};

/// Records that a requested picture could not be drawn, with the reason if it is known: exit_io if all else is well. A
/// run that disagrees or was interrupted keeps its own exit code, which says more.
inline void picture_missing(Outcome& outcome, const std::string& trouble) {
  if (!trouble.empty() && outcome.exit_code == exit_agrees) outcome.exit_code = exit_io;
}

/// A check for options: a finite number above 0. CLI11's own check prints the limits of a double in its error message
/// and accepts NaN.
CLI::Validator positive_number();

}  // namespace dartboard
