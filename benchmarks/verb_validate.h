#pragma once
// The parts of `dartboard validate`, each with a file of its own.

#include "benchmarks/cli.h"

namespace dartboard {

// Each adds a verb to `validate`; `outcome` must outlive the parse.
void add_validate_conservation(CLI::App& validate, Outcome& outcome);
void add_validate_order(CLI::App& validate, Outcome& outcome);
void add_validate_solvers(CLI::App& validate, Outcome& outcome);

}  // namespace dartboard
