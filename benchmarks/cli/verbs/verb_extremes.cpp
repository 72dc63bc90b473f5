#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/manifest.h"
#include "benchmarks/harness/run_folder.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/extremes/extremes_study.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string axis, out;
  bool quick = false, json = false;
  std::optional<std::size_t> child_from;  // of a child: the first run to make
};

/// The names that --axis takes.
std::string known_axes() {
  std::string known;
  for (const ExtremeAxis& axis : extreme_axes()) known += fmt::format("{}, ", axis.name);
  for (const ExtremeAxis& study : extremes_studies())
    known += fmt::format("{}{}", study.name, &study == &extremes_studies().back() ? "" : ", ");
  return known;
}

void extremes(const Options& options, Outcome& outcome) {
  if (options.child_from) {
    run_extremes_child(options.axis, options.quick, *options.child_from);
    return;
  }
  const auto is_asked_for = [&options](const ExtremeAxis& axis) { return axis.name == options.axis; };
  if (!options.axis.empty() && std::ranges::none_of(extremes_studies(), is_asked_for) &&
      std::ranges::none_of(extreme_axes(), is_asked_for))
    throw InputError(fmt::format("there is no axis '{}'; there are {}", options.axis, known_axes()));
  std::optional<RunFolder> folder;
  nlohmann::json manifest;
  if (!options.out.empty()) {
    folder.emplace(options.out);
    RunFacts facts;
    facts.command_line = {outcome.command_line};
    manifest = begin_manifest(facts);
    manifest["quick"] = options.quick;
    folder->write_manifest(manifest);
  }
  const ExtremesResults results = measure_extremes({options.axis, options.quick, options.json},
                                                   [&](const ExtremesResults& so_far, std::string_view study) {
                                                     for (const NamedTable& t : tables_of(so_far))
                                                       if (!options.json && t.study == study)
                                                         tell("{}\n\n{}\n", t.heading, to_text(t.table));
                                                     std::fflush(stdout);
                                                   });
  const std::vector<Claim> claims = claims_of(results);
  outcome.exit_code = exit_code(claims) == 0 ? exit_agrees : exit_disagrees;

  if (folder) {
    for (const std::string& trouble : write_extremes(results, *folder)) {
      tell(stderr, "{}\n", trouble);
      picture_missing(outcome, trouble);
    }
    finish_manifest(manifest);
    folder->write_manifest(manifest);
  }
  if (options.json) {
    tell("{}\n", json_text(to_json(results), 2));
    return;
  }
  for (const Json& cell : forbidden_cells(results)) tell("{}\n", json_text(cell));
  for (const Json& cell : nameless_cells(results)) tell("{}\n", json_text(cell));
  tell("{}", to_text(std::span<const Claim>(claims)));
  if (folder) tell("Written to {}.\n", folder->path().string());
}

}  // namespace

void add_extremes(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand(
      "extremes", "Run every integrator at the extremes: each run is right, warned of, or stopped with a diagnosis.");
  verb->add_option("--axis", options->axis, fmt::format("only this one of {} [all]", known_axes()));
  verb->add_flag("--quick", options->quick, "every third value, coarser maps, shorter runs");
  verb->add_flag("--json", options->json, "print JSON");
  verb->add_option("--out", options->out,
                   "folder for the matrix, tables, claims and pictures, new or empty [nothing is written]");
  verb->add_option("--child-from", options->child_from)->group("");  // hidden: the runs of one child process
  verb->callback([options, &outcome] { extremes(*options, outcome); });
}

}  // namespace dartboard
