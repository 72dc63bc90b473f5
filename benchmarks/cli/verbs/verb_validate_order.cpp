#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/manifest.h"
#include "benchmarks/harness/progress.h"
#include "benchmarks/harness/run_folder.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/order/order_report.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

struct Options {
  std::vector<std::string> integrators;
  std::string out;
  bool json = false, quick = false;
};

constexpr double quick_error = 0.05;  // upper end of the window of a quick run

std::vector<const IntegratorEntry*> wanted(const Options& options) {
  for (const std::string& name : options.integrators) (void)make_integrator(name);  // throws for one there is not
  std::vector<const IntegratorEntry*> entries;
  for (const IntegratorEntry& entry : integrators())
    if (options.integrators.empty() ||
        std::find(options.integrators.begin(), options.integrators.end(), entry.name) != options.integrators.end())
      entries.push_back(&entry);
  return entries;
}

OrderResults run(const Options& options) {
  OrderResults results;
  const auto entries = wanted(options);
  Progress progress("validate order", std::size(order_cases) * (entries.size() + 1) + entries.size() + 2, options.json);
  OrderOptions order;
  if (options.quick) order.most_error = quick_error;  // methods of order 1 get there two halvings earlier
  for (const OrderCase which : order_cases) {
    const OrderStage stage = order_stage(which);
    results.references.push_back({which, stage.certified});
    progress.advance(fmt::format("{}: reference", name(which)));
    for (const IntegratorEntry* entry : entries) {
      results.studies.push_back(study_order(stage, *entry, order));
      progress.advance(fmt::format("{}: {}", name(which), entry->name));
    }
    if (which == OrderCase::undamped) results.force = compare_forces_with_energy(stage.scene);
    if (which == OrderCase::aligned_cut || which == OrderCase::unaligned_cut) {
      const PreparedScene& scene = stage.scene;
      for (const CutJump& jump : cut_jumps(scene, *make_integrator("blanes-moan-4"), 0.5 / scene.fastest_rate))
        results.jumps.push_back(jump);
    }
  }
  for (const IntegratorEntry* entry : entries) {
    if (entry->make()->scheme().amplification == nullptr)
      results.no_discrete.emplace_back(entry->name);
    else
      for (const double zeta : {0.0, 1e-5})
        results.discrete.push_back(compare_with_discrete_map(*entry, zeta, options.quick ? 10000 : 100000));
    progress.advance(fmt::format("discrete map: {}", entry->name));
  }
  results.drift = measure_energy_drift(options.quick ? 1000 : 10000, 20.0);
  progress.advance("energy-momentum at large steps");
  results.factor = compare_kept_factor(100, std::filesystem::path(DARTBOARD_SOURCE_DIR) / "benchmarks" / "meshes");
  progress.advance("a factor that is kept");
  return results;
}

void validate(const Options& options, Outcome& outcome) {
  std::optional<RunFolder> folder;
  nlohmann::json manifest;
  if (!options.out.empty()) {
    folder.emplace(options.out);
    RunFacts facts;
    facts.command_line = {outcome.command_line};
    manifest = begin_manifest(facts);
    folder->write_manifest(manifest);
  }
  const OrderResults results = run(options);
  const std::vector<Claim> claims = claims_of(results);
  outcome.exit_code = exit_code(claims) == 0 ? exit_agrees : exit_disagrees;
  if (folder) {
    folder->write_json("order.json", to_json(results, claims));
    folder->write_table("orders", "Observed orders", order_table(results));
    folder->write_table("references", "References, " + references_heading(results), oracle_table(results));
    folder->write_table("discrete", "Against the exact maps of the methods", discrete_table(results));
    folder->write_claims(claims);
    finish_manifest(manifest);
    folder->write_manifest(manifest);
  }
  if (options.json) {
    tell("{}\n", json_text(to_json(results, claims), 2));
    return;
  }
  tell("The references: a box of 3 x 3 x 3 cubes for 16.5 / omega_max, {}\n\n{}\n", references_heading(results),
       to_text(oracle_table(results)));
  tell(
      "Observed orders; ^ error above {:g}, ~ not within 0.1, _ near the floor of the reference, ! no result; over "
      "two\n"
      "halvings across the unaligned cut\n\n{}\n",
      options.quick ? quick_error : OrderOptions{}.most_error, to_text(order_table(results)));
  tell("Against the exact maps of the methods\n\n{}\n", to_text(discrete_table(results)));
  tell("{}", to_text(std::span<const Claim>(claims)));
}

}  // namespace

void add_validate_order(CLI::App& validate_verb, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  auto* verb = validate_verb.add_subcommand(
      "order", "Observed orders of the time integrators, against certified references and exact discrete maps.");
  verb->add_option("--integrator", options->integrators, "only these [all]");
  verb->add_option("--out", options->out, "folder for the report, new or empty [nothing is written]");
  verb->add_flag("--quick", options->quick, "fewer halvings and steps, a wider window of errors");
  verb->add_flag("--json", options->json, "print JSON");
  verb->callback([options, &outcome] { validate(*options, outcome); });
}

}  // namespace dartboard
