// dartboard VERB: the verbs of scenes and meshes, over core alone. For all others it becomes dartboard-harness.

#include <optional>

#include "benchmarks/cli/hand_over.h"
#include "benchmarks/cli/program.h"
#include "benchmarks/cli/scenes/scene_verbs.h"
#include "benchmarks/cli/verb_names.h"

using namespace dartboard;

int main(int argc, char** argv) {
  return run_program(argc, argv, [argc, argv](CLI::App& app, Outcome& outcome) {
    // the choice of a step for an accuracy is the harness's
    const auto choose_step = [argv](SceneFile& scene, bool) -> std::optional<SettledAccuracy> {
      if (scene.accuracy) hand_over_to_harness(argv);
      return {};
    };
    if (argc > 1 && is_of_harness(argv[1])) hand_over_to_harness(argv);
    add_simulate(app, outcome, choose_step);
    add_scene(app, outcome);
    add_explain(app, outcome, choose_step);
    add_mesh(app, outcome);
  });
}
