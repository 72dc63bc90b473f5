#pragma once
// The verbs of the harness; each has a file of its own.

#include <CLI/App.hpp>

#include "benchmarks/cli/cli.h"

namespace dartboard {

/// Adds these verbs, those of benchmarks/cli/scenes, and the hidden ones of processes that time.
void add_all_verbs(CLI::App& app, Outcome& outcome);

// Each adds a verb whose callback does the work and stores its exit code in `outcome`, which must outlive the parse.
void add_reproduce(CLI::App& app, Outcome& outcome);
void add_measure(CLI::App& app, Outcome& outcome);
void add_validate(CLI::App& app, Outcome& outcome);
void add_bench(CLI::App& app, Outcome& outcome);
void add_tradeoff(CLI::App& app, Outcome& outcome);
void add_recommend(CLI::App& app, Outcome& outcome);
void add_extremes(CLI::App& app, Outcome& outcome);
void add_explain_dt(CLI::App& app, Outcome& outcome);
void add_gallery(CLI::App& app, Outcome& outcome);
void add_report(CLI::App& app, Outcome& outcome);
void add_compare(CLI::App& app, Outcome& outcome);
void add_list(CLI::App& app, Outcome& outcome);

// The parts of `validate`; that on elements also gives `app` the hidden verb that its child processes run.
void add_validate_conservation(CLI::App& validate, Outcome& outcome);
void add_validate_contact(CLI::App& validate, Outcome& outcome);
void add_validate_order(CLI::App& validate, Outcome& outcome);
void add_validate_judges(CLI::App& validate, Outcome& outcome);
void add_validate_drawn(CLI::App& validate, Outcome& outcome);
void add_validate_elements(CLI::App& validate, CLI::App& app, Outcome& outcome);
void add_validate_solvers(CLI::App& validate, Outcome& outcome);

}  // namespace dartboard
