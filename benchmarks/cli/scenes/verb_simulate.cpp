#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <utility>
#include <vector>

#include "benchmarks/cli/interrupt.h"
#include "benchmarks/cli/scene_names.h"
#include "benchmarks/cli/scenes/earlier_run.h"
#include "benchmarks/cli/scenes/scene_verbs.h"
#include "benchmarks/cli/scenes/simulate_report.h"
#include "benchmarks/figures/album.h"
#include "benchmarks/figures/body_picture.h"
#include "benchmarks/figures/film.h"
#include "benchmarks/figures/run_diagrams.h"
#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/manifest.h"
#include "benchmarks/harness/progress.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/pages/page.h"
#include "benchmarks/pages/player_page.h"
#include "core/base/counted.h"
#include "core/base/thread_team.h"
#include "core/plain/error.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/file/step_times.h"
#include "core/scene/output/atomic_file.h"
#include "core/scene/recorded_run.h"
#include "core/scene/survey/scene_warnings.h"

namespace dartboard {
namespace {

struct SimulateOptions {
  std::string scene, out, continued, player;
  std::string colour = "component";
  std::vector<double> times, seen_from;
  bool json = false, quick = false, picture = false, film = false, replace = false;
  std::optional<std::uint64_t> steps, seed;
  unsigned threads = 0;

  std::optional<std::uint64_t> most_steps() const {
    if (steps) return steps;
    return quick ? std::optional<std::uint64_t>(100) : std::nullopt;
  }
};

const std::map<std::string, ColourBy> colours_by_name{{"component", ColourBy::component},
                                                      {"material", ColourBy::material},
                                                      {"speed", ColourBy::speed},
                                                      {"stress", ColourBy::stress},
                                                      {"contact", ColourBy::contact}};
std::vector<std::string> colour_names() {
  std::vector<std::string> names;
  for (const auto& [name, colour] : colours_by_name) names.push_back(name);
  return names;
}

/// Draws pictures, reports progress, and ends the run on a signal.
class Watcher : public RunWatcher {
 public:
  Watcher(std::vector<RunWatcher*> pictures, Progress& progress, std::uint64_t steps_per_report)
      : pictures_(std::move(pictures)), progress_(progress), steps_per_report_(steps_per_report) {}
  bool takes_frames() const override { return false; }
  bool interrupts() override { return Interrupt::asked(); }
  void diagnostics(const Diagnostics& row) override {
    for (RunWatcher* picture : pictures_) picture->diagnostics(row);
  }
  void probes(const ProbeRow& row) override {
    for (RunWatcher* picture : pictures_) picture->probes(row);
  }
  void stepped(const Simulation& simulation) override {
    for (RunWatcher* picture : pictures_) picture->stepped(simulation);
    if (simulation.steps_done() % steps_per_report_ == 0)
      progress_.advance(
          fmt::format("t = {:.4g} s, {}", simulation.time(), counted(simulation.operations(), "operation")));
  }

 private:
  std::vector<RunWatcher*> pictures_;
  Progress& progress_;
  std::uint64_t steps_per_report_;
};

Eigen::Vector3d direction_of(const std::vector<double>& numbers) {
  if (numbers.empty()) return Eigen::Vector3d::Zero();
  const Eigen::Vector3d direction(numbers[0], numbers[1], numbers[2]);
  if (!direction.allFinite() || direction.isZero(0.0))
    throw CLI::ValidationError("--seen-from", "expected three finite numbers, not all 0");
  return direction / direction.cwiseAbs().maxCoeff();
}

/// The first steps not before these times, ascending.
std::vector<std::uint64_t> steps_of(const std::vector<double>& times, const RecordedRun& run) {
  const double h = run.simulation().step(), end = h * static_cast<double>(run.simulation().step_count());
  std::vector<std::uint64_t> steps;
  for (const double time : times) {
    if (!(time >= 0.0 && time <= end * (1 + 0x1p-50)))
      throw InputError(
          fmt::format("--times {}: {:g} is not a time of the run, from 0 to {:g} s", fmt::join(times, ","), time, end));
    steps.push_back(step_of_time(time, h));
  }
  std::ranges::sort(steps);
  steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
  return steps;
}

RecordedRun make_run(const SimulateOptions& options, const StepChoice& choose_step) {
  if (!options.continued.empty()) return RecordedRun::continued(options.continued, options.most_steps());
  SceneFile scene = read_named_scene(options.scene);
  if (options.seed) reseed(scene, *options.seed);
  const auto choose = [&](SceneFile& it) {
    std::optional<SettledAccuracy> settled = choose_step(it, options.json);
    tell_notices(it);
    return settled;
  };
  return RecordedRun(std::move(scene),
                     {.folder = options.out, .most_steps = options.most_steps(), .choose_step = choose});
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);)
    if (!line.empty()) lines.push_back(line);
  return lines;
}

/// The manifest of a continued run, with the inputs of the continuation.
nlohmann::json continued_manifest(const std::filesystem::path& folder, const Outcome& outcome) {
  const std::filesystem::path file = folder / "manifest.json";
  std::ifstream in(file, std::ios::binary);
  nlohmann::json manifest = nlohmann::json::parse(in, nullptr, false);
  if (!manifest.is_object())
    throw IoError(fmt::format("{}: is missing or damaged; expected what the run left, so nothing has been changed",
                              file.string()));
  nlohmann::json now = begin_manifest({.command_line = outcome.command_line});
  now.erase("inputs");
  now.erase("seeds");
  manifest["continued"].push_back(std::move(now));
  return manifest;
}

/// The scene file, and the meshes that it names.
std::vector<std::filesystem::path> inputs_of(const SceneFile& scene, const SimulateOptions& options) {
  std::vector<std::filesystem::path> files{scene_file(options.scene)};
  for (const BodySource& body : scene.bodies())
    if (const auto* mesh = std::get_if<std::filesystem::path>(&body.mesh)) files.push_back(*mesh);
  return files;
}

/// A scene as its file has it, but for absolute paths.
nlohmann::json published_scene(const std::string& text) {
  nlohmann::json scene = nlohmann::json::parse(text, nullptr, false);
  const std::function<void(nlohmann::json&)> publish = [&publish](nlohmann::json& value) {
    if (value.is_structured())
      for (nlohmann::json& part : value) publish(part);
    else if (value.is_string() && value.get<std::string>().starts_with('/'))
      value = published_path(value.get<std::string>());
  };
  publish(scene);
  return scene;
}

/// The inputs of the run, written next to its results.
nlohmann::json manifest_of(const SceneFile& scene, const SimulateOptions& options, const Outcome& outcome) {
  RunFacts facts;
  facts.command_line = outcome.command_line;
  if (options.seed) facts.seeds = {{"added to the seeds of random selections", *options.seed}};
  facts.input_files = inputs_of(scene, options);
  nlohmann::json manifest = begin_manifest(facts);
  manifest["scene"] = published_scene(scene.text);
  return manifest;
}

void simulate(const SimulateOptions& options, const StepChoice& choose_step, Outcome& outcome) {
  RecordedRun run = make_run(options, choose_step);
  use_threads(options.threads);  // a step for an accuracy is chosen on one thread
  const SceneFile& scene = run.scene();
  const Simulation& simulation = run.simulation();
  const std::string opening = opening_of(scene, run.survey(), simulation, step_in_words(simulation, scene));
  // in a continued run, too, pictures begin at its start, where nothing has been cut
  const Look look = look_of(scene, colours_by_name.at(options.colour), direction_of(options.seen_from));
  std::optional<Album> picture, film;
  RowsOfRun rows;
  std::vector<RunWatcher*> pictures;
  if (options.picture) {
    auto steps = options.times.empty() ? even_steps(run.last_step(), 3) : steps_of(options.times, run);
    pictures.push_back(&picture.emplace(simulation, std::move(steps), look));
    pictures.push_back(&rows);
  }
  if (options.film)
    pictures.push_back(&film.emplace(simulation, even_steps(run.last_step(), most_film_pictures), look));
  std::optional<RecordedFrames> player;
  if (!options.player.empty())
    pictures.push_back(&player.emplace(simulation, even_steps(run.last_step(), most_player_pictures), scene));
  // the folder comes last: a wrong scene leaves nothing behind
  nlohmann::json manifest;
  if (!options.continued.empty()) {
    manifest = continued_manifest(options.continued, outcome);
  } else if (!options.out.empty()) {
    manifest = manifest_of(scene, options, outcome);
    if (run.settled()) manifest["settled"] = *run.settled();
  }
  if (options.replace) empty_run_folder(options.out, inputs_of(scene, options));
  run.open();
  const auto write_manifest = [&] {
    if (!run.folder().empty()) write_whole(run.folder() / "manifest.json", json_text(manifest, 2) + "\n");
  };
  write_manifest();

  if (!options.json) {
    tell("{}", opening);
    std::fflush(stdout);  // before the progress, whatever stream that uses
  }
  for (const std::string& warning : run.warnings()) tell(stderr, "warning: {}\n", warning);
  const std::uint64_t steps_per_report = std::max<std::uint64_t>(1, run.last_step() / 100);
  // for the whole process: long factorisations have a thread of their own
  const auto wall = steady_wall_ns(), cpu = process_cpu_ns();
  {
    Progress progress("simulate", run.last_step() / steps_per_report, options.json);
    // a large one may take minutes, during which the log would be silent
    if (simulation.body().counts().vertices >= 10'000) progress.show("the first step");
    Watcher watcher(pictures, progress, steps_per_report);
    const Interrupt interrupt;
    run.run(watcher);
  }
  SimulationReport report{.scene = scene,
                          .survey = run.survey(),
                          .simulation = simulation,
                          .result = run.result(),
                          .settled = run.settled(),
                          .expected = run.expected(),
                          .unjudged = run.unjudged(),
                          .wall_s = static_cast<double>(steady_wall_ns() - wall) * 1e-9,
                          .cpu_s = static_cast<double>(process_cpu_ns() - cpu) * 1e-9,
                          .folder = run.folder().string(),
                          .frames = run.frame_count(),
                          .picture = "",
                          .removed_at_start = run.removed_at_start(),
                          .warned = run.warnings(),
                          .steps_before = run.first_step(),
                          .continues_after = run.continues_after()};

  outcome.exit_code = run.result().interrupted ? Interrupt::exit_code() : run.holds() ? exit_agrees : exit_disagrees;
  // pictures of an earlier part of the run stay
  const std::string from_step = run.first_step() > 0 ? fmt::format("_from_step_{}", run.first_step()) : "";
  const auto drawn = [&](const std::string& trouble, const std::string& sentence) {
    report.picture += (report.picture.empty() ? "" : "\n") + (trouble.empty() ? sentence : trouble);
    picture_missing(outcome, trouble);
  };
  if (picture) {
    picture->ended(simulation);
    const std::string name = "picture" + from_step, curves = "curves" + from_step;
    drawn(draw_bodies(picture->pictures(), look, scene.name, run.folder(), name),
          fmt::format("{0}.png and {0}.svg drawn there.", name));
    if (rows.are_curves())
      drawn(draw_diagrams(rows.diagrams(scene, simulation.dimension()), scene.name, run.folder(), curves),
            fmt::format("{0}.png and {0}.svg drawn there, of its diagnostics.", curves));
  }
  if (film) {
    film->ended(simulation);
    const std::string name = "film" + from_step;
    drawn(draw_film(film->pictures(), look, scene.name, run.folder(), name), fmt::format("{}.gif drawn there.", name));
  }
  if (player) {
    player->ended(simulation);
    const PlayedRun played{scene, look, lines_of(opening), run.warnings(), to_text(report)};
    drawn(write_page("player", player_page(*player, played), options.player),
          fmt::format("{} plays it in a browser.", options.player));
  }
  if (!run.folder().empty()) {
    write_whole(run.folder() / "summary.json", json_text(to_json(report), 2) + "\n");
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

void add_simulate(CLI::App& app, Outcome& outcome, StepChoice choose_step) {
  auto options = std::make_shared<SimulateOptions>();
  auto* verb = app.get_subcommand("simulate");
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
  verb->add_flag(
      "--replace", options->replace,
      "remove the files of an earlier run from the folder of --out, and nothing if it holds any others; write the "
      "page of --player over an earlier one");
  verb->add_flag(
      "--picture", options->picture,
      "draw the body at four times of the run, or at those of --times, into that folder, and its diagnostics as "
      "curves, where the scene has rows of them (output.diagnostics_every)");
  verb->add_flag(
      "--film", options->film,
      "draw the body as it moves, an animated GIF, into that folder: as fast as the motion, but 4 seconds at least "
      "and 12 at most");
  verb->add_option(
          "--player", options->player,
          "write a page that plays the run in a browser, without a network: turn the bodies, colour them, follow a "
          "vertex, see energy, momentum and contact as curves, put another player beside it")
      ->type_name("FILE.html");
  auto* times = verb->add_option("--times", options->times, "the times [s] of the picture: 0,0.35,1 [four, evenly]")
                    ->delimiter(',')
                    ->type_name("T1,T2,..");
  auto* seen_from =
      verb->add_option(
              "--seen-from", options->seen_from,
              "the direction of the viewer, along the axes of the scene [0.45,-0.8,0.4]: 1,0,0 shows bodies from "
              "where x is large, 0,0,1 from above")
          ->delimiter(',')
          ->expected(3)
          ->type_name("X,Y,Z");
  auto* colour =
      verb->add_option("--colour", options->colour,
                       "colour the bodies of pictures and films by component, material, speed, (von Mises) stress or "
                       "contact (force) [component]");
  colour->check(CLI::IsMember(colour_names()));
  verb->add_option("--steps", options->steps, "stop after so many steps");
  verb->add_option(
          "--threads", options->threads,
          "of forces and of explicit integrators, 0 for one on each processor [0]: the bits of a run do not depend "
          "on it, and small bodies are moved by one. With more than one, frames are written by one of their own")
      ->check(CLI::Range(0u, 256u));
  verb->add_flag("--quick", options->quick, "stop after 100 steps");
  verb->add_option("--seed", options->seed, "added to the seeds of random selections [0]")->excludes(continued);
  verb->add_flag("--json", options->json, "print JSON");
  verb->callback([options, colour, times, seen_from, choose_step = std::move(choose_step), &outcome] {
    if (options->scene.empty() && options->continued.empty()) throw CLI::RequiredError("SCENE");
    if (options->out.empty() && options->continued.empty())
      for (const auto& [asked, name] : {std::pair(options->picture, "--picture"), {options->film, "--film"}})
        if (asked) throw CLI::RequiresError(name, "--out or --continue");
    for (const CLI::Option* of_pictures : {colour, seen_from})
      if (*of_pictures && !options->picture && !options->film && (of_pictures == colour || options->player.empty()))
        throw CLI::RequiresError(of_pictures->get_name(), "--picture or --film");
    if (*times && !options->picture) throw CLI::RequiresError("--times", "--picture");
    if (!options->replace && !options->out.empty() && is_run_folder(options->out))
      throw IoError(fmt::format(
          "{}: holds an earlier run; expected a new or empty folder for the results, or --replace", options->out));
    if (options->replace && options->out.empty() && options->player.empty())
      throw CLI::RequiresError("--replace", "--out or --player");
    if (!options->player.empty()) require_writable_page(options->player, "player", options->replace, options->out);
    simulate(*options, choose_step, outcome);
  });
}

}  // namespace dartboard
