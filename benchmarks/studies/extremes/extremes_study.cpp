#include "benchmarks/studies/extremes/extremes_study.h"

#include <fmt/format.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/processes.h"
#include "benchmarks/harness/progress.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/extremes/extremes_figures.h"
#include "core/meshes/mesh_io.h"
#include "core/time/integrators.h"
#include "validation/cgal/delaunay_ball.h"

namespace dartboard {
namespace {

using Json = nlohmann::ordered_json;

constexpr unsigned hang_seconds = 20;  // of one run

constexpr std::array studies{
    ExtremeAxis{"limits", "longest stable steps beside theory"},
    ExtremeAxis{"maps", "stability over step and damping ratio"},
    ExtremeAxis{"amplification", "amplitude and phase of a step beside closed forms"},
    ExtremeAxis{"detection", "unstable steps: predicted, and how soon they are detected"},
    ExtremeAxis{"rounding", "energy over 10^7 steps, motion in tiny steps"},
};

/// All runs of an axis in child processes: after one that ended the process, the next goes on behind it.
void run_axis(std::string_view axis, std::span<const ExtremeCase> cases, bool quick, Progress& progress,
              std::vector<Json>& all) {
  std::size_t ended = 0;
  const auto end = [&](Json cell) {
    all.push_back(std::move(cell));
    ++ended;
    progress.advance(axis);
  };
  while (ended < cases.size()) {
    std::vector<std::string> arguments{"extremes", "--axis", std::string(axis), "--child-from", std::to_string(ended)};
    if (quick) arguments.emplace_back("--quick");
    std::string why = "the process ended";
    try {
      run_self(arguments, [&end](std::string_view line) {
        if (line.starts_with('{')) end(Json::parse(line));
      });
    } catch (const ProcessError& error) {
      why = error.what();
    }
    if (ended == cases.size()) break;
    const ExtremeCase& which = cases[ended];
    end(to_json({which.axis, which.scene, which.integrator, which.value, ExtremeOutcome::crash, {}, 0, {}, why}));
  }
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

}  // namespace

std::span<const ExtremeAxis> extremes_studies() { return studies; }

void run_extremes_child(std::string_view axis, bool quick, std::size_t from) {
  const std::vector<ExtremeCase> cases = extreme_cases(axis, quick);
  for (std::size_t k = from; k < cases.size(); ++k) {
    tell("{}\n", k);
    std::fflush(stdout);
    ::alarm(hang_seconds);  // ends the process: a hang is a crash
    tell("{}\n", json_text(to_json(cases[k].run())));
    std::fflush(stdout);
  }
}

ExtremesResults measure_extremes(const ExtremesPlan& plan, const StudyMade& made) {
  ExtremesResults results;
  const bool quick = plan.quick;
  const auto wants = [&plan](std::string_view study) { return plan.axis.empty() || plan.axis == study; };
  const auto begin = [&plan, &wants](const ExtremeAxis& study) {
    if (wants(study.name) && !plan.silent) tell(stderr, "extremes: {}\n", study.what);
    return wants(study.name);
  };
  if (begin(studies[0])) {
    results.limits = measure_stability_limits(quick);
    const auto mesh = read_mesh(std::filesystem::path(DARTBOARD_SOURCE_DIR) / "benchmarks/meshes/liver564.mesh").mesh;
    results.meshes = mesh_bodies("liver564", mesh, 200, 1);
    for (MeshBody& body : mesh_bodies("delaunay-250", delaunay_ball(250, 2), 200, 2))
      results.meshes.push_back(std::move(body));
    for (StabilityLimit& limit : measure_mesh_limits(results.meshes, quick)) results.limits.push_back(std::move(limit));
    made(results, "limits");
  }
  if (begin(studies[1])) {
    for (const IntegratorEntry& entry : integrators())
      if (const Scheme& scheme = entry.make()->scheme(); !scheme.implicit)
        results.maps.push_back(measure_stability_map(entry, map_plan(scheme, quick)));
    made(results, "maps");
  }
  if (begin(studies[2])) {
    results.amplification = measure_amplification(amplification_steps(quick ? 4 : 12));
    made(results, "amplification");
  }
  if (begin(studies[3])) {
    results.detections = measure_detection(quick);
    made(results, "detection");
  }
  if (begin(studies[4])) {
    constexpr std::array methods{"verlet", "verlet-compensated", "blanes-moan-4", "blanes-moan-4-compensated"};
    for (const std::string_view name : methods) {
      const std::uint64_t steps = quick                        ? 100'000
                                  : name.starts_with("verlet") ? 10'000'000
                                                               : 1'000'000;  // six stages to a step
      results.rounding.push_back(measure_rounding_growth(name, steps, quick ? 64 : 32));
    }
    for (const double h : {1e-18, 1e-17, 1e-16, 1e-15, 1e-14, 1e-13, 1e-12, 1e-10})
      for (const std::string_view name : methods) results.tiny.push_back(measure_tiny_steps(name, h, 1'000'000));
    made(results, "rounding");
  }
  std::vector<std::pair<std::string_view, std::vector<ExtremeCase>>> matrix;
  std::size_t runs = 0;
  for (const ExtremeAxis& axis : extreme_axes()) {
    if (!wants(axis.name)) continue;
    matrix.emplace_back(axis.name, extreme_cases(axis.name, quick));
    runs += matrix.back().second.size();
  }
  if (runs == 0) return results;
  {
    Progress progress("extremes: runs of the matrix", runs, plan.silent);
    for (const auto& [axis, cases] : matrix) run_axis(axis, cases, quick, progress, results.cells);
  }
  made(results, "matrix");
  return results;
}

std::vector<std::string> write_extremes(const ExtremesResults& results, const RunFolder& folder) {
  JsonLines matrix = folder.json_lines("extremes.jsonl");
  for (const Json& cell : results.cells) matrix.append(cell);
  for (const NamedTable& t : tables_of(results)) folder.write_table(t.name, t.heading, t.table);
  Json rest = to_json(results);
  rest.erase("matrix");
  folder.write_json("measurements.json", rest);
  folder.write_claims(claims_of(results));
  return draw_figures(results, folder);
}

}  // namespace dartboard
