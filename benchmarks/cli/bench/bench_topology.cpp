#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "benchmarks/cli/bench/benches.h"
#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/paper/paper_bodies.h"
#include "benchmarks/studies/topology/bench_topology_study.h"
#include "reference/cgal/cgal_body.h"

namespace dartboard {
namespace {

// A verb that help does not show.
void add_measure_topology(CLI::App& app) {
  struct Options {
    PairedOptions paired;
    std::vector<std::string> groups;
  };
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand("measure-topology", "Time topology in this process (used by bench).")->group("");
  verb->add_option("--process", options->paired.process);
  verb->add_option("--rounds", options->paired.rounds)->check(positive_number());
  verb->add_option("--seed", options->paired.seed);
  verb->add_option("BODY:FIGURE", options->groups)->required();
  verb->callback([options] { run_topology_child(options->paired, options->groups); });
}

}  // namespace

void add_bench_topology(CLI::App& bench, CLI::App& app, Outcome& outcome) {
  struct Options : StudyOptions {
    std::vector<std::string> only = topology_bench_bodies();
  };
  auto* verb =
      bench.add_subcommand("topology", "Memory, walks, checks, building and unsewing, side by side with CGAL.");
  auto options = study_options<Options>(
      *verb,
      {.quick = "fewer processes and rounds", .seed = "the order of turns and the random faces", .goes_on = true});
  const auto bodies = topology_bench_bodies();
  verb->add_option("--only", options->only, fmt::format("of {} [all]", fmt::join(bodies, ", ")))
      ->check(CLI::IsMember(bodies));
  verb->callback([options, &outcome] {
    RunFacts facts{.seeds = {{"order of tasks, random faces", options->seed}},
                   .libraries = {{"CGAL", reference::cgal_version()}},
                   .input_files = {paper_body("liver").mesh}};
    run_study(
        *options, {.label = "topology", .facts = facts},
        [&](StudyLog& log) {
          return topology_bench({options->only, options->quick, options->seed}, log);
        },
        outcome);
  });
  add_measure_topology(app);
}

}  // namespace dartboard
