#include "benchmarks/cli/scene_names.h"
#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/studies/scenes/gallery_study.h"

namespace dartboard {

void add_gallery(CLI::App& app, Outcome& outcome) {
  auto* verb = app.get_subcommand("gallery");
  auto options = study_options(
      *verb, {.keeps_folder = false, .out = "folder for the pictures and their page, new or empty [nothing is drawn]"});
  verb->callback([options, &outcome] {
    const auto files = gallery_files();
    run_study(
        *options, {.label = "gallery", .keeps_folder = false, .facts = {.input_files = files}},
        [&](StudyLog& log) { return gallery_study(files, log); }, outcome);
  });
}

}  // namespace dartboard
