#pragma once
// The parts of `dartboard validate`, each with a file of its own.

#include "benchmarks/cli.h"

namespace dartboard {

/// Adds `conservation` to the verb `validate`; `outcome` must outlive the parse.
void add_validate_conservation(CLI::App& validate, Outcome& outcome);

}  // namespace dartboard
