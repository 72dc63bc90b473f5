#include <optional>
#include <string>

#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/studies/contact/contact_study.h"
#include "benchmarks/studies/contact/ipctk_study.h"

namespace dartboard {

void add_validate_contact(CLI::App& validate, Outcome& outcome) {
  struct Options : StudyOptions {
    std::optional<std::size_t> placements;
    std::string with;
  };
  auto* verb = validate.add_subcommand(
      "contact",
      "Whether bodies feel what overlaps of them, placed at random and in motion: CGAL and separating axes; and whether "
      "contact carries what closed forms say, pulls, catches and loses nothing in scenes drawn at random, and holds in a "
      "pressed stack that is cut, torn and eroded.");
  auto options = study_options<Options>(*verb, {.quick = "fewer placements, inspections, scenes and operations",
                                                .seed = "the random placements, scenes and operations",
                                                .keeps_folder = false});
  verb->add_option("--placements", options->placements, "of bodies in each other [100000; 400 with --quick]");
  verb->add_option("--with", options->with,
                   "another program that judges contacts, too: ipctk, which `python3` imports (pip install ipctk)")
      ->check(CLI::IsMember({"ipctk"}));
  verb->callback([options, &outcome] {
    ContactStudyPlan plan{.placements = options->placements.value_or(options->quick ? 400 : 100'000),
                          .looks = options->quick ? 10u : 100u,
                          .seed = options->seed,
                          .operations = options->quick ? 200u : 10'000u,
                          .drawn = options->quick ? 60u : 1000u,
                          .every_integrator = !options->quick,
                          .one_ball = options->quick,
                          .certified = options->quick ? 200u : 2000u,
                          .shots = options->quick ? 30u : 100u};
    if (!options->with.empty()) {
      plan.ipctk_version = ipctk_version();
      plan.ipctk = run_ipctk;
    }
    run_study(
        *options, {.label = "contact", .keeps_folder = false}, [&](StudyLog& log) { return contact_study(plan, log); },
        outcome);
  });
}

}  // namespace dartboard
