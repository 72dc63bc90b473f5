#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>

#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/manifest.h"
#include "benchmarks/harness/processes.h"
#include "benchmarks/harness/progress.h"
#include "benchmarks/harness/run_folder.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/scenes/ablation_study.h"
#include "benchmarks/studies/scenes/bench_ablation_report.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/plan/measured_plan.h"
#include "core/scene/run/simulation.h"

namespace dartboard {
namespace {

void add_measure_ablation(CLI::App& app) {
  auto options = std::make_shared<AblationOptions>();
  auto* verb =
      app.add_subcommand("measure-ablation", "Time features on and off in this process (used by bench).")->group("");
  verb->add_option("--process", options->process);
  verb->add_option("--rounds", options->rounds)->check(CLI::PositiveNumber);
  verb->add_option("--steps", options->steps)->check(CLI::PositiveNumber);
  verb->add_option("--seed", options->seed);
  verb->callback([options] {
    study_ablation(*options, [](const Sample& sample) { tell("{}\n", json_text(nlohmann::json(sample))); });
  });
}

// ---- what the variants hold

/// Asked of the built objects, part by part, whatever a plan says.
std::map<std::string, AblationBytes> bytes_of_variants() {
  std::map<std::string, AblationBytes> all;
  for (const AblationVariant& variant : ablation_variants()) {
    const MeshTally counts = plan_scene(variant.scene, make_problem(variant.scene)).counts;
    const MemoryReport report = measured_memory(variant.scene);
    AblationBytes bytes{.tetrahedra = counts.cells,
                        .springs = counts.edges,
                        .not_asked_for = bytes_not_asked_for(report),
                        .damping = bytes_of_damping(report, counts.edges)};
    for (const MemoryItem& item : report) bytes.total += item.bytes;
    all[variant.name] = bytes;
  }
  return all;
}

// ---- the verb

struct Options {
  bool json = false, quick = false;
  std::string out;
  std::uint64_t seed = 1;
};

void bench_ablation(const Options& options, Outcome& outcome) {
  const auto say = [&](const std::string& text) { tell(options.json ? stderr : stdout, "{}\n", text); };
  const RunFolder folder(run_path(options.out, "ablation"));
  RunFacts facts;
  facts.command_line = {outcome.command_line};
  facts.seeds = {{"order of the tasks", options.seed}};
  facts.input_files = {std::filesystem::path(DARTBOARD_SOURCE_DIR) / "benchmarks" / "meshes" / "liver564.mesh"};
  auto manifest = begin_manifest(facts);
  manifest["quick"] = options.quick;
  folder.write_manifest(manifest);

  const int processes = options.quick ? 6 : 11, rounds = options.quick ? 3 : 12, steps = options.quick ? 20 : 60;
  AblationFigures results{.samples = {}, .bytes = bytes_of_variants(), .steps = steps};
  say(fmt::format("{} scenes and {} loops, {} steps each time, in {} processes", results.bytes.size(), 5, steps,
                  processes));
  auto lines = folder.json_lines("samples.jsonl");
  {
    Progress progress("timing", static_cast<std::size_t>(processes), options.json);
    for (int process = 0; process < processes; ++process) {
      run_self({"measure-ablation", "--process", std::to_string(process), "--rounds", std::to_string(rounds), "--steps",
                std::to_string(steps), "--seed", std::to_string(options.seed)},
               [&](std::string_view line) {
                 const auto json = nlohmann::json::parse(line);
                 lines.append(json);
                 results.samples.push_back(json.get<Sample>());
               });
      progress.advance();
    }
  }

  check_repeats(results.samples);
  const auto claims = claims_of(results);
  say("\n" + to_text(features_table(results)) + "\n" + features_note() + "\n");
  say("The bare scene, with less and less around its loop\n\n" + to_text(staircase_table(results)));
  say("Targets\n\n" + to_text(claims));
  folder.write_claims(claims);
  folder.write_table("features", "Features on and off", features_table(results), features_note());
  folder.write_table("staircase", "The bare scene, with less and less around its loop", staircase_table(results));
  const std::string trouble = draw(ablation_plot(results), folder.path(), "ablation");
  if (!trouble.empty()) say(trouble);
  finish_manifest(manifest);
  folder.write_manifest(manifest);
  outcome.exit_code = exit_code(claims);
  picture_missing(outcome, trouble);
  if (options.json) tell("{}\n", json_text(nlohmann::json{{"claims", claims}, {"manifest", manifest}}, 2));
  say(fmt::format("{}{}\nWritten to {}: claims.md, tables, a picture, and all samples.",
                  options.quick ? "This was a quick run. " : "", in_words(claims), folder.path().string()));
}

}  // namespace

void add_bench_ablation(CLI::App& bench, CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  auto* verb = bench.add_subcommand(
      "ablation", "Each feature of a scene on from a bare one and off from a full one: bytes, and time per step.");
  verb->add_flag("--quick", options->quick, "fewer rounds, fewer processes");
  verb->add_option("--out", options->out, "folder to write to, new or empty [dartboard-results/ablation-TIME]");
  verb->add_option("--seed", options->seed, "of the order of the tasks [1]");
  verb->add_flag("--json", options->json,
                 "print claims and manifest as JSON on standard output, the rest on standard error");
  verb->callback([options, &outcome] { bench_ablation(*options, outcome); });
  add_measure_ablation(app);
}

}  // namespace dartboard
