#include "benchmarks/studies/extremes/extremes_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <utility>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/processes.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/extremes/extremes_figures.h"
#include "benchmarks/studies/extremes/extremes_report.h"
#include "core/meshes/mesh_io.h"
#include "core/plain/error.h"
#include "core/time/integrators.h"
#include "validation/cgal/delaunay_ball.h"

namespace dartboard {
namespace {

using Json = nlohmann::ordered_json;

constexpr unsigned hang_seconds = 20;  // of one run

// Studies measured in addition to the matrix, and requested by name as its axes are.
constexpr std::array studies{
    ExtremeAxis{"limits", "longest stable steps compared with theory"},
    ExtremeAxis{"maps", "stability over step and damping ratio"},
    ExtremeAxis{"amplification", "amplitude and phase of a step compared with closed forms"},
    ExtremeAxis{"detection", "unstable steps: predicted, and how soon they are detected"},
    ExtremeAxis{"rounding", "energy over 10^7 steps, motion in tiny steps"},
};

/// Runs all cases of an axis in child processes: after one that ended the process, the next goes on behind it.
void run_axis(std::string_view axis, std::span<const ExtremeCase> cases, bool quick, const std::string& folder,
              StudyLog& log, std::vector<Json>& all) {
  std::size_t ended = 0;
  const auto end = [&](Json cell) {
    all.push_back(std::move(cell));
    ++ended;
    log.sample(all.back(), "extremes.jsonl", folder);
    log.advance(axis);
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

/// The pictures of the results.
std::vector<Picture> pictures_of(const ExtremesResults& results) {
  std::vector<Picture> pictures;
  if (!results.maps.empty()) pictures.push_back({"maps", maps_figure(results.maps)});
  if (!results.amplification.empty())
    pictures.push_back({"amplification", amplification_figure(results.amplification)});
  if (!results.rounding.empty()) pictures.push_back({"rounding", rounding_figure(results.rounding)});
  return pictures;
}

}  // namespace

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

namespace {

ExtremesResults measure(const ExtremesPlan& plan, StudyLog& log) {
  ExtremesResults results;
  const auto made = [&](std::string_view study) {
    Report part;
    for (NamedTable& t : tables_of(results))
      if (t.study == study) part.tables.push_back(std::move(t));
    part.silent = !plan.shows_tables && study != "matrix";
    log.finished(part, plan.folder);
  };
  const bool quick = plan.quick;
  const auto wants = [&plan](std::string_view study) { return plan.axis.empty() || plan.axis == study; };
  const auto begin = [&](const ExtremeAxis& study) {
    if (wants(study.name)) log.say(fmt::format("extremes: {}", study.what));
    return wants(study.name);
  };
  if (begin(studies[0])) {
    results.limits = measure_stability_limits(quick);
    const auto mesh = read_mesh(source_folder() / "benchmarks/meshes/liver564.mesh").mesh;
    results.meshes = mesh_bodies("liver564", mesh, 200, 1);
    for (MeshBody& body : mesh_bodies("delaunay-250", delaunay_ball(250, 2), 200, 2))
      results.meshes.push_back(std::move(body));
    for (StabilityLimit& limit : measure_mesh_limits(results.meshes, quick)) results.limits.push_back(std::move(limit));
    made("limits");
  }
  if (begin(studies[1])) {
    for (const IntegratorEntry& entry : integrators())
      if (const Scheme& scheme = entry.make()->scheme(); !scheme.implicit)
        results.maps.push_back(measure_stability_map(entry, map_plan(scheme, quick)));
    made("maps");
  }
  if (begin(studies[2])) {
    results.amplification = measure_amplification(amplification_steps(quick ? 4 : 12));
    made("amplification");
  }
  if (begin(studies[3])) {
    results.detections = measure_detection(quick);
    made("detection");
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
    made("rounding");
  }
  std::vector<std::pair<std::string_view, std::vector<ExtremeCase>>> matrix;
  std::size_t runs = 0;
  for (const ExtremeAxis& axis : extreme_axes()) {
    if (!wants(axis.name)) continue;
    matrix.emplace_back(axis.name, extreme_cases(axis.name, quick));
    runs += matrix.back().second.size();
  }
  if (runs == 0) return results;
  log.begin("extremes: runs of the matrix", runs);
  for (const auto& [axis, cases] : matrix) run_axis(axis, cases, quick, plan.folder, log, results.cells);
  made("matrix");
  return results;
}

}  // namespace

std::string known_extremes() {
  std::vector<std::string_view> known;
  for (const ExtremeAxis& axis : extreme_axes()) known.push_back(axis.name);
  for (const ExtremeAxis& study : studies) known.push_back(study.name);
  return fmt::format("{}", fmt::join(known, ", "));
}

Report extremes_study(const ExtremesPlan& plan, StudyLog& log) {
  const auto is_asked_for = [&plan](const ExtremeAxis& axis) { return axis.name == plan.axis; };
  if (!plan.axis.empty() && std::ranges::none_of(studies, is_asked_for) &&
      std::ranges::none_of(extreme_axes(), is_asked_for))
    throw InputError(fmt::format("there is no axis '{}'; there are {}", plan.axis, known_extremes()));
  const ExtremesResults results = measure(plan, log);
  Report report{.claims = claims_of(results), .pictures = pictures_of(results), .numbers = to_json(results)};
  for (const auto& cells : {forbidden_cells(results), nameless_cells(results)})
    for (const Json& cell : cells) report.opening += json_text(cell) + "\n";
  Json rest = report.numbers;
  rest.erase("matrix");  // it is in extremes.jsonl
  report.data_files = {{"measurements.json", std::move(rest)}};
  return report;
}

}  // namespace dartboard
