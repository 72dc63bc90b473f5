#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>

#include "benchmarks/cli/bench_run.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/processes.h"
#include "benchmarks/harness/progress.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/paper/scenes.h"
#include "benchmarks/studies/operations/bench_operations_report.h"

namespace dartboard {
namespace {

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

// ---- the verb

void bench_operations(const BenchOptions& options, Outcome& outcome) {
  RunFacts facts;
  facts.command_line = {outcome.command_line};
  facts.seeds = {{"places of operations", options.seed}};
  facts.input_files = {scene("liver").mesh};
  BenchRun run(options, "operations", facts);

  std::vector<std::string> bodies = operation_bodies();
  if (options.quick) bodies = {"liver564", "kuhn-2058"};
  const int processes = options.quick ? 3 : 6, times = options.quick ? 50 : 200;
  run.say(
      fmt::format("{} bodies, each in {} processes, each operation up to {} times", bodies.size(), processes, times));
  Progress progress("timing", static_cast<std::size_t>(processes) * bodies.size());
  auto lines = run.folder().json_lines("samples.jsonl");
  OperationFigures results;
  for (int process = 0; process < processes; ++process)
    for (const std::string& body : bodies) {
      run_self({"measure-operations", "--process", std::to_string(process), "--times", std::to_string(times), "--seed",
                std::to_string(options.seed + static_cast<std::uint64_t>(process)), body},
               [&](std::string_view line) {
                 const auto json = nlohmann::json::parse(line);
                 lines.append(json);
                 if (json.contains("operation")) {
                   auto s = json.get<OperationSample>();
                   results.operations[s.body + ":" + s.operation].push_back(std::move(s));
                 } else {
                   auto s = json.get<BodySample>();
                   results.bodies[s.body].push_back(std::move(s));
                 }
               });
      progress.advance(body);
    }

  const auto claims = claims_of(results, bodies);
  run.say("\n" + to_text(operations_table(results, bodies)) + "\n" + operations_note() + "\n");
  run.say("Views: following a change, and starting again\n\n" + to_text(views_table(results, bodies)));
  run.say("Targets\n\n" + to_text(claims));
  run.folder().write_claims(claims);
  run.folder().write_table("operations", "Operations, one by one", operations_table(results, bodies),
                           operations_note());
  run.folder().write_table("views", "Views: following a change, and starting again", views_table(results, bodies));
  outcome.exit_code = exit_code(claims);
  run.finish(claims);
}

}  // namespace

void add_bench_operations(CLI::App& bench, CLI::App& app, Outcome& outcome) {
  auto* verb = bench.add_subcommand(
      "operations",
      "Dissociate, remove, tear, refine, split off, undo: by size of the body, beside the time of a step.");
  const auto options = add_bench_options(*verb, "small bodies, fewer processes", "the places of the operations");
  verb->callback([options, &outcome] { bench_operations(*options, outcome); });
  add_measure_operations(app);
}

}  // namespace dartboard
