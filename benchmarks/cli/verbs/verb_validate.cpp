#include <optional>
#include <string>

#include "benchmarks/cli/studies/named_mesh.h"
#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/studies/topology/topology_study.h"

namespace dartboard {
namespace {

struct ValidateOptions : StudyOptions {
  std::string mesh, replay, script_out;
  bool all = false, self = false;
  std::optional<std::size_t> operations;
};

void add_validate_topology(CLI::App& validate, Outcome& outcome) {
  auto* verb = validate.add_subcommand("topology",
                                       "Our map against CGAL's generalized and combinatorial maps, at rest and "
                                       "through random operations.");
  auto options = study_options<ValidateOptions>(
      *verb, {.quick = "fewer operations", .seed = "the random operations", .keeps_folder = false});
  auto* what = verb->add_option_group("WHAT");
  what->add_option("MESH", options->mesh, "a mesh file, or the name of a mesh of the project");
  what->add_flag("--all", options->all, "every mesh of the project, as without MESH and --replay");
  what->add_option("--replay", options->replay, "a script, as written at a disagreement");
  what->require_option(0, 1);
  verb->add_option("--operations", options->operations, "random operations per series [10000; 1000 with --quick]");
  verb->add_option("--script-out", options->script_out,
                   "where to write the script of a disagreement [disagreement-MESH-SEED.txt]");
  verb->add_flag("--self", options->self,
                 "without CGAL during the operations: our storages against each other, and checks");
  verb->callback([options, &outcome] {
    const auto study = [&](StudyLog& log) {
      if (!options->replay.empty()) return topology_replay(options->replay, find_mesh);
      return topology_study({.meshes = options->mesh.empty() ? all_meshes() : std::vector{find_mesh(options->mesh)},
                             .operations = options->operations.value_or(options->quick ? 1000 : 10000),
                             .self = options->self,
                             .script_out = options->script_out,
                             .seed = options->seed},
                            log);
    };
    run_study(*options, {.label = "topology", .keeps_folder = false}, study, outcome);
  });
}

}  // namespace

void add_validate(CLI::App& app, Outcome& outcome) {
  auto* verb = app.get_subcommand("validate");
  verb->require_subcommand(1);
  add_validate_topology(*verb, outcome);
  add_validate_conservation(*verb, outcome);
  add_validate_contact(*verb, outcome);
  add_validate_order(*verb, outcome);
  add_validate_solvers(*verb, outcome);
  add_validate_judges(*verb, outcome);
  add_validate_drawn(*verb, outcome);
  add_validate_elements(*verb, app, outcome);
}

}  // namespace dartboard
