#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string>

#include "benchmarks/cli/studies/study_names.h"
#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/studies/extremes/extremes_study.h"

namespace dartboard {

void add_extremes(CLI::App& app, Outcome& outcome) {
  struct Options : StudyOptions {
    ExtremesPlan plan;
    std::optional<std::size_t> child_from;  // of a child: the first run to make
  };
  auto* verb = app.get_subcommand("extremes");
  auto options = study_options<Options>(
      *verb, {.quick = "every third value, coarser maps, shorter runs; of scenes half of the steps",
              .keeps_folder = false,
              .goes_on = true});
  auto* scenes = verb->add_option(
      "SCENE", options->plan.scenes,
      "instead of the study's own bodies: scene files (.json), names of the gallery, or of " + study_scene_names());
  verb->add_option("--axis", options->plan.axis, fmt::format("only this one of {} [all]", known_extremes()))
      ->excludes(scenes);
  verb->add_option("--child-from", options->child_from)->group("");  // hidden: the runs of one child process
  verb->callback([options, &outcome] {
    options->plan.quick = options->quick;
    RunFacts facts;
    for (std::string& scene : options->plan.scenes) {
      scene = study_scene_or_file(scene);
      if (scene.ends_with(".json")) facts.input_files.emplace_back(scene);
    }
    if (options->child_from) return run_extremes_child(options->plan, *options->child_from);
    run_study(
        *options, {.label = "extremes", .keeps_folder = false, .facts = facts},
        [&](StudyLog& log) { return extremes_study(options->plan, log); }, outcome);
  });
}

}  // namespace dartboard
