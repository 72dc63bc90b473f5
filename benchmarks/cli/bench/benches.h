#pragma once
// The parts of `bench`; each has a file of its own.

#include <CLI/App.hpp>

#include "benchmarks/cli/cli.h"

namespace dartboard {

// Each adds a verb to `bench`, as those of verbs.h do, and to `app` the hidden verbs that its child processes run.
void add_bench_ablation(CLI::App& bench, CLI::App& app, Outcome& outcome);
void add_bench_topology(CLI::App& bench, CLI::App& app, Outcome& outcome);
void add_bench_operations(CLI::App& bench, CLI::App& app, Outcome& outcome);
void add_bench_contact(CLI::App& bench, CLI::App& app, Outcome& outcome);
void add_bench_step(CLI::App& bench, CLI::App& app, Outcome& outcome);
void add_bench_large(CLI::App& bench, CLI::App& app, Outcome& outcome);

}  // namespace dartboard
