#include "benchmarks/studies/extremes/extremes_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/processes.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/extremes/extremes_figures.h"
#include "benchmarks/studies/extremes/extremes_report.h"
#include "benchmarks/studies/extremes/scene_extremes_report.h"
#include "core/meshes/mesh_io.h"
#include "core/plain/error.h"
#include "core/time/integrators.h"
#include "validation/cgal/delaunay_ball.h"
#include "validation/extremes/scene_extremes.h"
#include "validation/scenes/scene_of_file.h"

namespace dartboard {
namespace {

using Json = nlohmann::ordered_json;

constexpr unsigned hang_seconds = 20, scene_hang_seconds = 120;  // of one run

TradeoffScene scene_named(const std::string& scene) {
  return find_scene(scene, source_folder() / "benchmarks" / "meshes");
}

// Studies measured in addition to the matrix, and requested by name as its axes are.
constexpr std::array studies{
    ExtremeAxis{"limits", "longest stable steps compared with theory"},
    ExtremeAxis{"maps", "stability over step and damping ratio"},
    ExtremeAxis{"amplification", "amplitude and phase of a step compared with closed forms"},
    ExtremeAxis{"detection", "unstable steps: predicted, and how soon they are detected"},
    ExtremeAxis{"rounding", "energy over 10^7 steps, motion in tiny steps"},
};

/// The runs of an axis, or of one scene.
std::vector<ExtremeCase> cases_of(const ExtremesPlan& plan) {
  if (plan.scenes.empty()) return extreme_cases(plan.axis, plan.quick);
  return scene_extreme_cases(std::make_shared<const TradeoffScene>(scene_named(plan.scenes.front())), plan.quick);
}

/// Makes all runs of an axis or a scene in child processes: after one that ended the process, the next goes on behind
/// it.
void run_all(const ExtremesPlan& plan, std::span<const ExtremeCase> cases, StudyLog& log, std::vector<Json>& all) {
  std::size_t ended = 0;
  const auto end = [&](Json cell) {
    all.push_back(std::move(cell));
    ++ended;
    log.sample(all.back(), "extremes.jsonl", plan.folder);
    log.advance(plan.scenes.empty() ? plan.axis : all.back().at("integrator").get<std::string>());
  };
  while (ended < cases.size()) {
    std::vector<std::string> arguments{"extremes"};
    for (const std::string& scene : plan.scenes) arguments.push_back(scene);
    if (plan.scenes.empty()) arguments.insert(arguments.end(), {"--axis", plan.axis});
    arguments.insert(arguments.end(), {"--child-from", std::to_string(ended)});
    if (plan.quick) arguments.emplace_back("--quick");
    std::string why = "the process ended";
    try {
      log.run(arguments, [&end](std::string_view line) {
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

void run_extremes_child(const ExtremesPlan& plan, std::size_t from) {
  const std::vector<ExtremeCase> cases = cases_of(plan);
  for (std::size_t k = from; k < cases.size(); ++k) {
    tell("{}\n", k);
    std::fflush(stdout);
    ::alarm(plan.scenes.empty() ? hang_seconds : scene_hang_seconds);  // ends the process: a hang is a crash
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
    const auto mesh = read_mesh(source_folder() / "benchmarks/meshes/liver564.mesh");
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
  ExtremesPlan one = plan;
  for (const auto& [axis, cases] : matrix) {
    one.axis = axis;
    run_all(one, cases, log, results.cells);
  }
  made("matrix");
  return results;
}

/// The lines of a report that are shown first: the runs that may not be.
std::string opening_of(const ExtremesResults& results) {
  std::string lines;
  for (const auto& cells : {forbidden_cells(results), nameless_cells(results)})
    for (const Json& cell : cells) lines += json_text(cell) + "\n";
  return lines;
}

Report scene_extremes_study(const ExtremesPlan& plan, StudyLog& log) {
  std::vector<SceneCells> found;
  ExtremesResults all;
  for (const std::string& name : plan.scenes) {
    ExtremesPlan one = plan;
    one.scenes = {name};
    SceneCells scene{.name = std::filesystem::path(name).stem().string(), .beyond_references = {}};
    try {
      const auto ready = std::make_shared<const TradeoffScene>(scene_named(name));
      for (const std::string& omission : ready->omissions) log.say(omission);
      scene.beyond_references = ready->beyond_references;
      const std::vector<ExtremeCase> cases = scene_extreme_cases(ready, plan.quick);
      log.begin("extremes of " + scene.name, cases.size());
      run_all(one, cases, log, scene.cells);
    } catch (const SolverError& error) {  // the motion up to an event cannot be found
      scene.failure = error.what();
      log.say(scene.failure);
    }
    all.cells.insert(all.cells.end(), scene.cells.begin(), scene.cells.end());
    found.push_back(std::move(scene));
  }
  Report report{
      .opening = opening_of(all),
      .tables = tables_of(found),
      .claims = claims_of(found),
      .limits = {
          "Runs are judged by no more than that they survive where no witness supports their scene: contact, springs "
          "that are no edges, membranes, elements that are refined, axes that are held, and, for schemes with dense "
          "factors, more than 200 vertices."}};
  report.numbers = {{"claims", nlohmann::json(report.claims)}, {"runs", all.cells}};
  return report;
}

}  // namespace

std::string known_extremes() {
  std::vector<std::string_view> known;
  for (const ExtremeAxis& axis : extreme_axes()) known.push_back(axis.name);
  for (const ExtremeAxis& study : studies) known.push_back(study.name);
  return fmt::format("{}", fmt::join(known, ", "));
}

Report extremes_study(const ExtremesPlan& plan, StudyLog& log) {
  if (!plan.scenes.empty()) return scene_extremes_study(plan, log);
  const auto is_asked_for = [&plan](const ExtremeAxis& axis) { return axis.name == plan.axis; };
  if (!plan.axis.empty() && std::ranges::none_of(studies, is_asked_for) &&
      std::ranges::none_of(extreme_axes(), is_asked_for))
    throw InputError(fmt::format("there is no axis '{}'; there are {}", plan.axis, known_extremes()));
  const ExtremesResults results = measure(plan, log);
  Report report{
      .opening = opening_of(results),
      .claims = claims_of(results),
      .limits = {"The steps of bodies whose viscosity is not in proportion to their mass are not judged by their "
                 "scheme.",
                 "Reported stable steps are far below the true limit for symplectic Euler with strong damping, "
                 "whose dampers are swept in one direction, and, where dampers are not proportional to springs, for "
                 "explicit Euler, Dormand-Prince and Blanes-Moan.",
                 "Close to the limit of stability it takes long until a run has gathered the energy by which it "
                 "is stopped."},
      .pictures = pictures_of(results),
      .numbers = to_json(results)};
  Json rest = report.numbers;
  rest.erase("matrix");  // it is in extremes.jsonl
  report.data_files = {{"measurements.json", std::move(rest)}};
  return report;
}

}  // namespace dartboard
