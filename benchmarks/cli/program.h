#pragma once
// What the two programs have in common: how a command line is parsed, answered and refused.

#include <CLI/App.hpp>
#include <functional>

#include "benchmarks/cli/cli.h"

namespace dartboard {

/// Parse a command line by the verbs that are added to the App, and run the verb it names. Errors go to standard error.
///
/// returns  the exit status
int run_program(int argc, char** argv, const std::function<void(CLI::App&, Outcome&)>& add_verbs);

}  // namespace dartboard
