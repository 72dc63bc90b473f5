#include "benchmarks/cli/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/studies/order/order_study.h"

namespace dartboard {

void add_validate_order(CLI::App& validate, Outcome& outcome) {
  struct Options : StudyOptions {
    OrderPlan plan;
  };
  auto* verb = validate.add_subcommand(
      "order", "Observed orders of the time integrators, against certified references and exact discrete maps.");
  auto options = study_options<Options>(
      *verb, {.quick = "fewer halvings and steps, a wider window of errors", .keeps_folder = false});
  verb->add_option("--integrator", options->plan.integrators, "only these [all]");
  verb->callback([options, &outcome] {
    options->plan.quick = options->quick;
    run_study(
        *options, {.label = "order", .keeps_folder = false},
        [&](StudyLog& log) { return order_study(options->plan, log); }, outcome);
  });
}

}  // namespace dartboard
