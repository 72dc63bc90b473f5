// dartboard gallery: every scene that comes with the program, run, judged and drawn.

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>

#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/figures/album.h"
#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/manifest.h"
#include "benchmarks/harness/progress.h"
#include "benchmarks/harness/run_folder.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/scenes/gallery_report.h"
#include "benchmarks/studies/tradeoff/settle_accuracy.h"
#include "core/plain/error.h"
#include "core/scene/run/scene_run.h"
#include "core/scene/run/scene_verdict.h"

namespace dartboard {
namespace {

struct Options {
  std::string out;
  bool json = false;
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

ShownScene show(const std::filesystem::path& file, const RunFolder* folder) {
  ShownScene shown;
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
  std::vector<ShownScene> all;
  {
    Progress progress("gallery", files.size(), options.json);
    for (const auto& file : files) {
      all.push_back(show(file, folder ? &*folder : nullptr));
      progress.advance(all.back().scene.name);
    }
  }
  if (!std::ranges::all_of(all, &ShownScene::holds)) outcome.exit_code = exit_disagrees;
  for (const ShownScene& s : all) picture_missing(outcome, s.picture_trouble);
  nlohmann::ordered_json json = nlohmann::ordered_json::array();
  for (const ShownScene& s : all) json.push_back(to_json(s));
  if (folder) {
    folder->write("gallery.md", gallery_page(all));
    folder->write_json("gallery.json", json);
    finish_manifest(manifest);
    folder->write_manifest(manifest);
  }
  if (options.json) {
    tell("{}\n", json_text(json, 2));
    for (const ShownScene& s : all)
      if (!s.picture_trouble.empty()) tell(stderr, "{}\n", s.picture_trouble);
    return;
  }
  tell("{}", to_text(gallery_table(all)));
  for (const ShownScene& s : all) {
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
