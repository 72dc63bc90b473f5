#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/studies/solvers/solver_study.h"

namespace dartboard {

void add_validate_solvers(CLI::App& validate, Outcome& outcome) {
  struct Options : StudyOptions {
    std::vector<std::string> only;
  };
  auto* verb = validate.add_subcommand(
      "solvers", "Linear systems: backward errors at all scales, factors that follow edits, and where implicit pays.");
  auto options = study_options<Options>(
      *verb, {.quick = "smaller bodies, one size, fewer repetitions", .seed = "the order of the timed tasks"});
  verb->add_option("--only", options->only, fmt::format("of {} [all]", fmt::join(solver_parts(), ", ")));
  verb->callback([options, &outcome] {
    RunFacts facts{.seeds = {{"order of the tasks", options->seed}},
                   .input_files = {source_folder() / "benchmarks/meshes/liver564.mesh"}};
    run_study(
        *options, {.label = "solvers", .facts = facts},
        [&](StudyLog& log) {
          return solver_study({options->only, options->quick, options->seed}, log);
        },
        outcome);
  });
}

}  // namespace dartboard
