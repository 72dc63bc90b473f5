#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>

#include "benchmarks/album.h"
#include "benchmarks/cli.h"
#include "benchmarks/clock.h"
#include "benchmarks/interrupt.h"
#include "benchmarks/json_text.h"
#include "benchmarks/manifest.h"
#include "benchmarks/progress.h"
#include "benchmarks/scene_names.h"
#include "benchmarks/settle_accuracy.h"
#include "benchmarks/simulation_json.h"
#include "benchmarks/table.h"
#include "benchmarks/tell.h"
#include "core/plain/counted.h"
#include "core/plain/error.h"
#include "core/scene/atomic_file.h"
#include "core/scene/scene_file.h"
#include "core/scene/scene_output.h"
#include "core/scene/scene_run.h"
#include "core/scene/scene_verdict.h"
#include "core/time/preflight.h"

namespace dartboard {
namespace {

struct Options {
  std::string scene, out;
  bool json = false, quick = false, picture = false;
  std::optional<std::uint64_t> steps, seed;

  std::optional<std::uint64_t> most_steps() const {
    if (steps) return steps;
    return quick ? std::optional<std::uint64_t>(100) : std::nullopt;
  }
};

class Watcher : public RunWatcher {
 public:
  Watcher(SceneOutput* output, Album* album, Progress& progress, std::uint64_t steps_per_report)
      : output_(output), album_(album), progress_(progress), steps_per_report_(steps_per_report) {}
  void frame(const Frame& frame) override {
    if (output_ != nullptr) output_->write(frame);
  }
  void diagnostics(const Diagnostics& diagnostics) override {
    if (output_ != nullptr) output_->write(diagnostics);
  }
  void probes(const ProbeRow& row) override {
    if (output_ != nullptr) output_->write(row);
  }
  bool interrupts() override { return Interrupt::asked(); }
  void stepped(const Simulation& simulation) override {
    if (album_ != nullptr) album_->stepped(simulation);
    if (simulation.steps_done() % steps_per_report_ == 0)
      progress_.advance(fmt::format("t = {:.4g} s, {} operations", simulation.time(), simulation.operations()));
  }

 private:
  SceneOutput* output_;
  Album* album_;
  Progress& progress_;
  std::uint64_t steps_per_report_;
};

/// Everything the summary says.
struct Report {
  const SceneFile& scene;
  const Simulation& simulation;
  const RunResult& result;
  std::optional<SettledAccuracy> settled;  // where the scene asks for an accuracy
  std::vector<ExpectedRow> expected;
  std::string unjudged;  // why there is no verdict; empty where there is one
  double wall_s, cpu_s;
  std::string folder;
  std::size_t frames;
  std::string picture;  // what became of it

  bool holds() const {
    return !result.divergence &&
           std::all_of(expected.begin(), expected.end(), [](const auto& row) { return row.holds; });
  }
  /// The step that the last state is of: after a divergence the one that the body has gone back to.
  std::uint64_t kept_step() const {
    return simulation.steps_done() - (result.divergence ? result.divergence->taken_back : 0);
  }
  /// What became of the mass beyond what removals took, relative to the mass at the start.
  double mass_drift() const {
    const SimulatedBody& body = simulation.body();
    return mass_unaccounted_for(result.first.mass + removed_at_start, body.removed_mass(), body.mass());
  }
  double removed_at_start = 0.0;
};

std::string drift_text(double drift) { return drift == 0.0 ? "0" : fmt::format("{:.2e}", drift); }

Table summary_of(const Report& r) {
  Table table({{"quantity", Align::left}, {"start", Align::right}, {"end", Align::right}});
  const Diagnostics &first = r.result.first, &last = r.result.last;
  const auto shown = [](double x) { return std::isfinite(x) ? fmt::format("{:.6g}", x) : "-"; };
  const auto row = [&](const std::string& what, double start, double end) {
    table.add_row({what, shown(start), shown(end)});
  };
  const auto counts = [&table](const char* what, std::size_t start, std::size_t end) {
    table.add_row({what, fmt::format("{}", start), fmt::format("{}", end)});
  };
  row("time [s]", first.time, last.time);
  counts("steps", 0, r.kept_step());
  counts("operations", first.operations, last.operations);
  counts("vertices", first.counts.vertices, last.counts.vertices);
  counts("edges", first.counts.edges, last.counts.edges);
  counts("faces", first.counts.faces, last.counts.faces);
  counts("cells", first.counts.cells, last.counts.cells);
  counts("components", first.counts.components, last.counts.components);
  row("mass [kg]", first.mass, last.mass);
  row("kinetic energy [J]", first.kinetic, last.kinetic);
  row("elastic energy [J]", first.elastic, last.elastic);
  row("gravitational energy [J]", first.gravitational, last.gravitational);
  const int dimension = r.simulation.dimension();
  row(fmt::format("boundary [{}]", boundary_unit(dimension)), first.boundary, last.boundary);
  row(fmt::format("largest stress [{}]", stress_unit(dimension)), first.largest_stress, last.largest_stress);
  return table;
}

void print(const Report& r) {
  tell("{}\n{}, {}, h = {:.6g} s\n\n{}\n", one_line(r.scene.name), r.simulation.body().map_name(), r.scene.integrator,
       r.scene.step, to_text(summary_of(r)));
  if (r.settled) {
    tell("{}\n", to_string(*r.settled));
    for (const std::string& omission : r.settled->omissions) tell("  {}\n", omission);
  }
  const auto steps = static_cast<double>(r.simulation.steps_done());
  const std::string pace = steps > 0 ? fmt::format(", {:.3g} microseconds per step", r.cpu_s / steps * 1e6) : "";
  tell("wall {:.3g} s, processor {:.3g} s{}, events and output included\n", r.wall_s, r.cpu_s, pace);
  if (r.simulation.body().removed_mass() > 0.0)
    tell("mass unaccounted for after removals: {} of the mass\n", drift_text(r.mass_drift()));
  const EventJumps& jumps = r.simulation.jumps();
  if (jumps.events > 0)
    tell(
        "largest jump at {} that {}: mass {}, momentum {}, kinetic and elastic energy {} "
        "(relative)\n",
        counted(jumps.events, "event"), jumps.events == 1 ? "dissociates" : "dissociate", drift_text(jumps.mass),
        drift_text(jumps.momentum), drift_text(jumps.energy));
  tell("hash of the last state {:016x}\n", r.simulation.body().state_hash());
  if (const auto& warning = r.simulation.step_warning())
    tell("warning: {}\n", to_string(*warning, r.scene.step, r.scene.integrator));
  if (const auto& warning = r.simulation.coordinate_warning()) tell("warning: {}\n", to_string(*warning));
  for (const StepResult& warning : r.simulation.warnings()) tell("warning: {}\n", explained(warning));
  for (const std::string& path : r.simulation.idle_events())
    tell("warning: the event at {} never did anything\n", path);
  if (r.result.divergence)
    tell("\nThe motion {}. The state of step {}, t = {:.6g} s is kept, and what was written until then.\n",
         to_string(*r.result.divergence), r.kept_step(), r.result.last.time);
  if (!r.expected.empty()) {
    Table table(
        {{"expected", Align::left}, {"by the scene", Align::right}, {"found", Align::right}, {"holds", Align::left}});
    for (const ExpectedRow& row : r.expected)
      table.add_row({row.what, row.expected, row.actual, row.holds ? "yes" : "NO"});
    tell("\n{}", to_text(table));
  }
  if (!r.unjudged.empty()) tell("\n{}\n", r.unjudged);
  if (!r.folder.empty())
    tell("\n{}, frames.pvd, diagnostics.csv{} written to {}.\n", counted(r.frames, "frame"),
         r.scene.probes.empty() ? "" : ", probes.csv", r.folder);
  if (!r.picture.empty()) tell("{}\n", r.picture);
}

nlohmann::ordered_json to_json(const Report& r) {
  nlohmann::ordered_json json{{"scene", r.scene.name},
                              {"map", r.simulation.body().map_name()},
                              {"integrator", r.scene.integrator},
                              {"holds", r.holds()},
                              {"steps", r.simulation.steps_done()},
                              {"first", to_json(r.result.first)},
                              {"last", to_json(r.result.last)},
                              {"hash", fmt::format("{:016x}", r.simulation.body().state_hash())},
                              {"wall_s", r.wall_s},
                              {"cpu_s", r.cpu_s},
                              {"mass_drift", r.mass_drift()},
                              {"jumps", to_json(r.simulation.jumps())}};
  if (const auto& d = r.result.divergence)
    json["divergence"] = {{"step", d->step},
                          {"time", d->time},
                          {"quantity", d->quantity},
                          {"vertex", d->vertex},
                          {"taken_back", d->taken_back},
                          {"kept_step", r.kept_step()},
                          {"kept_time", r.result.last.time},
                          {"value", fmt::format("{:.17g}", d->value)}};
  if (const auto& warning = r.simulation.step_warning())
    json["warning"] = to_string(*warning, r.scene.step, r.scene.integrator);
  if (const auto& warning = r.simulation.coordinate_warning()) json["coordinate_warning"] = to_string(*warning);
  json["warnings"] = nlohmann::ordered_json::array();
  for (const StepResult& w : r.simulation.warnings()) json["warnings"].push_back(explained(w));
  json["idle_events"] = r.simulation.idle_events();
  json["expected"] = nlohmann::ordered_json::array();
  for (const ExpectedRow& row : r.expected)
    json["expected"].push_back(
        {{"what", row.what}, {"expected", row.expected}, {"actual", row.actual}, {"holds", row.holds}});
  if (r.settled) json["settled"] = nlohmann::json(*r.settled);
  if (!r.unjudged.empty()) json["unjudged"] = r.unjudged;
  json["interrupted"] = r.result.interrupted;
  if (!r.folder.empty()) json["folder"] = r.folder;
  return json;
}

/// What the run was made of, beside its results.
nlohmann::json manifest_of(const SceneFile& scene, const Options& options, const Outcome& outcome) {
  RunFacts facts;
  facts.command_line = {outcome.command_line};
  if (options.seed) facts.seeds = {{"added to the seeds of random selections", *options.seed}};
  facts.input_files = {scene_file(options.scene)};
  if (const auto* mesh = std::get_if<std::filesystem::path>(&scene.body.mesh)) facts.input_files.push_back(*mesh);
  return begin_manifest(facts);
}

void simulate(const Options& options, Outcome& outcome) {
  SceneFile scene = read_scene(scene_file(options.scene));
  const bool other_cells = options.seed && reseed(scene, *options.seed);
  const std::optional<SettledAccuracy> settled = settle_accuracy(scene, thread_cpu_ns);
  Simulation simulation(scene);
  simulation.watch_events(true);
  // the folder comes last: a scene that is wrong leaves nothing behind
  std::optional<SceneOutput> output;
  nlohmann::json manifest;
  const auto write_manifest = [&] {
    if (output) write_whole(output->folder() / "manifest.json", json_text(manifest, 2) + "\n");
  };
  if (!options.out.empty()) {
    output.emplace(options.out, scene.probes, simulation.dimension());
    manifest = manifest_of(scene, options, outcome);
    if (settled) manifest["settled"] = *settled;
    write_manifest();
  }

  const std::uint64_t steps = std::min(simulation.step_count(), options.most_steps().value_or(simulation.step_count()));
  const std::uint64_t steps_per_report = std::max<std::uint64_t>(1, steps / 100);
  const double removed_at_start = simulation.body().removed_mass();
  std::optional<Album> album;
  if (options.picture) album.emplace(simulation, steps);
  RunResult result;
  // of the whole process: long factorisations have a thread of their own
  const auto wall = steady_wall_ns(), cpu = process_cpu_ns();
  {
    Progress progress("simulate", steps / steps_per_report, options.json);
    Watcher watcher(output ? &*output : nullptr, album ? &*album : nullptr, progress, steps_per_report);
    const Interrupt interrupt;
    result = run_scene(simulation, scene.output, watcher, options.most_steps());
  }
  Report report{.scene = scene,
                .simulation = simulation,
                .result = result,
                .settled = settled,
                .expected = {},
                .unjudged = {},
                .wall_s = static_cast<double>(steady_wall_ns() - wall) * 1e-9,
                .cpu_s = static_cast<double>(process_cpu_ns() - cpu) * 1e-9,
                .folder = output ? output->folder().string() : "",
                .frames = output ? output->frame_count() : 0,
                .picture = "",
                .removed_at_start = removed_at_start};
  if (result.interrupted)
    report.unjudged =
        fmt::format("Interrupted after {}, t = {:.6g} s: what the scene expects of its end is not judged.",
                    counted(simulation.steps_done(), "step"), simulation.time());
  else if (simulation.steps_done() < simulation.step_count() && !result.divergence)
    report.unjudged = "The run was cut short: what the scene expects of its end is not judged.";
  else if (other_cells)
    report.unjudged = "Other cells were drawn than the scene's own: what it expects is not judged.";
  else if (!result.divergence)
    report.expected = compare_with_expectation(scene, simulation, result);

  outcome.exit_code = result.interrupted ? Interrupt::exit_code() : report.holds() ? exit_agrees : exit_disagrees;
  if (album) {
    album->ended(simulation);
    const std::string trouble = draw_bodies(album->panels(), scene.name, output->folder(), "picture");
    report.picture = trouble.empty() ? "picture.png and picture.svg drawn there." : trouble;
    picture_missing(outcome, trouble);
  }
  if (output) {
    write_whole(output->folder() / "summary.json", json_text(to_json(report), 2) + "\n");
    finish_manifest(manifest);
    write_manifest();
  }
  if (options.json) {
    tell("{}\n", json_text(to_json(report), 2));
    if (outcome.exit_code == exit_io) tell(stderr, "{}\n", report.picture);
  } else {
    print(report);
  }
}

}  // namespace

void add_simulate(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand("simulate", "Run a scene: a body that moves, and is cut, torn or eroded meanwhile.");
  verb->add_option("SCENE", options->scene, "a scene file (dartboard scene --keys), or the name of one of the gallery")
      ->required();
  auto* out =
      verb->add_option("--out", options->out, "folder for frames and diagnostics, new or empty [nothing is written]");
  verb->add_flag("--picture", options->picture, "draw the body at four times of the run, into that folder")->needs(out);
  verb->add_option("--steps", options->steps, "stop after so many steps");
  verb->add_flag("--quick", options->quick, "stop after 100 steps");
  verb->add_option("--seed", options->seed, "added to the seeds of random selections [0]");
  verb->add_flag("--json", options->json, "print JSON");
  verb->callback([options, &outcome] { simulate(*options, outcome); });
}

}  // namespace dartboard
