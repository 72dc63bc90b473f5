#include <memory>

#include "benchmarks/cli/bench/benches.h"
#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/large/bench_large_study.h"
#include "benchmarks/studies/large/large_bodies.h"

namespace dartboard {
namespace {

// A verb that help does not show.
void add_measure_large(CLI::App& app) {
  struct Options : LargePlan {
    bool start = false;
  };
  auto options = std::make_shared<Options>();
  auto* verb =
      app.add_subcommand("measure-large", "Time a run of a large body in this process (used by bench).")->group("");
  verb->add_option("--side", options->side)->required()->check(CLI::Range(1, 300));
  verb->add_option("--process", options->process);
  verb->add_flag("--start", options->start);
  verb->callback([options] {
    const auto print = [](const auto& found) { tell("{}\n", json_text(nlohmann::json(found))); };
    options->start ? measure_large_start(*options, print) : measure_large(*options, print, print);
  });
}

}  // namespace

void add_bench_large(CLI::App& bench, CLI::App& app, Outcome& outcome) {
  auto* verb = bench.add_subcommand(
      "large",
      "Time and memory of each part of a run, up to ten million tetrahedra that are cut, compared with copies.");
  auto options = study_options(*verb, {.quick = "the body of 10^5 tetrahedra alone, fewer processes", .goes_on = true});
  verb->callback([options, &outcome] {
    run_study(
        *options, {.label = "large"}, [&](StudyLog& log) { return large_bench({options->quick}, log); }, outcome);
  });
  add_measure_large(app);
}

}  // namespace dartboard
