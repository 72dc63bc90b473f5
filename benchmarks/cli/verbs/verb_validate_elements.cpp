#include "benchmarks/cli/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/studies/elements/elements_study.h"

namespace dartboard {

void add_validate_elements(CLI::App& validate, Outcome& outcome) {
  struct Options : StudyOptions {
    ElementsPlan plan;
  };
  auto* verb = validate.add_subcommand(
      "elements",
      "A clamped beam by springs and by elements, beside quadratic ones: what does a model miss, and cost?");
  auto options = study_options<Options>(*verb, {.quick = "coarse meshes", .keeps_folder = false});
  verb->callback([options, &outcome] {
    options->plan.quick = options->quick;
    run_study(
        *options, {.label = "elements", .keeps_folder = false},
        [&](StudyLog& log) { return elements_study(options->plan, log); }, outcome);
  });
}

}  // namespace dartboard
