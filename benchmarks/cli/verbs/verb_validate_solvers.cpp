// dartboard validate solvers: are the solutions of linear systems right, and what do they cost?

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>

#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/manifest.h"
#include "benchmarks/harness/run_folder.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/solvers/solver_report.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

struct Options {
  std::vector<std::string> only;
  bool json = false, quick = false;
  std::string out;
  std::uint64_t seed = 1;
  bool wants(std::string_view part) const { return only.empty() || std::ranges::find(only, part) != only.end(); }
};
constexpr std::string_view parts[]{"accuracy", "edits", "updates", "crossover", "steps"};

SolverResults run_part(std::string_view part, const Options& options,
                       const std::function<void(const std::string&)>& say) {
  SolverResults results;
  const CpuClock clock = thread_cpu_ns;
  if (part == "accuracy") {
    SolveAccuracyOptions how;
    if (options.quick) how = {.side = 4, .h_omega_step = 1e3, .pcg_tolerance = 1e-10};
    say("accuracy: all scales of mass, stiffness and step");
    results.cells = solve_accuracy(how);
    results.indefinite = indefinite_systems();
  }
  if (part == "edits") {
    const std::size_t edits = options.quick ? 200 : 3000;
    for (const double stretch : {0.0, 0.2})
      for (const EditPolicy& policy : edit_policies()) {
        say(fmt::format("edits: {}, {}", policy.name, stretch == 0.0 ? "at rest" : "stretched"));
        results.edits.push_back(run_edits(policy, options.quick ? 6 : 8, stretch, edits, clock));
      }
  }
  if (part == "updates")
    for (const int side : {8, 12, 16}) {
      if (options.quick && side > 8) continue;
      for (const double stretch : {0.0, 0.2}) {
        const int rounds = side == 16 ? 9 : 17;
        results.updates.push_back(time_updates(side, stretch, options.quick ? 5 : rounds, options.seed));
        say(fmt::format("updates: {}", results.updates.back().body));
      }
    }
  if (part == "crossover") {
    const CrossoverOptions how;
    results.crossover_error = how.error;
    for (const int side : {8, 12, 16}) {
      if (options.quick && side > 8) continue;
      results.crossovers.push_back(find_crossover(side, how, clock, [&](const CostPair& c) {
        say(
            fmt::format("crossover: {}^3 vertices, stiffness factor {:.2g}, T omega_max {:.3g}: explicit {:.3g} s, {} "
                        "{:.3g} s",
                        side, c.factor, c.phase, c.explicit_s, c.implicit_method, c.implicit_s));
      }));
    }
  }
  if (part == "steps")
    // the longest step that the paper's method could take, and longer ones
    for (const double h_omega : {2.83, 10.0, 100.0})
      results.steps.push_back(time_implicit_step(h_omega, options.quick ? 6 : 30, options.seed));
  return results;
}

void append(SolverResults& all, SolverResults part) {
  const auto move_to = [](auto& to, auto& from) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  };
  move_to(all.cells, part.cells);
  move_to(all.indefinite, part.indefinite);
  move_to(all.edits, part.edits);
  move_to(all.updates, part.updates);
  move_to(all.crossovers, part.crossovers);
  move_to(all.steps, part.steps);
  if (part.crossover_error > 0.0) all.crossover_error = part.crossover_error;
}

void validate(const Options& options, Outcome& outcome) {
  const auto say = [&](const std::string& text) {
    tell(options.json ? stderr : stdout, "{}\n", text);
    std::fflush(options.json ? stderr : stdout);
  };
  for (const std::string& part : options.only)
    if (std::ranges::find(parts, part) == std::end(parts))
      throw InputError(fmt::format("--only {}: there are accuracy, edits, updates, crossover, steps", part));
  const RunFolder folder(run_path(options.out, "solvers"));
  RunFacts facts;
  facts.command_line = {outcome.command_line};
  facts.seeds = {{"order of the tasks", options.seed}};
  facts.input_files = {std::filesystem::path(DARTBOARD_SOURCE_DIR) / "benchmarks" / "meshes" / "liver564.mesh"};
  auto manifest = begin_manifest(facts);
  manifest["quick"] = options.quick;
  folder.write_manifest(manifest);

  // each part is written when it is done: a run that dies keeps what it had measured
  auto samples = folder.json_lines("samples.jsonl");
  SolverResults results;
  for (const std::string_view part : parts) {
    if (!options.wants(part)) continue;
    SolverResults found = run_part(part, options, say);
    for_each_sample(found, [&](const nlohmann::json& sample) { samples.append(sample); });
    append(results, std::move(found));
  }
  for (const NamedTable& t : tables_of(results)) {
    say(fmt::format("\n{}\n\n{}\n{}", t.heading, to_text(t.table), t.note));
    folder.write_table(t.name, t.heading, t.table, t.note);
  }
  std::string trouble;
  if (std::ranges::any_of(results.crossovers, [](const Crossover& c) { return c.failure.empty(); }))
    trouble = draw(crossover_plot(results.crossovers), folder.path(), "crossover");
  if (!trouble.empty()) say(trouble);
  const std::vector<Claim> claims = claims_of(results);
  folder.write_claims(claims);
  finish_manifest(manifest);
  folder.write_manifest(manifest);
  outcome.exit_code = exit_code(claims) == 0 ? exit_agrees : exit_disagrees;
  picture_missing(outcome, trouble);
  say("\nTargets\n\n" + to_text(std::span<const Claim>(claims)));
  if (options.json) tell("{}\n", json_text(nlohmann::json{{"claims", claims}, {"manifest", manifest}}, 2));
  say(fmt::format("{}Written to {}.", options.quick ? "This was a quick run. " : "", folder.path().string()));
}

}  // namespace

void add_validate_solvers(CLI::App& validate_verb, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  auto* verb = validate_verb.add_subcommand(
      "solvers", "Linear systems: backward errors at all scales, factors that follow edits, and where implicit pays.");
  verb->add_option("--only", options->only, "of accuracy, edits, updates, crossover, steps [all]");
  verb->add_flag("--quick", options->quick, "smaller bodies, one size, fewer repetitions");
  verb->add_option("--out", options->out, "folder to write to, new or empty [dartboard-results/solvers-TIME]");
  verb->add_option("--seed", options->seed, "of the order of the timed tasks [1]");
  verb->add_flag("--json", options->json,
                 "print claims and manifest as JSON on standard output, the rest on standard error");
  verb->callback([options, &outcome] { validate(*options, outcome); });
}

}  // namespace dartboard
