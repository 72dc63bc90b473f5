#include <memory>

#include "benchmarks/cli/bench/benches.h"
#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/paper/paper_bodies.h"
#include "benchmarks/studies/operations/bench_operations_study.h"
#include "benchmarks/studies/operations/operation_study.h"

namespace dartboard {
namespace {

// A verb that help does not show.
void add_measure_operations(CLI::App& app) {
  struct Options {
    OperationStudyOptions study;
    std::string body;
  };
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand("measure-operations", "Time operations on one body in this process (used by bench).")
                   ->group("");
  verb->add_option("--process", options->study.process);
  verb->add_option("--times", options->study.times)->check(positive_number());
  verb->add_option("--seed", options->study.seed);
  verb->add_option("BODY", options->body)->required();
  verb->callback([options] {
    const auto print = [](const auto& sample) { tell("{}\n", json_text(nlohmann::json(sample))); };
    study_operations(options->body, options->study, print, print);
  });
}

}  // namespace

void add_bench_operations(CLI::App& bench, CLI::App& app, Outcome& outcome) {
  auto* verb = bench.add_subcommand(
      "operations",
      "Dissociate, remove, tear, refine, split off, undo: by size of the body, compared with the time of a step.");
  auto options = study_options(
      *verb, {.quick = "small bodies, fewer processes", .seed = "the places of the operations", .goes_on = true});
  verb->callback([options, &outcome] {
    RunFacts facts{.seeds = {{"places of operations", options->seed}}, .input_files = {paper_body("liver").mesh}};
    run_study(
        *options, {.label = "operations", .facts = facts},
        [&](StudyLog& log) {
          return operations_bench({options->quick, options->seed}, log);
        },
        outcome);
  });
  add_measure_operations(app);
}

}  // namespace dartboard
