#include <filesystem>
#include <memory>
#include <vector>

#include "benchmarks/cli/bench/benches.h"
#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/paper/paper_bodies.h"
#include "benchmarks/studies/step/bench_step_study.h"
#include "benchmarks/studies/step/changed_bodies.h"
#include "benchmarks/studies/step/changing_bodies.h"
#include "benchmarks/studies/step/step_costs.h"

namespace dartboard {
namespace {

constexpr auto print_sample = [](const auto& sample) { tell("{}\n", json_text(nlohmann::json(sample))); };

// Verbs that help does not show.
void add_measure_step(CLI::App& app) {
  struct Options : StepCostPlan {
    bool compare = false;
  };
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand("measure-step", "Time steps in this process (used by bench).")->group("");
  verb->add_flag("--compare", options->compare);
  verb->add_option("--process", options->process);
  verb->add_option("--rounds", options->rounds)->check(positive_number());
  verb->add_option("--largest", options->largest);
  verb->add_option("--seed", options->seed);
  verb->add_option("--mesh", options->meshes)->take_all();
  verb->add_option("--only", options->only);
  verb->callback([options] {
    options->compare ? compare_steps(*options, print_sample) : measure_step_costs(*options, print_sample);
  });
}

void add_measure_changed(CLI::App& app) {
  struct Options : ChangedPlan {
    bool compare = false;
  };
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand("measure-changed", "Time bodies that have changed (used by bench).")->group("");
  verb->add_flag("--compare", options->compare);
  verb->add_option("--body", options->body)->required();
  verb->add_option("--kind", options->kind)->required();
  verb->add_option("--folder", options->folder)->required();
  verb->add_option("--process", options->process);
  verb->add_option("--rounds", options->rounds)->check(positive_number());
  verb->add_option("--seed", options->seed);
  verb->callback([options] {
    options->compare ? compare_changed(*options, print_sample) : measure_changed(*options, print_sample);
  });
}

void add_measure_changing(CLI::App& app) {
  struct Options : ChangingPlan {
    bool compare = false;
  };
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand("measure-changing", "Time bodies that change (used by bench).")->group("");
  verb->add_flag("--compare", options->compare);
  verb->add_option("--largest", options->largest);
  verb->add_option("--process", options->process);
  verb->add_option("--rounds", options->rounds)->check(positive_number());
  verb->add_option("--seed", options->seed);
  verb->callback([options] {
    options->compare ? compare_changing(*options, print_sample) : measure_changing(*options, print_sample);
  });
}

}  // namespace

void add_bench_step(CLI::App& bench, CLI::App& app, Outcome& outcome) {
  auto* verb = bench.add_subcommand(
      "step",
      "An RK4 step over springs, compared with the naive graph and with the limits of the processor; after changes, and "
      "with a change in every step.");
  struct Options : StudyOptions {
    std::vector<std::filesystem::path> meshes;
  };
  auto options =
      study_options<Options>(*verb, {.quick = "bodies of up to 10^5 tetrahedra, fewer processes",
                                     .seed = "the order of the tasks, shuffled meshes, velocities and changes",
                                     .goes_on = true});
  verb->add_option(
      "MESH", options->meshes,
      "files of tetrahedra: their bodies follow the others, in the order of the file, cut finer until there "
      "are 10^5");
  verb->callback([options, &outcome] {
    RunFacts facts{.seeds = {{"order of the tasks, shuffled meshes, velocities, changes", options->seed}},
                   .input_files = {paper_body("liver").mesh}};
    facts.input_files.insert(facts.input_files.end(), options->meshes.begin(), options->meshes.end());
    run_study(
        *options, {.label = "step-costs", .facts = facts},
        [&](StudyLog& log) {
          return step_bench({options->quick, options->seed, options->meshes}, log);
        },
        outcome);
  });
  add_measure_step(app);
  add_measure_changed(app);
  add_measure_changing(app);
}

}  // namespace dartboard
