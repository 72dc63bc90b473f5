#include <CLI/App.hpp>
#include <string>

#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/report/derived.h"
#include "benchmarks/studies/compare/compare_runs.h"

namespace dartboard {

void add_compare(CLI::App& app, Outcome& outcome) {
  struct Options : StudyOptions {
    std::string first, second;
    double least = 5.0, within = 0.0;
  };
  auto* verb = app.get_subcommand("compare");
  auto options = study_options<Options>(*verb, {.keeps_folder = false});
  verb->add_option("FIRST", options->first, "the folder of a run of a study, or of `simulate --out`")->required();
  verb->add_option("SECOND", options->second,
                   "that of another run of it: another commit, other options, another machine; or of the same body")
      ->required();
  verb->add_option("--least", options->least, "percent by which a time has to change for the change to count [5]")
      ->check(CLI::Range(0.0, 1000.0));
  verb->add_option("--within", options->within, "edge lengths that vertices of two scenes may be apart [0]")
      ->check(CLI::NonNegativeNumber);
  verb->callback([options, &outcome] {
    for (const std::string& folder : {options->first, options->second}) restore_missing(folder);
    run_study(
        *options, {.label = "compare", .keeps_folder = false},
        [&](StudyLog&) {
          return compare({options->first, options->second, 0.01 * options->least, options->within});
        },
        outcome);
  });
}

}  // namespace dartboard
