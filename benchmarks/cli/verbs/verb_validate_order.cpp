#include "benchmarks/cli/studies/study_names.h"
#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/studies/order/order_study.h"

namespace dartboard {

void add_validate_order(CLI::App& validate, Outcome& outcome) {
  struct Options : StudyOptions {
    OrderPlan plan;
  };
  auto* verb = validate.add_subcommand(
      "order",
      "Observed orders of the time integrators, against certified references and exact discrete maps; or on scenes, "
      "against the references that there are for these.");
  auto options = study_options<Options>(
      *verb,
      {.quick = "fewer halvings and steps, a wider window of errors; on scenes, shorter runs", .keeps_folder = false});
  verb->add_option(
      "SCENE", options->plan.scenes,
      "instead of the study's own scenes: scene files (.json), names of the gallery, or of " + study_scene_names());
  verb->add_option("--integrator", options->plan.integrators, "only these [all]");
  verb->callback([options, &outcome] {
    options->plan.quick = options->quick;
    RunFacts facts;
    for (std::string& scene : options->plan.scenes) {
      scene = study_scene_or_file(scene);
      if (scene.ends_with(".json")) facts.input_files.emplace_back(scene);
    }
    run_study(
        *options, {.label = "order", .keeps_folder = false, .facts = facts},
        [&](StudyLog& log) { return order_study(options->plan, log); }, outcome);
  });
}

}  // namespace dartboard
