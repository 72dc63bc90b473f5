#include "benchmarks/studies/scenes/gallery_study.h"

#include <fmt/format.h>

#include <utility>

#include "benchmarks/figures/album.h"
#include "benchmarks/figures/body_picture.h"
#include "benchmarks/harness/clock.h"
#include "benchmarks/studies/scenes/gallery_report.h"
#include "core/base/escape.h"
#include "core/scene/run/scene_run.h"
#include "core/scene/run/scene_verdict.h"
#include "validation/recommend/settle_accuracy.h"

namespace dartboard {
namespace {

/// The scene, judged, and its pictures.
std::pair<ShownScene, BodyStrip> show(const std::filesystem::path& file) {
  ShownScene shown;
  shown.scene = read_scene(file);
  shown.file = file.filename().string();
  settle_accuracy(shown.scene, thread_cpu_ns);
  Simulation simulation(shown.scene);
  const Look look = look_of(shown.scene);
  Album album(simulation, even_steps(simulation.step_count(), 3), look);
  const auto start = thread_cpu_ns();
  const RunResult result = run_scene(simulation, shown.scene.output, album);
  shown.cpu_s = static_cast<double>(thread_cpu_ns() - start) * 1e-9;
  if (result.divergence) shown.divergence = to_string(*result.divergence);
  if (result.refusal) shown.divergence = to_string(*result.refusal);
  shown.map = simulation.body().map_name();
  shown.hash = fmt::format("{:016x}", simulation.body().state_hash());
  shown.steps = simulation.steps_done();
  shown.operations = simulation.operations();
  for (const ExpectedRow& row : compare_with_expectation(shown.scene, simulation, result)) {
    ++shown.expected;
    if (row.holds) ++shown.held;
  }
  album.ended(simulation);
  return {shown, {album.pictures(), look, shown.scene.name}};
}

}  // namespace

Report gallery_study(const std::vector<std::filesystem::path>& scene_files, StudyLog& log) {
  Report report;
  report.numbers = nlohmann::ordered_json::array();
  std::vector<ShownScene> all;
  log.begin("gallery", scene_files.size());
  for (const auto& file : scene_files) {
    auto [shown, strip] = show(file);
    log.advance(shown.scene.name);
    report.numbers.push_back(to_json(shown));
    report.pictures.push_back({file_name_of(shown.scene.name), std::move(strip)});
    if (!shown.divergence.empty())
      report.disagreements.push_back(
          fmt::format("{}: the motion {}", shortened(shown.scene.name, 100), shown.divergence));
    else if (!shown.holds())
      report.disagreements.push_back(
          fmt::format("{}: {} of {} expectations hold", shortened(shown.scene.name, 100), shown.held, shown.expected));
    all.push_back(std::move(shown));
  }
  report.tables = {{"runs", "Each scene run and judged", gallery_table(all)},
                   {.name = "scenes", .heading = "What each scene shows", .table = shown_table(all), .on_page = true}};
  report.data_files = {{"gallery.json", report.numbers}};
  return report;
}

}  // namespace dartboard
