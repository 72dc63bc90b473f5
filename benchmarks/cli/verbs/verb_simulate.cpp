#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "benchmarks/cli/interrupt.h"
#include "benchmarks/cli/scene_names.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/figures/album.h"
#include "benchmarks/figures/film.h"
#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/manifest.h"
#include "benchmarks/harness/progress.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/scenes/simulate_report.h"
#include "core/plain/counted.h"
#include "core/plain/error.h"
#include "core/plain/folder_claim.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/output/atomic_file.h"
#include "core/scene/output/scene_output.h"
#include "core/scene/restart/checkpoint.h"
#include "core/scene/run/scene_run.h"
#include "core/scene/run/scene_verdict.h"
#include "core/scene/run/scene_warnings.h"
#include "core/time/integrators.h"
#include "validation/recommend/settle_accuracy.h"

namespace dartboard {
namespace {

struct SimulateOptions {
  std::string scene, out, continued;
  bool json = false, quick = false, picture = false, film = false;
  std::optional<std::uint64_t> steps, seed;

  std::optional<std::uint64_t> most_steps() const {
    if (steps) return steps;
    return quick ? std::optional<std::uint64_t>(100) : std::nullopt;
  }
};

class Watcher : public RunWatcher {
 public:
  /// `notes` are stored in checkpoints.
  Watcher(const SceneFile& scene, std::string notes, SceneOutput* output, Album* album, Film* film, Progress& progress,
          std::uint64_t steps_per_report)
      : scene_(scene),
        notes_(std::move(notes)),
        output_(output),
        album_(album),
        film_(film),
        progress_(progress),
        steps_per_report_(steps_per_report) {}
  void frame(const Frame& frame) override {
    if (output_ != nullptr) output_->write(frame);
  }
  void diagnostics(const Diagnostics& diagnostics) override {
    if (output_ != nullptr) output_->write(diagnostics);
  }
  void probes(const ProbeRow& row) override {
    if (output_ != nullptr) output_->write(row);
  }
  void checkpoint(const Simulation& simulation, const RunProgress& progress) override {
    if (output_ == nullptr) return;
    Checkpoint::write(output_->folder() / checkpoint_name, scene_, simulation, progress, output_->so_far(), notes_);
    left_after_ = simulation.steps_done();
  }
  bool interrupts() override { return Interrupt::asked(); }
  void stepped(const Simulation& simulation) override {
    if (album_ != nullptr) album_->stepped(simulation);
    if (film_ != nullptr) film_->stepped(simulation);
    if (simulation.steps_done() % steps_per_report_ == 0)
      progress_.advance(fmt::format("t = {:.4g} s, {} operations", simulation.time(), simulation.operations()));
  }

  /// The step of the last checkpoint written.
  const std::optional<std::uint64_t>& left_after() const { return left_after_; }

 private:
  const SceneFile& scene_;
  std::string notes_;
  SceneOutput* output_;
  Album* album_;
  Film* film_;
  Progress& progress_;
  std::uint64_t steps_per_report_;
  std::optional<std::uint64_t> left_after_;
};

/// The input of a run: a scene, and a checkpoint if the run is continued.
struct Start {
  SceneFile scene;
  std::optional<SettledAccuracy> settled;
  std::optional<FolderClaim> claim;
  std::optional<Checkpoint> checkpoint;
};

Start start_of(const SimulateOptions& options) {
  Start start;
  if (options.continued.empty()) {
    start.scene = read_named_scene(options.scene);
    if (options.seed) reseed(start.scene, *options.seed);
    start.settled = settle_with_progress(start.scene, options.json);
    return start;
  }
  const std::filesystem::path folder = options.continued;
  start.claim.emplace(FolderClaim::of_ended_run(folder));
  start.checkpoint.emplace(folder / checkpoint_name);
  start.scene = start.checkpoint->scene();
  if (const std::string& settled = start.checkpoint->notes(); !settled.empty())
    start.settled = nlohmann::json::parse(settled).get<SettledAccuracy>();
  return start;
}

/// Set a simulation to the state of the checkpoint.
void continue_from(Checkpoint& checkpoint, Simulation& simulation, const SimulateOptions& options) {
  const std::string done = counted(checkpoint.steps_done(), "step");
  if (checkpoint.steps_done() >= simulation.step_count())
    throw InputError(
        fmt::format("{}: the run has come to its end, after {}; expected one that can go on, or a longer 'duration' in "
                    "its scene",
                    options.continued, done));
  if (const auto most = options.most_steps(); most && *most <= checkpoint.steps_done())
    throw InputError(fmt::format("{}: the run is to stop after {}, and its checkpoint is one after {}; expected more",
                                 options.continued, counted(*most, "step"), done));
  checkpoint.load_into(simulation);
}

/// The manifest of a continued run, with the inputs of the continuation.
nlohmann::json continued_manifest(const std::filesystem::path& folder, const Outcome& outcome) {
  const std::filesystem::path file = folder / "manifest.json";
  std::ifstream in(file, std::ios::binary);
  nlohmann::json manifest = nlohmann::json::parse(in, nullptr, false);
  if (!manifest.is_object())
    throw IoError(fmt::format("{}: is missing or damaged; expected what the run left, so nothing has been changed",
                              file.string()));
  nlohmann::json now = begin_manifest({.command_line = {outcome.command_line}});
  now.erase("inputs");
  now.erase("seeds");
  manifest["continued"].push_back(std::move(now));
  return manifest;
}

/// The inputs of the run, written next to its results.
nlohmann::json manifest_of(const SceneFile& scene, const SimulateOptions& options, const Outcome& outcome) {
  RunFacts facts;
  facts.command_line = {outcome.command_line};
  if (options.seed) facts.seeds = {{"added to the seeds of random selections", *options.seed}};
  facts.input_files = {scene_file(options.scene)};
  for (const BodySource& body : scene.bodies())
    if (const auto* mesh = std::get_if<std::filesystem::path>(&body.mesh)) facts.input_files.push_back(*mesh);
  return begin_manifest(facts);
}

void simulate(const SimulateOptions& options, Outcome& outcome) {
  Start start = start_of(options);
  const SceneFile& scene = start.scene;
  const std::optional<SettledAccuracy>& settled = start.settled;
  SceneFile reseeded = scene;
  const bool other_cells = scene.added_seed != 0 && reseed(reseeded, 1);
  Simulation simulation(scene);
  simulation.watch_events(true);
  const std::vector<std::string> told = warnings_of(scene, simulation);
  const std::string opening = opening_of(scene, simulation, step_in_words(simulation, scene));
  const double removed_at_start = simulation.body().removed_mass();
  const std::uint64_t steps = std::min(simulation.step_count(), options.most_steps().value_or(simulation.step_count()));
  // in a continued run, too, pictures begin at its start, where nothing has been cut
  std::optional<Album> album;
  if (options.picture) album.emplace(simulation, steps);
  std::optional<Film> film;
  if (options.film) film.emplace(simulation, steps, -scene.gravity);
  // the folder comes last: a wrong scene leaves nothing behind
  std::optional<SceneOutput> output;
  nlohmann::json manifest;
  const auto write_manifest = [&] {
    if (output) write_whole(output->folder() / "manifest.json", json_text(manifest, 2) + "\n");
  };
  if (start.checkpoint) {
    continue_from(*start.checkpoint, simulation, options);
    manifest = continued_manifest(options.continued, outcome);
    output.emplace(std::move(*start.claim), options.continued, start.checkpoint->output(), scene.probes);
  } else if (!options.out.empty()) {
    output.emplace(options.out, scene.probes, simulation.dimension(), !scene.forces.empty(), scene.has_contact());
    manifest = manifest_of(scene, options, outcome);
    if (settled) manifest["settled"] = *settled;
  }
  write_manifest();

  if (!options.json) {
    tell("{}", opening);
    std::fflush(stdout);  // before the progress, whatever stream that uses
  }
  for (const std::string& warning : told) tell(stderr, "warning: {}\n", warning);
  const std::uint64_t steps_per_report = std::max<std::uint64_t>(1, steps / 100);
  RunResult result;
  std::optional<std::uint64_t> left_after;
  // for the whole process: long factorisations have a thread of their own
  const auto wall = steady_wall_ns(), cpu = process_cpu_ns();
  {
    Progress progress("simulate", steps / steps_per_report, options.json);
    // it takes seconds to minutes, during which the log would be silent
    if (simulation.body().counts().vertices >= 10'000 && make_integrator(scene.integrator)->scheme().implicit)
      progress.show("the first step, which factorises a matrix");
    Watcher watcher(scene, settled ? json_text(nlohmann::json(*settled)) : "", output ? &*output : nullptr,
                    album ? &*album : nullptr, film ? &*film : nullptr, progress, steps_per_report);
    const Interrupt interrupt;
    result = run_scene(simulation, scene.output, watcher, options.most_steps(),
                       start.checkpoint ? &start.checkpoint->progress() : nullptr);
    left_after = watcher.left_after();
    if (!left_after && start.checkpoint) left_after = start.checkpoint->steps_done();
  }
  SimulationReport report{.scene = scene,
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
                          .removed_at_start = removed_at_start,
                          .told = told,
                          .steps_before = start.checkpoint ? start.checkpoint->steps_done() : 0};
  if (left_after && simulation.steps_done() < simulation.step_count() && !result.divergence)
    report.continues_after = left_after;
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
  // pictures of an earlier part of the run stay
  const std::string from_step = start.checkpoint ? fmt::format("_from_step_{}", start.checkpoint->steps_done()) : "";
  if (album) {
    album->ended(simulation);
    const std::string name = "picture" + from_step;
    const std::string trouble =
        draw_bodies(upright(album->panels(), -scene.gravity), scene.name, output->folder(), name);
    report.picture = trouble.empty() ? fmt::format("{0}.png and {0}.svg drawn there.", name) : trouble;
    picture_missing(outcome, trouble);
  }
  if (film) {
    film->ended(simulation);
    const std::string name = "film" + from_step;
    const std::string trouble = draw_film(film->frames(), scene.name, output->folder(), name);
    report.picture += fmt::format("{}{}", report.picture.empty() ? "" : "\n",
                                  trouble.empty() ? fmt::format("{}.gif drawn there.", name) : trouble);
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
    tell("{}", to_text(report));
  }
}

}  // namespace

void add_simulate(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<SimulateOptions>();
  auto* verb = app.add_subcommand("simulate", "Run a scene: a body that moves, and is cut, torn or eroded meanwhile.");
  auto* scene = verb->add_option("SCENE", options->scene,
                                 "a scene file (dartboard scene --keys), or the name of one of the gallery");
  auto* out =
      verb->add_option("--out", options->out, "folder for frames and diagnostics, new or empty [nothing is written]");
  auto* continued = verb->add_option(
      "--continue", options->continued,
      "go on with the run in this folder, from the checkpoint that it left when it was interrupted, or at the times that "
      "its scene asks for (output.checkpoint): what is written in the end is identical to an uninterrupted run, timings "
      "excepted. A run that has come to its end and left a checkpoint goes on when its scene has been given a longer "
      "'duration'");
  continued->excludes(scene)->excludes(out);
  verb->add_flag("--picture", options->picture, "draw the body at four times of the run, into that folder");
  verb->add_flag("--film", options->film, "draw the body as it moves, an animated GIF, into that folder");
  verb->add_option("--steps", options->steps, "stop after so many steps");
  verb->add_flag("--quick", options->quick, "stop after 100 steps");
  verb->add_option("--seed", options->seed, "added to the seeds of random selections [0]")->excludes(continued);
  verb->add_flag("--json", options->json, "print JSON");
  verb->callback([options, &outcome] {
    if (options->scene.empty() && options->continued.empty()) throw CLI::RequiredError("SCENE");
    if (options->out.empty() && options->continued.empty())
      for (const auto& [asked, name] : {std::pair(options->picture, "--picture"), {options->film, "--film"}})
        if (asked) throw CLI::RequiresError(name, "--out or --continue");
    simulate(*options, outcome);
  });
}

}  // namespace dartboard
