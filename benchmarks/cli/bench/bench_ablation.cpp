#include <filesystem>
#include <memory>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/cli/bench/benches.h"
#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/scenes/ablation_study.h"
#include "benchmarks/studies/scenes/bench_ablation_study.h"

namespace dartboard {
namespace {

// A verb that help does not show.
void add_measure_ablation(CLI::App& app) {
  auto options = std::make_shared<AblationOptions>();
  auto* verb =
      app.add_subcommand("measure-ablation", "Time features on and off in this process (used by bench).")->group("");
  verb->add_option("--process", options->process);
  verb->add_option("--rounds", options->rounds)->check(positive_number());
  verb->add_option("--steps", options->steps)->check(positive_number());
  verb->add_option("--seed", options->seed);
  verb->callback([options] {
    study_ablation(*options, [](const Sample& sample) { tell("{}\n", json_text(nlohmann::json(sample))); });
  });
}

}  // namespace

void add_bench_ablation(CLI::App& bench, CLI::App& app, Outcome& outcome) {
  auto* verb = bench.add_subcommand(
      "ablation", "Each feature of a scene on from a bare one and off from a full one: bytes, and time per step.");
  auto options = study_options(
      *verb, {.quick = "fewer rounds, fewer processes", .seed = "the order of the tasks", .goes_on = true});
  verb->callback([options, &outcome] {
    RunFacts facts{.seeds = {{"order of the tasks", options->seed}},
                   .input_files = {source_folder() / "benchmarks/meshes/liver564.mesh",
                                   source_folder() / "benchmarks/scenes/liver_cut.json"}};
    run_study(
        *options, {.label = "ablation", .facts = facts},
        [&](StudyLog& log) {
          return ablation_bench({options->quick, options->seed}, log);
        },
        outcome);
  });
  add_measure_ablation(app);
}

}  // namespace dartboard
