#pragma once
// What the two programs have in common: how a command line is parsed, answered and refused.

#include <CLI/App.hpp>
#include <functional>

#include "benchmarks/cli/cli.h"

namespace dartboard {

/// Parse a command line, and run the verb that it names. The App has a subcommand for each row of `verb_names`, which
/// `add_verbs` gives its options and what it does. Errors go to standard error.
///
/// returns  the exit status
int run_program(int argc, char** argv, const std::function<void(CLI::App&, Outcome&)>& add_verbs);

}  // namespace dartboard
