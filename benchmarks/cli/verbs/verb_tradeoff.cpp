#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/cli/studies/study_names.h"
#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/models/model_times.h"
#include "benchmarks/studies/models/models_study.h"
#include "benchmarks/studies/tradeoff/tradeoff_study.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

struct TradeoffOptions : StudyOptions {
  std::string scene;
  bool all = false, models = false;
  TradeoffPlan plan;
};

void tradeoff_of_models(const TradeoffOptions& options, Outcome& outcome) {
  if (options.scene.empty())
    throw InputError("--models: give a scene of a bar that is held at one end, or 'cantilever'");
  const bool built_in = options.scene == "cantilever";
  const std::string file = built_in ? "" : scene_file(options.scene, std::vector<std::string>{"cantilever"}).string();
  ModelsPlan plan = models_plan(built_in ? options.scene : file);
  plan.quick = options.quick;
  plan.seed = options.seed;
  RunFacts facts{.seeds = {{"order of the tasks", plan.seed}}};
  if (!built_in) facts.input_files = {file};
  run_study(
      options, {.label = "models", .facts = facts}, [&](StudyLog& log) { return models_study(plan, log); }, outcome);
}

void tradeoff(const TradeoffOptions& options, Outcome& outcome) {
  if (options.models) return tradeoff_of_models(options, outcome);
  TradeoffPlan plan = options.plan;
  plan.quick = options.quick;
  plan.seed = options.seed;
  if (options.all == !options.scene.empty()) throw InputError("give the name of a scene, a scene file, or --all");
  const std::string given = options.all ? "" : study_scene_or_file(options.scene);
  const bool file = given.ends_with(".json");
  if (file) plan.scenes.push_back(given);
  for (const TradeoffEntry& entry : tradeoff_scenes())
    if (options.all || entry.name == given) plan.scenes.emplace_back(entry.name);
  if (plan.scenes.empty()) make_tradeoff_scene(given, "");  // the error lists the names
  check_tradeoff(plan);                                     // before the folder is made

  RunFacts facts{.seeds = {{"order of the integrators", plan.seed}}};
  facts.input_files = {file ? std::filesystem::path(given) : source_folder() / "benchmarks/meshes/liver564.mesh"};
  run_study(
      options, {.label = "tradeoff", .facts = facts}, [&](StudyLog& log) { return tradeoff_study(plan, log); },
      outcome);
}

// A verb that help does not show.
void add_measure_models(CLI::App& app) {
  auto plan = std::make_shared<std::string>();
  auto* verb =
      app.add_subcommand("measure-models", "Time bars in this process (used by tradeoff --models).")->group("");
  verb->add_option("PLAN", *plan)->required();
  verb->callback([plan] {
    measure_models(from_argument(*plan), [](const Sample& sample) { tell("{}\n", json_text(nlohmann::json(sample))); });
  });
}

}  // namespace

void add_tradeoff(CLI::App& app, Outcome& outcome) {
  auto* verb = app.get_subcommand("tradeoff");
  auto options = study_options<TradeoffOptions>(
      *verb, {.quick = "short runs, few repetitions", .seed = "the order of the integrators", .goes_on = true});
  verb->add_option("SCENE", options->scene,
                   "a scene file (.json), the name of one of the gallery, or one of " + study_scene_names());
  auto* all = verb->add_flag("--all", options->all, "all scenes");
  auto* models =
      verb->add_flag("--models", options->models,
                     "springs and elements compared with converged quadratic ones: of 'cantilever', or of a scene "
                     "whose box is held at one end");
  auto* only = verb->add_option("--only", options->plan.only, "names of the integrators that take part [all]");
  auto* solvers = verb->add_flag("--solvers", options->plan.solvers, "implicit methods with every linear solver");
  auto* most = verb->add_option("--most", options->plan.most_s, "seconds that one run may take [8, quick 0.4]")
                   ->check(positive_number());
  for (CLI::Option* of_integrators : {all, only, solvers, most}) models->excludes(of_integrators);
  add_measure_models(app);
  verb->callback([options, &outcome] { tradeoff(*options, outcome); });
}

}  // namespace dartboard
