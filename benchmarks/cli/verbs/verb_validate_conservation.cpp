#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/cli/studies/named_mesh.h"
#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/studies/conservation/conservation_study.h"

namespace dartboard {

void add_validate_conservation(CLI::App& validate, Outcome& outcome) {
  struct Options : StudyOptions {
    std::string mesh = (source_folder() / "benchmarks/meshes/liver564.mesh").string();
    std::optional<std::size_t> operations;
  };
  auto* verb = validate.add_subcommand(
      "conservation", "Masses, stiffnesses, momenta and energies through random operations on a moving body.");
  auto options = study_options<Options>(
      *verb, {.quick = "fewer operations", .seed = "the random operations", .keeps_folder = false});
  verb->add_option("MESH", options->mesh, "a mesh file, or the name of a mesh of the project [liver564.mesh]");
  verb->add_option("--operations", options->operations, "random operations per body [10000; 1000 with --quick]");
  verb->callback([options, &outcome] {
    const ConservationStudyPlan plan{find_mesh(options->mesh).make(), options->mesh,
                                     options->operations.value_or(options->quick ? 1000 : 10000), options->seed};
    run_study(
        *options, {.label = "conservation", .keeps_folder = false},
        [&](StudyLog& log) { return conservation_study(plan, log); }, outcome);
  });
}

}  // namespace dartboard
