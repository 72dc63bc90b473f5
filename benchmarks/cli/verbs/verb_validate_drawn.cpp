#include <optional>
#include <string>

#include "benchmarks/cli/scene_names.h"
#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/studies/drawn/drawn_study.h"

namespace dartboard {

void add_validate_drawn(CLI::App& validate, Outcome& outcome) {
  struct Options : StudyOptions {
    std::string scene;
    std::optional<std::size_t> count;
    DrawnPlan plan;
  };
  auto* verb = validate.add_subcommand(
      "drawn",
      "Relations that need no truth, on scenes drawn over all keys, or on a scene: does it matter in which units or axes "
      "it is written, whether it is stopped and continued, how many threads step it, whether another body is far away?");
  auto options = study_options<Options>(
      *verb, {.quick = "fewer scenes", .seed = "the scenes, and of their faults", .keeps_folder = false});
  verb->add_option("SCENE", options->scene,
                   "a scene file (.json), or a name of the gallery, in place of drawn scenes: its first steps");
  verb->add_option("--count", options->count, "scenes [1000; 100 with --quick]")->check(positive_number());
  verb->add_option("--first", options->plan.first, "number of the first scene [0]");
  verb->add_flag("--choose", options->plan.only_choose,
                 "only choose among them: the numbers of scenes that have all pairs of keys and choices");
  verb->add_option("--relation", options->plan.relation, "only this one [all]");
  verb->add_option("--steps", options->plan.steps, "of SCENE, at most [100]")->check(positive_number());
  verb->add_option("--smallest", options->plan.folder,
                   "folder for scenes that break a relation, cut down to what breaks it [.]");
  verb->callback([options, &outcome] {
    options->plan.seed = options->seed;
    options->plan.count = options->count.value_or(options->quick ? 100 : 1000);
    RunFacts facts;
    if (!options->scene.empty()) {
      options->plan.scene = scene_file(options->scene);
      facts.input_files.emplace_back(options->plan.scene);
    }
    run_study(
        *options, {.label = "drawn", .keeps_folder = false, .facts = facts},
        [&](StudyLog& log) { return drawn_study(options->plan, log); }, outcome);
  });
}

}  // namespace dartboard
