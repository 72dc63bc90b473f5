// dartboard tradeoff: what accuracy costs, on every scene of the study, with every integrator.

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "benchmarks/cli/study_names.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/manifest.h"
#include "benchmarks/harness/run_folder.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/tradeoff/tradeoff_json.h"
#include "benchmarks/studies/tradeoff/tradeoff_report.h"
#include "benchmarks/studies/tradeoff/tradeoff_tables.h"
#include "benchmarks/studies/tradeoff/work_precision_plot.h"
#include "core/plain/error.h"
#include "validation/scenes/scene_of_file.h"
#include "validation/tradeoff/work_precision.h"

namespace dartboard {
namespace {

struct Options {
  std::string scene, out;
  std::vector<std::string> only;
  bool all = false, quick = false, json = false, solvers = false;
  double most_s = 0.0;
  std::uint64_t seed = 1;
};

/// Those that take part.
///
/// throws  InputError for a name that none has
std::vector<TradeoffContender> contenders_of(const Options& options) {
  std::vector<TradeoffContender> contenders = tradeoff_contenders(options.solvers);
  std::string known;
  for (const TradeoffContender& c : contenders) known += fmt::format("{}'{}'", known.empty() ? "" : ", ", c.name);
  for (const std::string& name : options.only)
    if (std::ranges::find(contenders, name, &TradeoffContender::name) == contenders.end())
      throw InputError(fmt::format("--only: no integrator '{}' takes part; expected some of {}", name, known));
  if (!options.only.empty())
    std::erase_if(contenders, [&](const TradeoffContender& c) {
      return std::ranges::find(options.only, c.name) == options.only.end();
    });
  return contenders;
}

WorkPrecision study_scene(const std::string& scene_name, const Options& options, const RunFolder& folder,
                          JsonLines& samples, Outcome& outcome, const std::function<void(const std::string&)>& say) {
  const TradeoffScene scene =
      find_scene(scene_name, std::filesystem::path(DARTBOARD_SOURCE_DIR) / "benchmarks" / "meshes");
  say(fmt::format("{}: {}; T omega_max = {:.4g}", one_line(scene.name), one_line(scene.what, 400),
                  scene.duration * scene.fastest_rate));
  const CpuClock clock = thread_cpu_ns;
  const SceneReference reference = reference_of(
      scene, clock,
      {.oracle_s = options.quick ? 6.0 : 60.0, .self_converged_s = options.quick ? 4.0 : 40.0, .gain = !options.quick});
  say(fmt::format("reference: {}; floor {:.1e} edges, {:.1f} s", reference.what, reference.floor, reference.cpu_s));

  WorkPrecisionOptions how;
  how.seed = options.seed;
  how.most_s = options.most_s > 0.0 ? options.most_s : options.quick ? 0.4 : 8.0;
  if (options.quick) {
    how.fewest_repetitions = 2;
    how.repetitions_s = 0.05;
  }
  const std::vector<TradeoffContender> contenders = contenders_of(options);
  WorkPrecision study = work_precision(scene, reference, contenders, clock, how,
                                       [&](const WorkPoint& p) { samples.append(json_of(scene.name, p)); });
  if (reference.gain > 0.0) say(fmt::format("a small disturbance grows by {:.3g}", reference.gain));
  if (!options.solvers)
    study.omissions.emplace_back(
        "Implicit methods solve with a kept factor only; --solvers adds fresh factors and conjugate gradients.");
  study.omissions.emplace_back(
      "Steps are powers of two of the distance of checkpoints; the largest stable step lies "
      "up to a factor of two above the largest tried.");
  study.omissions.emplace_back("No multirate, exponential or multigrid method takes part.");

  say("\n" + to_text(winners_table(study)) + "\nRegret of a fixed choice\n\n" + to_text(regrets_table(study)) +
      "\nOmissions\n\n" + bullets(study.omissions, terminal_text));
  // what the files are called
  const std::string stem = file_name_of(scene.name);
  folder.write(stem + ".md", tradeoff_page(study, stem));
  if (const std::string trouble = draw(work_precision_plot(study), folder.path(), stem); !trouble.empty()) {
    say(trouble);
    picture_missing(outcome, trouble);
  }
  return study;
}

void tradeoff(const Options& options, Outcome& outcome) {
  const auto say = [&](const std::string& text) {
    tell(options.json ? stderr : stdout, "{}\n", text);
    std::fflush(options.json ? stderr : stdout);
  };
  std::vector<std::string> names;
  if (options.all == !options.scene.empty()) throw InputError("give the name of a scene, a scene file, or --all");
  const std::string given = options.all ? "" : study_scene_or_file(options.scene);
  const bool file = given.ends_with(".json");
  if (file) names.push_back(given);
  for (const TradeoffEntry& entry : tradeoff_scenes())
    if (options.all || entry.name == given) names.emplace_back(entry.name);
  if (names.empty()) make_tradeoff_scene(given, "");  // tells which there are
  contenders_of(options);                             // and this, which integrators

  const RunFolder folder(run_path(options.out, "tradeoff"));
  RunFacts facts;
  facts.command_line = {outcome.command_line};
  facts.seeds = {{"order of the integrators", options.seed}};
  facts.input_files = {std::filesystem::path(DARTBOARD_SOURCE_DIR) / "benchmarks" / "meshes" / "liver564.mesh"};
  if (file) facts.input_files = {given};
  auto manifest = begin_manifest(facts);
  manifest["quick"] = options.quick;
  folder.write_manifest(manifest);
  auto samples = folder.json_lines("samples.jsonl");
  nlohmann::json summaries = nlohmann::json::array();
  for (const std::string& scene_name : names) {
    const WorkPrecision study = study_scene(scene_name, options, folder, samples, outcome, say);
    summaries.push_back(summary_of(study));
    if (const std::string trouble = trouble_of(study); !trouble.empty()) {
      say(trouble);
      outcome.exit_code = exit_disagrees;
    }
  }
  folder.write_json("winners.json", summaries);
  finish_manifest(manifest);
  folder.write_manifest(manifest);
  if (options.json) tell("{}\n", json_text(nlohmann::json{{"scenes", summaries}, {"manifest", manifest}}, 2));
  say(fmt::format("Written to {}.", folder.path().string()));
}

}  // namespace

void add_tradeoff(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand("tradeoff", "Measure what accuracy costs on a scene: every integrator, every step.");
  std::string known;
  for (const TradeoffEntry& entry : tradeoff_scenes())
    known += fmt::format("{}{}", known.empty() ? "" : ", ", entry.name);
  verb->add_option("SCENE", options->scene, "a scene file (.json), the name of one of the gallery, or one of " + known);
  verb->add_flag("--all", options->all, "all scenes");
  verb->add_option("--only", options->only, "names of the integrators that take part [all]");
  verb->add_flag("--quick", options->quick, "short runs, few repetitions");
  verb->add_flag("--solvers", options->solvers, "implicit methods with every linear solver");
  verb->add_option("--most", options->most_s, "seconds that one run may take [8, quick 0.4]")->check(positive_number());
  verb->add_option("--out", options->out, "folder to write to, new or empty [dartboard-results/tradeoff-TIME]");
  verb->add_option("--seed", options->seed, "of the order of the integrators [1]");
  verb->add_flag("--json", options->json,
                 "print the winners and the manifest as JSON on standard output, the rest on standard error");
  verb->callback([options, &outcome] { tradeoff(*options, outcome); });
}

}  // namespace dartboard
