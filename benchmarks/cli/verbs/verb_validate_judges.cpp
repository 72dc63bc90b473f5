#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/studies/judges/judges_study.h"

namespace dartboard {

void add_validate_judges(CLI::App& validate, Outcome& outcome) {
  struct Options : StudyOptions {
    JudgesPlan plan;
  };
  auto* verb = validate.add_subcommand(
      "judges", "Integrators that are wrong on purpose, through the judges of integrators: which judges notice?");
  auto options = study_options<Options>(
      *verb, {.quick = "a sample of the runs, orders of three integrators", .keeps_folder = false});
  verb->add_option("--axis", options->plan.axis, "only these runs of `extremes` [all, and the other judges]");
  verb->callback([options, &outcome] {
    options->plan.quick = options->quick;
    run_study(
        *options, {.label = "judges", .keeps_folder = false},
        [&](StudyLog& log) { return judges_study(options->plan, log); }, outcome);
  });
}

}  // namespace dartboard
