#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>
#include <vector>

#include "benchmarks/cli/scene_names.h"
#include "benchmarks/cli/scenes/explain_report.h"
#include "benchmarks/cli/scenes/scene_verbs.h"
#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/statistics.h"
#include "benchmarks/harness/tell.h"
#include "core/scene/plan/scene_plan.h"
#include "core/scene/run/scene_run.h"
#include "core/scene/run/simulation.h"

namespace dartboard {
namespace {

struct ExplainOptions {
  std::string scene;
  bool measure = false, json = false;
};

/// The median of three runs, each of a second at most.
MeasuredSteps measured_steps(const SceneFile& scene) {
  struct Limit : RunWatcher {
    std::int64_t end = std::numeric_limits<std::int64_t>::max();
    bool interrupts() override { return thread_cpu_ns() >= end; }
  };
  MeasuredSteps measured;
  std::vector<double> runs;
  for (int run = 0; run < 3; ++run) {
    Simulation simulation(scene);
    Limit limit;
    const std::int64_t start = thread_cpu_ns();
    if (run == 0) limit.end = start + 1'000'000'000;
    run_scene(simulation, scene.output, limit, run == 0 ? std::nullopt : std::optional(measured.steps));
    runs.push_back(static_cast<double>(thread_cpu_ns() - start));
    measured.steps = simulation.steps_done();
  }
  measured.ns = median(runs) / std::max(1.0, static_cast<double>(measured.steps));
  return measured;
}

void explain(const ExplainOptions& options, const StepChoice& choose_step, Outcome& outcome) {
  SceneFile scene = read_named_scene(options.scene);
  const std::optional<SettledAccuracy> settled = choose_step(scene, options.json);
  tell_notices(scene);
  const ScenePlan plan = plan_scene(scene);
  std::optional<MeasuredSteps> measured;
  if (options.measure) measured = measured_steps(scene);
  outcome.exit_code = plan.unplanned.empty() ? exit_agrees : exit_disagrees;
  if (options.json) {
    nlohmann::ordered_json json = to_json(scene, plan, measured);
    if (settled) json["settled"] = nlohmann::json(*settled);
    tell("{}\n", json_text(json, 2));
  } else {
    if (settled) tell("{}\n", to_string(*settled));
    tell("{}", to_text(scene, plan, measured));
  }
}

}  // namespace

void add_explain(CLI::App& app, Outcome& outcome, StepChoice choose_step) {
  auto options = std::make_shared<ExplainOptions>();
  auto* verb = app.get_subcommand("explain");
  verb->add_option("SCENE", options->scene, "a scene file (dartboard scene --keys), or the name of one of the gallery")
      ->required();
  verb->add_flag("--measure", options->measure, "run it for up to a second, three times, and print the time of a step");
  verb->add_flag("--json", options->json, "print JSON");
  verb->callback(
      [options, choose_step = std::move(choose_step), &outcome] { explain(*options, choose_step, outcome); });
}

}  // namespace dartboard
