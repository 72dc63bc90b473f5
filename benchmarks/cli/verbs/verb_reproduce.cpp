#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/manifest.h"
#include "benchmarks/harness/run_folder.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/paper/scenes.h"
#include "benchmarks/studies/extremes/extremes_study.h"
#include "benchmarks/studies/reproduce/measure.h"
#include "benchmarks/studies/reproduce/reproduce_report.h"
#include "reference/cgal/cgal_body.h"

namespace dartboard {
namespace {

struct Options {
  bool json = false, quick = false;
  std::string out, part;
  std::uint64_t seed = 1;

  bool wants(std::string_view one) const { return part.empty() || part == one; }
};

constexpr int agreement_steps = 10;
const std::string body = "liver";

using Say = std::function<void(const std::string&)>;

/// The paper's walks, gated and timed, and its claims.
Answers reproduce_paper(const Options& options, const Problem& problem, const RunFolder& folder, const Say& say) {
  ReproduceResults results;
  results.quick = options.quick;
  say(fmt::format("Topology-based Physical Simulation, section 5, on a body of the paper's size{}\n",
                  options.quick ? " (a quick run: few rounds, wide intervals)" : ""));
  results.counts = compare_counts(problem);
  say("1. Topology, against CGAL\n\n" + to_text(counts_table(results)));
  results.motion = compare_motion(problem, agreement_steps);
  say(fmt::format("2. Forces, and states after {} steps, against the first contender\n\n", agreement_steps) +
      to_text(agreement_table(results)));

  const ReproduceGates gates = gates_of(results.counts, results.motion);
  if (!gates.agreed.empty()) {
    const MeasurePlan plan = plan_measurement(body, problem, gates.agreed, options.quick, options.seed);
    auto lines = folder.json_lines("samples.jsonl");
    say(fmt::format("3. Time per step: {} processes, {} interleaved rounds each", plan.processes, plan.rounds));
    results.per_step = per_step(measure(plan, [&](const StepSample& s) { lines.append(s); }));
  }
  const std::string note = timing_note(results, problem);
  say("\n" + to_text(timing_table(results)) + "\n" + note + "\n");

  Answers answers{answer_claims(results, problem), gates.passed};
  say("4. The paper's claims\n\n" + to_text(answers.claims));
  folder.write_table("counts", "Topology, against CGAL", counts_table(results));
  folder.write_table("agreement", "Forces and states, against the first contender", agreement_table(results));
  folder.write_table("timing", "Time per RK4 step", timing_table(results), note);
  return answers;
}

/// Integrators at the extremes, with the pictures, in a folder within that of the run.
Answers reproduce_extremes(const Options& options, const RunFolder& folder, const Say& say) {
  say(fmt::format("5. Numerical stability at the extremes{}\n", options.quick ? " (a third of the values)" : ""));
  const ExtremesResults results =
      measure_extremes({.quick = options.quick, .silent = options.json}, [](const auto&, std::string_view) {});
  const RunFolder part(folder.path() / "extremes");
  const std::vector<std::string> troubles = write_extremes(results, part);
  for (const std::string& trouble : troubles) tell(stderr, "{}\n", trouble);
  for (const NamedTable& t : tables_of(results))
    if (t.study == "matrix") say(t.heading + "\n\n" + to_text(t.table));
  for (const auto& cell : forbidden_cells(results)) say(json_text(cell));
  Answers answers{.claims = claims_of(results), .picture_trouble = troubles.empty() ? "" : troubles.front()};
  say(to_text(std::span<const Claim>(answers.claims)));
  return answers;
}

void reproduce(const Options& options, Outcome& outcome) {
  const Say say = [&](const std::string& text) {
    tell(options.json ? stderr : stdout, "{}\n", text);
    std::fflush(stdout);
  };
  const Scene& liver = scene(body);
  const Problem problem = liver.make();

  const RunFolder folder(run_path(options.out, options.quick ? "quick" : "reproduce"));
  RunFacts facts;
  facts.command_line = {outcome.command_line};
  facts.seeds = {{"order of tasks", options.seed}};
  facts.libraries = {{"CGAL", reference::cgal_version()}};
  facts.input_files = {liver.mesh};
  auto manifest = begin_manifest(facts);
  manifest["quick"] = options.quick;
  folder.write_manifest(manifest);

  Answers all;
  const auto add = [&](const Answers& part) {
    all.append(part);
    folder.write_claims(all.claims);  // what is answered stays if the next part is interrupted
  };
  if (options.wants("paper")) add(reproduce_paper(options, problem, folder, say));
  if (options.wants("extremes")) add(reproduce_extremes(options, folder, say));
  finish_manifest(manifest);
  folder.write_manifest(manifest);

  outcome.exit_code = reproduce_exit_code(all.claims, all.gates_passed);
  picture_missing(outcome, all.picture_trouble);
  if (options.json)
    tell("{}\n",
         json_text(nlohmann::json{{"claims", all.claims}, {"manifest", manifest}, {"gates_passed", all.gates_passed}},
                   2));
  say(fmt::format("{}\nWritten to {}: claims.md, claims.json, tables, and all samples.",
                  closing_words(all.claims, all.gates_passed, options.quick), folder.path().string()));
}

}  // namespace

void add_reproduce(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand(
      "reproduce",
      "Gate and time the paper's walks on a body of its size and answer its claims; then put all integrators to the "
      "extremes and answer ours.");
  verb->add_flag("--quick", options->quick,
                 "fewer processes and rounds, a third of the extremes; a minute instead of three");
  verb->add_option("--part", options->part, "only this part: paper, some 20 s, or extremes [both]")
      ->check(CLI::IsMember({"paper", "extremes"}));
  verb->add_option("--out", options->out, "folder to write to, new or empty [dartboard-results/reproduce-TIME]");
  verb->add_option("--seed", options->seed, "of the order in which contenders take turns [1]");
  verb->add_flag("--json", options->json,
                 "print claims and manifest as JSON on standard output, the rest on standard error");
  verb->callback([options, &outcome] { reproduce(*options, outcome); });
}

}  // namespace dartboard
