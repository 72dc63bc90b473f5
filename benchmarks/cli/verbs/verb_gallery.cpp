#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <vector>

#include "benchmarks/cli/scene_names.h"
#include "benchmarks/cli/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/studies/scenes/gallery_study.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

std::vector<std::filesystem::path> scene_files() {
  std::vector<std::filesystem::path> files;
  std::error_code trouble;
  for (const auto& entry : std::filesystem::directory_iterator(gallery_folder(), trouble))
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  if (files.empty()) throw IoError(fmt::format("{}: no scenes there", gallery_folder().string()));
  std::ranges::sort(files);
  return files;
}

}  // namespace

void add_gallery(CLI::App& app, Outcome& outcome) {
  auto* verb = app.add_subcommand("gallery", "Run every scene that comes with the program, judge it, and draw it.");
  auto options = study_options(
      *verb, {.keeps_folder = false, .out = "folder for the pictures and their page, new or empty [nothing is drawn]"});
  verb->callback([options, &outcome] {
    const auto files = scene_files();
    run_study(
        *options, {.label = "gallery", .keeps_folder = false, .facts = {.input_files = files}},
        [&](StudyLog& log) { return gallery_study(files, log); }, outcome);
  });
}

}  // namespace dartboard
