#include <optional>

#include "benchmarks/cli/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/studies/contact/contact_study.h"

namespace dartboard {

void add_validate_contact(CLI::App& validate, Outcome& outcome) {
  struct Options : StudyOptions {
    std::optional<std::size_t> placements;
  };
  auto* verb = validate.add_subcommand(
      "contact",
      "Whether bodies feel what overlaps of them, placed at random and in motion: CGAL and separating axes; and whether "
      "contact carries what closed forms say, and holds in a pressed stack that is cut, torn and eroded.");
  auto options = study_options<Options>(*verb, {.quick = "fewer placements, inspections and operations",
                                                .seed = "the random placements and operations",
                                                .keeps_folder = false});
  verb->add_option("--placements", options->placements, "of bodies in each other [100000; 400 with --quick]");
  verb->callback([options, &outcome] {
    const ContactStudyPlan plan{.placements = options->placements.value_or(options->quick ? 400 : 100'000),
                                .looks = options->quick ? 10u : 100u,
                                .seed = options->seed,
                                .operations = options->quick ? 200u : 10'000u,
                                .one_ball = options->quick};
    run_study(
        *options, {.label = "contact", .keeps_folder = false}, [&](StudyLog& log) { return contact_study(plan, log); },
        outcome);
  });
}

}  // namespace dartboard
