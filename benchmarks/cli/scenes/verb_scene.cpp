#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "benchmarks/cli/scene_names.h"
#include "benchmarks/cli/scenes/scene_verbs.h"
#include "benchmarks/cli/scenes/simulation_json.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/tell.h"
#include "core/base/counted.h"
#include "core/scene/file/keys/scene_pages.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/run/body_in_words.h"
#include "core/scene/run/simulation.h"
#include "core/scene/survey/scene_warnings.h"

namespace dartboard {
namespace {

void check_scene(const std::string& given, bool as_json) {
  SceneFile scene = read_named_scene(given);
  tell_notices(scene);
  if (scene.accuracy) {
    // all but the step can be checked; any step will do for that
    scene.step = scene.duration > 0.0 ? scene.duration : 1.0;
    if (scene.integrator.empty()) scene.integrator = "rk4";
    scene.unstable_step = UnstableStep::warn;
  }
  const Problem problem = make_problem(scene);
  const Simulation simulation(scene, problem);
  const SceneSurvey survey = survey_scene(scene, problem, simulation);
  const CellCounts n = simulation.body().counts();
  const std::vector<std::string> warnings =
      scene.accuracy ? std::vector<std::string>{} : warnings_of(scene, survey, simulation);
  if (as_json) {
    const nlohmann::ordered_json json{{"scene", scene.file},
                                      {"map", simulation.body().map_name()},
                                      {"vertices", n.vertices},
                                      {"edges", n.edges},
                                      {"faces", n.faces},
                                      {"cells", n.cells},
                                      {"components", n.components},
                                      {"body", in_words(simulation.body())},
                                      {"selections", to_json(survey.selections)},
                                      {"warnings", warnings}};
    return tell("{}\n", json_text(json, 2));
  }
  const std::string steps = scene.accuracy
                                ? fmt::format("steps to be chosen for an accuracy of {:.6g}", *scene.accuracy)
                                : fmt::format("{} of {:.6g} s", counted(simulation.step_count(), "step"), scene.step);
  tell("{}: {}, {} vertices, {} edges, {} faces, {} cells in {}; {}, {}\n", terminal_text(scene.file),
       map_in_words(simulation.body().map_name()), n.vertices, n.edges, n.faces, n.cells,
       counted(n.components, "component"), steps, counted(scene.events.size(), "event"));
  tell("{}\n", in_words(simulation.body()));
  for (const SelectionCount& count : survey.selections) tell("{}\n", to_string(count));
  for (const std::string& note : survey.notes) tell("note: {}\n", note);
  for (const std::string& warning : warnings) tell(stderr, "warning: {}\n", warning);
}

}  // namespace

void add_scene(CLI::App& app, Outcome& outcome) {
  struct Options {
    bool schema = false, json = false;
    std::string object, check;
  };
  auto options = std::make_shared<Options>();
  auto* verb = app.get_subcommand("scene");
  auto* what = verb->add_option_group("what");
  what->add_flag("--schema", options->schema, "print the JSON Schema of scene files");
  auto* keys =
      what->add_option("--keys", options->object,
                       "print the reference page of all keys, in Markdown, or what it says about one object or key")
          ->expected(0, 1)
          ->type_name("[NAME]");
  what->add_option("--check", options->check, "read and assemble a scene, and run nothing");
  what->require_option(1);
  verb->add_flag("--json", options->json, "print JSON; schemas are JSON anyway");
  verb->callback([options, keys, &outcome] {
    outcome.exit_code = exit_agrees;
    if (options->schema) tell("{}\n", json_text(scene_schema(), 2));
    if (keys->count() > 0) tell("{}", options->object.empty() ? scene_reference() : scene_reference(options->object));
    if (!options->check.empty()) check_scene(options->check, options->json);
  });
}

}  // namespace dartboard
