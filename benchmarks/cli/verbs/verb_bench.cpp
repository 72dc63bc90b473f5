#include "benchmarks/cli/bench/benches.h"
#include "benchmarks/cli/verbs/verbs.h"

namespace dartboard {

void add_bench(CLI::App& app, Outcome& outcome) {
  auto* bench = app.get_subcommand("bench");
  bench->require_subcommand(1);
  add_bench_ablation(*bench, app, outcome);
  add_bench_topology(*bench, app, outcome);
  add_bench_operations(*bench, app, outcome);
  add_bench_contact(*bench, app, outcome);
  add_bench_step(*bench, app, outcome);
  add_bench_large(*bench, app, outcome);
}

}  // namespace dartboard
