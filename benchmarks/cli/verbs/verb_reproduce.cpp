#include <string>

#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/paper/paper_bodies.h"
#include "benchmarks/studies/reproduce/reproduce_study.h"
#include "reference/cgal/cgal_body.h"

namespace dartboard {

void add_reproduce(CLI::App& app, Outcome& outcome) {
  struct Options : StudyOptions {
    std::string part;
  };
  auto* verb = app.get_subcommand("reproduce");
  auto options =
      study_options<Options>(*verb, {.quick = "fewer processes and rounds, a third of the extremes: some minutes less",
                                     .seed = "the order in which contenders take turns",
                                     .goes_on = true});
  verb->add_option("--part", options->part, "only this part: paper or larger, some 20 s each, or extremes [all]")
      ->check(CLI::IsMember({"paper", "larger", "extremes"}));
  verb->callback([options, &outcome] {
    RunFacts facts{.seeds = {{"order of tasks", options->seed}},
                   .libraries = {{"CGAL", reference::cgal_version()}},
                   .input_files = {paper_body("liver").mesh}};
    run_study(
        *options, {.label = options->quick ? "quick" : "reproduce", .facts = facts},
        [&](StudyLog& log) {
          return reproduce_study({options->part, options->quick, options->seed}, log);
        },
        outcome);
  });
}

}  // namespace dartboard
