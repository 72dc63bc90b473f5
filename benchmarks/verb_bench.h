#pragma once
// The parts of the verb `bench`.

#include <CLI/App.hpp>

#include "benchmarks/cli.h"

namespace dartboard {

// Each adds its own verb to `bench`, and to `app` the hidden one that its child processes run.
void add_bench_ablation(CLI::App& bench, CLI::App& app, Outcome& outcome);
void add_bench_topology(CLI::App& bench, CLI::App& app, Outcome& outcome);
void add_bench_operations(CLI::App& bench, CLI::App& app, Outcome& outcome);

}  // namespace dartboard
