#include <fmt/format.h>

#include <cstddef>
#include <optional>
#include <string>

#include "benchmarks/cli/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/studies/extremes/extremes_study.h"

namespace dartboard {

void add_extremes(CLI::App& app, Outcome& outcome) {
  struct Options : StudyOptions {
    std::string axis;
    std::optional<std::size_t> child_from;  // of a child: the first run to make
  };
  auto* verb = app.add_subcommand(
      "extremes", "Run every integrator at the extremes: each run is right, warned of, or stopped with a diagnosis.");
  auto options =
      study_options<Options>(*verb, {.quick = "every third value, coarser maps, shorter runs", .keeps_folder = false});
  verb->add_option("--axis", options->axis, fmt::format("only this one of {} [all]", known_extremes()));
  verb->add_option("--child-from", options->child_from)->group("");  // hidden: the runs of one child process
  verb->callback([options, &outcome] {
    if (options->child_from) return run_extremes_child(options->axis, options->quick, *options->child_from);
    run_study(
        *options, {.label = "extremes", .keeps_folder = false},
        [&](StudyLog& log) { return extremes_study({.axis = options->axis, .quick = options->quick}, log); }, outcome);
  });
}

}  // namespace dartboard
