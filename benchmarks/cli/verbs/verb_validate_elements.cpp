#include <algorithm>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/cli/studies/named_mesh.h"
#include "benchmarks/cli/studies/study_options.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/elements/calculix_study.h"
#include "benchmarks/studies/elements/element_costs.h"
#include "benchmarks/studies/elements/elements_study.h"
#include "benchmarks/studies/elements/operated_study.h"
#include "core/meshes/generators/mesh_generators.h"

namespace dartboard {
namespace {

OperatedPlan operated_plan(const std::vector<std::string>& meshes, std::size_t operations, std::uint64_t seed) {
  OperatedPlan plan;
  plan.each = {.operations = operations, .check_every = std::max<std::size_t>(1, operations / 100), .seed = seed};
  for (const std::string& mesh : meshes)
    plan.bodies.emplace_back(std::filesystem::path(mesh).filename().string(), find_mesh(mesh).make());
  if (meshes.empty()) {
    const auto liver = source_folder() / "benchmarks/meshes/liver564.mesh";
    plan.bodies.emplace_back(liver.filename().string(), find_mesh(liver.string()).make());
    plan.bodies.emplace_back("box of all kinds of cell", mixed_box(6, 6, 6, 0.1));
  }
  return plan;
}

// A verb that help does not show.
void add_measure_elements(CLI::App& app) {
  auto plan = std::make_shared<ElementCostPlan>();
  auto* verb =
      app.add_subcommand("measure-elements", "Time elements in this process (used by validate elements).")->group("");
  verb->add_option("--process", plan->process);
  verb->add_option("--rounds", plan->rounds)->check(positive_number());
  verb->add_option("--evaluations", plan->evaluations)->check(positive_number());
  verb->add_option("--across", plan->across)->check(positive_number());
  verb->callback([plan] {
    measure_element_costs(*plan, [](const Sample& sample) { tell("{}\n", json_text(nlohmann::json(sample))); });
  });
}

}  // namespace

void add_validate_elements(CLI::App& validate, CLI::App& app, Outcome& outcome) {
  struct Options : StudyOptions {
    ElementsPlan plan;
    std::optional<std::size_t> operations;
    std::vector<std::string> meshes;
    std::string with;
  };
  auto* verb = validate.add_subcommand(
      "elements",
      "A clamped beam by springs and by elements, compared with quadratic ones: errors and cost of each model");
  auto options = study_options<Options>(
      *verb, {.quick = "coarse meshes", .seed = "the random operations", .keeps_folder = false, .goes_on = true});
  auto* operations =
      verb->add_option("--operations", options->operations,
                       "in place of the beam: cut, tear and erode bodies of elements, and of two materials by region, "
                       "so many times each, and hold energies, forces, masses and materials against other code");
  operations->check(positive_number());
  verb->add_option("MESH", options->meshes, "mesh files, or names of meshes of the project [liver564.mesh and a box]")
      ->needs(operations);
  verb->add_option("--with", options->with,
                   "another program that bends the same beams: calculix, which is `ccx` of the package calculix-ccx")
      ->check(CLI::IsMember({"calculix"}))
      ->excludes(operations);
  verb->callback([options, &outcome] {
    options->plan.quick = options->quick;
    if (options->operations) {
      const OperatedPlan plan = operated_plan(options->meshes, *options->operations, options->seed);
      return run_study(
          *options, {.label = "elements", .keeps_folder = false},
          [&](StudyLog& log) { return operated_study(plan, log); }, outcome);
    }
    if (!options->with.empty()) {
      options->plan.calculix_version = calculix_version();
      options->plan.calculix = run_calculix;
    }
    run_study(
        *options, {.label = "elements", .keeps_folder = false},
        [&](StudyLog& log) { return elements_study(options->plan, log); }, outcome);
  });
  add_measure_elements(app);
}

}  // namespace dartboard
