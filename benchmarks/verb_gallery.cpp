// dartboard gallery: every scene that comes with the program, run, judged and drawn.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "benchmarks/album.h"
#include "benchmarks/cli.h"
#include "benchmarks/clock.h"
#include "benchmarks/json_text.h"
#include "benchmarks/manifest.h"
#include "benchmarks/progress.h"
#include "benchmarks/run_folder.h"
#include "benchmarks/settle_accuracy.h"
#include "benchmarks/table.h"
#include "benchmarks/tell.h"
#include "core/plain/error.h"
#include "core/scene/scene_run.h"
#include "core/scene/scene_verdict.h"

namespace dartboard {
namespace {

struct Options {
  std::string out;
  bool json = false;
};

struct Shown {
  SceneFile scene;
  std::string file, map, hash, picture_trouble, divergence;
  std::uint64_t steps = 0;
  std::size_t operations = 0, expected = 0, held = 0;
  double cpu_s = 0.0;

  bool holds() const { return divergence.empty() && held == expected; }
};

std::vector<std::filesystem::path> scene_files() {
  std::vector<std::filesystem::path> files;
  const auto folder = std::filesystem::path(DARTBOARD_SOURCE_DIR) / "benchmarks" / "scenes";
  std::error_code trouble;
  for (const auto& entry : std::filesystem::directory_iterator(folder, trouble))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  if (files.empty()) throw IoError(fmt::format("{}: no scenes there", folder.string()));
  std::ranges::sort(files);
  return files;
}

class AlbumWatcher : public RunWatcher {
 public:
  explicit AlbumWatcher(Album& album) : album_(album) {}
  void stepped(const Simulation& simulation) override { album_.stepped(simulation); }

 private:
  Album& album_;
};

Shown show(const std::filesystem::path& file, const RunFolder* folder) {
  Shown shown;
  shown.scene = read_scene(file);
  shown.file = file.filename().string();
  settle_accuracy(shown.scene, thread_cpu_ns);
  Simulation simulation(shown.scene);
  Album album(simulation, simulation.step_count());
  AlbumWatcher watcher(album);
  const auto start = thread_cpu_ns();
  const RunResult result = run_scene(simulation, shown.scene.output, watcher);
  shown.cpu_s = static_cast<double>(thread_cpu_ns() - start) * 1e-9;
  if (result.divergence) shown.divergence = to_string(*result.divergence);
  shown.map = simulation.body().map_name();
  shown.hash = fmt::format("{:016x}", simulation.body().state_hash());
  shown.steps = simulation.steps_done();
  shown.operations = simulation.operations();
  for (const ExpectedRow& row : compare_with_expectation(shown.scene, simulation, result)) {
    ++shown.expected;
    if (row.holds) ++shown.held;
  }
  album.ended(simulation);
  if (folder != nullptr)
    shown.picture_trouble =
        draw_bodies(album.panels(), shown.scene.name, folder->path(), file_name_of(shown.scene.name));
  return shown;
}

Table table_of(const std::vector<Shown>& all) {
  Table table({{"scene"},
               {"map"},
               {"integrator"},
               {"steps", Align::right},
               {"operations", Align::right},
               {"expected", Align::right},
               {"hash"},
               {"holds"}});
  for (const Shown& s : all)
    table.add_row({s.scene.name, s.map, s.scene.integrator, std::to_string(s.steps), std::to_string(s.operations),
                   fmt::format("{} of {}", s.held, s.expected), s.hash, s.holds() ? "yes" : "NO"});
  return table;
}

std::string page_of(const std::vector<Shown>& all) {
  std::string page = "# Gallery\n\nEach scene at four times of its run, drawn from its own output.\n";
  for (const Shown& s : all)
    page += fmt::format(
        "\n## {0}\n\n{1}\n\n![{0}]({2}.png)\n\n{3}: {4}, {5}, {6} steps, {7} operations; {8} of {9} "
        "expectations hold.\n",
        markdown_text(s.scene.name), markdown_line(s.scene.about), file_name_of(s.scene.name), markdown_code(s.file),
        s.map, s.scene.integrator, s.steps, s.operations, s.held, s.expected);
  return page;
}

nlohmann::ordered_json to_json(const Shown& s) {
  return {{"scene", s.scene.name},
          {"map", s.map},
          {"integrator", s.scene.integrator},
          {"steps", s.steps},
          {"operations", s.operations},
          {"hash", s.hash},
          {"expected", s.expected},
          {"held", s.held},
          {"holds", s.holds()},
          {"divergence", s.divergence},
          {"cpu_s", s.cpu_s}};
}

void gallery(const Options& options, Outcome& outcome) {
  const auto files = scene_files();
  std::optional<RunFolder> folder;
  nlohmann::json manifest;
  if (!options.out.empty()) {
    folder.emplace(options.out);
    RunFacts facts;
    facts.command_line = {outcome.command_line};
    facts.input_files = files;
    manifest = begin_manifest(facts);
    folder->write_manifest(manifest);
  }
  std::vector<Shown> all;
  {
    Progress progress("gallery", files.size(), options.json);
    for (const auto& file : files) {
      all.push_back(show(file, folder ? &*folder : nullptr));
      progress.advance(all.back().scene.name);
    }
  }
  if (!std::ranges::all_of(all, &Shown::holds)) outcome.exit_code = exit_disagrees;
  for (const Shown& s : all) picture_missing(outcome, s.picture_trouble);
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const Shown& s : all) json.push_back(to_json(s));
  if (folder) {
    folder->write("gallery.md", page_of(all));
    folder->write_json("gallery.json", json);
    finish_manifest(manifest);
    folder->write_manifest(manifest);
  }
  if (options.json) {
    tell("{}\n", json_text(json, 2));
    for (const Shown& s : all)
      if (!s.picture_trouble.empty()) tell(stderr, "{}\n", s.picture_trouble);
    return;
  }
  tell("{}", to_text(table_of(all)));
  for (const Shown& s : all) {
    if (!s.divergence.empty()) tell("{}: the motion {}\n", one_line(s.scene.name), s.divergence);
    if (!s.picture_trouble.empty()) tell("{}\n", s.picture_trouble);
  }
  if (folder) tell("\ngallery.md and the pictures are in {}.\n", folder->path().string());
}

}  // namespace

void add_gallery(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand("gallery", "Run every scene that comes with the program, judge it, and draw it.");
  verb->add_option("--out", options->out, "folder for the pictures and their page, new or empty [nothing is drawn]");
  verb->add_flag("--json", options->json, "print JSON");
  verb->callback([options, &outcome] { gallery(*options, outcome); });
}

}  // namespace dartboard
