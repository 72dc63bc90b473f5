#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/cli/study_names.h"
#include "benchmarks/cli/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/studies/tradeoff/tradeoff_study.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

struct Options : StudyOptions {
  std::string scene;
  bool all = false;
  TradeoffPlan plan;
};

void tradeoff(const Options& options, Outcome& outcome) {
  TradeoffPlan plan = options.plan;
  plan.quick = options.quick;
  plan.seed = options.seed;
  if (options.all == !options.scene.empty()) throw InputError("give the name of a scene, a scene file, or --all");
  const std::string given = options.all ? "" : study_scene_or_file(options.scene);
  const bool file = given.ends_with(".json");
  if (file) plan.scenes.push_back(given);
  for (const TradeoffEntry& entry : tradeoff_scenes())
    if (options.all || entry.name == given) plan.scenes.emplace_back(entry.name);
  if (plan.scenes.empty()) make_tradeoff_scene(given, "");  // tells which there are
  check_tradeoff(plan);                                     // before there is a folder

  RunFacts facts{.seeds = {{"order of the integrators", plan.seed}}};
  facts.input_files = {file ? std::filesystem::path(given)
                            : std::filesystem::path(DARTBOARD_SOURCE_DIR) / "benchmarks/meshes/liver564.mesh"};
  run_study(
      options, {.label = "tradeoff", .facts = facts}, [&](StudyLog& log) { return tradeoff_study(plan, log); },
      outcome);
}

}  // namespace

void add_tradeoff(CLI::App& app, Outcome& outcome) {
  auto* verb = app.add_subcommand("tradeoff", "Measure what accuracy costs on a scene: every integrator, every step.");
  auto options =
      study_options<Options>(*verb, {.quick = "short runs, few repetitions", .seed = "the order of the integrators"});
  verb->add_option("SCENE", options->scene,
                   "a scene file (.json), the name of one of the gallery, or one of " + study_scene_names());
  verb->add_flag("--all", options->all, "all scenes");
  verb->add_option("--only", options->plan.only, "names of the integrators that take part [all]");
  verb->add_flag("--solvers", options->plan.solvers, "implicit methods with every linear solver");
  verb->add_option("--most", options->plan.most_s, "seconds that one run may take [8, quick 0.4]")
      ->check(positive_number());
  verb->callback([options, &outcome] { tradeoff(*options, outcome); });
}

}  // namespace dartboard
