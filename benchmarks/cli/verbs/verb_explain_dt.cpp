#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "benchmarks/cli/scene_names.h"
#include "benchmarks/cli/studies/settle_with_progress.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/scenes/step_explanation.h"

namespace dartboard {
namespace {

struct ExplainDtOptions {
  std::string scene;
  bool json = false;
};

void explain_dt(const ExplainDtOptions& options, Outcome& outcome) {
  SceneFile scene = read_named_scene(options.scene);
  const std::optional<SettledAccuracy> settled = settle_with_progress(scene, options.json);
  tell_notices(scene);
  const StepExplanation explanation = explain_step(scene);
  outcome.exit_code = scene.step <= explanation.limit.stable ? exit_agrees : exit_disagrees;
  if (options.json) {
    nlohmann::ordered_json json = to_json(explanation, scene);
    if (settled) json["settled"] = nlohmann::json(*settled);
    tell("{}\n", json_text(json, 2));
  } else {
    if (settled) tell("{}\n", to_string(*settled));
    tell("{}", to_text(explanation, scene));
  }
}

}  // namespace

void add_explain_dt(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<ExplainDtOptions>();
  auto* verb = app.get_subcommand("explain-dt");
  verb->add_option("SCENE", options->scene, "a scene file (dartboard scene --keys), or the name of one of the gallery")
      ->required();
  verb->add_flag("--json", options->json, "print JSON");
  verb->callback([options, &outcome] { explain_dt(*options, outcome); });
}

}  // namespace dartboard
