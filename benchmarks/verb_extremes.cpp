#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/cli.h"
#include "benchmarks/extremes_figures.h"
#include "benchmarks/extremes_report.h"
#include "benchmarks/manifest.h"
#include "benchmarks/processes.h"
#include "benchmarks/run_folder.h"
#include "core/meshes/mesh_io.h"
#include "core/plain/error.h"
#include "core/time/integrators.h"
#include "validation/delaunay_ball.h"

namespace dartboard {
namespace {

using Json = nlohmann::ordered_json;

constexpr unsigned hang_seconds = 20;  // of one run

/// What is measured beside the matrix, and asked for as its axes are.
constexpr std::array studies{
    ExtremeAxis{"limits", "longest stable steps beside theory"},
    ExtremeAxis{"maps", "stability over step and damping ratio"},
    ExtremeAxis{"amplification", "amplitude and phase of a step beside closed forms"},
    ExtremeAxis{"detection", "unstable steps: predicted, and how soon they are detected"},
    ExtremeAxis{"rounding", "energy over 10^7 steps, motion in tiny steps"},
};

struct Options {
  std::string axis, out;
  bool quick = false, json = false;
  std::optional<std::size_t> child_from;  // of a child: the first run to make
};

/// The runs of an axis from a number on, a line before each and its result after it.
void run_child(const Options& options) {
  const std::vector<ExtremeCase> cases = extreme_cases(options.axis, options.quick);
  for (std::size_t k = *options.child_from; k < cases.size(); ++k) {
    fmt::print("{}\n", k);
    std::fflush(stdout);
    ::alarm(hang_seconds);  // ends the process: a hang is a crash
    fmt::print("{}\n", to_json(cases[k].run()).dump());
    std::fflush(stdout);
  }
}

/// All runs of an axis in child processes: after one that ended the process, the next goes on behind it.
std::vector<Json> run_axis(std::string_view axis, bool quick) {
  const std::vector<ExtremeCase> cases = extreme_cases(axis, quick);
  std::vector<Json> cells;
  while (cells.size() < cases.size()) {
    std::vector<std::string> arguments{"extremes", "--axis", std::string(axis), "--child-from",
                                       std::to_string(cells.size())};
    if (quick) arguments.emplace_back("--quick");
    std::string why = "the process ended";
    try {
      run_self(arguments, [&cells](std::string_view line) {
        if (line.starts_with('{')) cells.push_back(Json::parse(line));
      });
    } catch (const ProcessError& error) {
      why = error.what();
    }
    if (cells.size() == cases.size()) break;
    const ExtremeCase& which = cases[cells.size()];
    cells.push_back(
        to_json({which.axis, which.scene, which.integrator, which.value, ExtremeOutcome::crash, {}, 0, {}, why}));
  }
  return cells;
}

/// The names that --axis takes.
std::string known_axes() {
  std::string known;
  for (const ExtremeAxis& axis : extreme_axes()) known += fmt::format("{}, ", axis.name);
  for (const ExtremeAxis& study : studies)
    known += fmt::format("{}{}", study.name, &study == &studies.back() ? "" : ", ");
  return known;
}

bool wants(const Options& options, std::string_view study) { return options.axis.empty() || options.axis == study; }

/// Calls `made` after each study, which may take minutes.
template <class Made>
ExtremesResults run(const Options& options, const Made& made) {
  ExtremesResults results;
  const bool quick = options.quick;
  if (wants(options, "limits")) {
    results.limits = measure_stability_limits(quick);
    const auto mesh = read_mesh(std::filesystem::path(DARTBOARD_SOURCE_DIR) / "benchmarks/meshes/liver564.mesh").mesh;
    results.meshes = mesh_bodies("liver564", mesh, 200, 1);
    for (MeshBody& body : mesh_bodies("delaunay-250", delaunay_ball(250, 2), 200, 2))
      results.meshes.push_back(std::move(body));
    for (StabilityLimit& limit : measure_mesh_limits(results.meshes, quick)) results.limits.push_back(std::move(limit));
    made(results, "limits");
  }
  if (wants(options, "maps")) {
    for (const IntegratorEntry& entry : integrators())
      if (const Scheme& scheme = entry.make()->scheme(); !scheme.implicit)
        results.maps.push_back(measure_stability_map(entry, map_plan(scheme, quick)));
    made(results, "maps");
  }
  if (wants(options, "amplification")) {
    results.amplification = measure_amplification(amplification_steps(quick ? 4 : 12));
    made(results, "amplification");
  }
  if (wants(options, "detection")) {
    results.detections = measure_detection(quick);
    made(results, "detection");
  }
  if (wants(options, "rounding")) {
    for (const char* name : {"verlet", "verlet-compensated", "blanes-moan-4", "blanes-moan-4-compensated"})
      // six stages to a step: a tenth of the steps
      results.rounding.push_back(measure_rounding_growth(name,
                                                         quick                                          ? 100000
                                                         : std::string_view(name).starts_with("verlet") ? 10000000
                                                                                                        : 1000000,
                                                         quick ? 64 : 32));
    for (const double h : {1e-18, 1e-17, 1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-10})
      for (const char* name : {"verlet", "verlet-compensated", "blanes-moan-4", "blanes-moan-4-compensated"})
        results.tiny.push_back(measure_tiny_steps(name, h, 1000000));
    made(results, "rounding");
  }
  for (const ExtremeAxis& axis : extreme_axes())
    if (wants(options, axis.name)) {
      const std::vector<Json> found = run_axis(axis.name, quick);
      results.cells.insert(results.cells.end(), found.begin(), found.end());
    }
  if (!results.cells.empty()) made(results, "matrix");
  return results;
}

/// The pictures of what was measured; what is missing is told.
std::vector<std::string> draw_figures(const ExtremesResults& results, const RunFolder& folder) {
  std::vector<std::string> troubles;
  if (!results.maps.empty()) troubles.push_back(draw(maps_figure(results.maps), folder.path(), "maps"));
  if (!results.amplification.empty())
    troubles.push_back(draw(amplification_figure(results.amplification), folder.path(), "amplification"));
  if (!results.rounding.empty()) troubles.push_back(draw(rounding_figure(results.rounding), folder.path(), "rounding"));
  std::erase(troubles, "");
  return troubles;
}

void extremes(const Options& options, Outcome& outcome) {
  if (options.child_from) {
    run_child(options);
    return;
  }
  const auto is_asked_for = [&options](const ExtremeAxis& axis) { return axis.name == options.axis; };
  if (!options.axis.empty() && std::ranges::none_of(studies, is_asked_for) &&
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
  const ExtremesResults results = run(options, [&](const ExtremesResults& so_far, std::string_view study) {
    for (const NamedTable& t : tables_of(so_far))
      if (!options.json && t.study == study) fmt::print("{}\n\n{}\n", t.heading, to_text(t.table));
    std::fflush(stdout);
  });
  const std::vector<Claim> claims = claims_of(results);
  outcome.exit_code = exit_code(claims) == 0 ? exit_agrees : exit_disagrees;

  if (folder) {
    JsonLines matrix = folder->json_lines("extremes.jsonl");
    for (const Json& cell : results.cells) matrix.append(cell);
    for (const NamedTable& t : tables_of(results)) folder->write_table(t.name, t.heading, t.table);
    Json rest = to_json(results);
    rest.erase("matrix");
    folder->write_json("measurements.json", rest);
    folder->write_claims(claims);
    for (const std::string& trouble : draw_figures(results, *folder)) fmt::print(stderr, "{}\n", trouble);
    finish_manifest(manifest);
    folder->write_manifest(manifest);
  }
  if (options.json) {
    fmt::print("{}\n", to_json(results).dump(2));
    return;
  }
  for (const Json& cell : forbidden_cells(results)) fmt::print("{}\n", cell.dump());
  fmt::print("{}", to_text(std::span<const Claim>(claims)));
  if (folder) fmt::print("Written to {}.\n", folder->path().string());
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
