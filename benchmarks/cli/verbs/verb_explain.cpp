#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "benchmarks/cli/scene_names.h"
#include "benchmarks/cli/verbs/verbs.h"
#include "benchmarks/harness/clock.h"
#include "benchmarks/harness/json_text.h"
#include "benchmarks/harness/statistics.h"
#include "benchmarks/harness/tell.h"
#include "benchmarks/studies/scenes/explain_report.h"
#include "benchmarks/studies/scenes/unit_costs.h"
#include "core/scene/file/scene_problem.h"
#include "core/scene/plan/measured_plan.h"
#include "core/scene/plan/system_arrays.h"
#include "core/scene/run/scene_run.h"
#include "core/scene/run/simulation.h"
#include "core/time/system/accelerations.h"
#include "validation/recommend/settle_accuracy.h"

namespace dartboard {
namespace {

struct ExplainOptions {
  std::string scene;
  bool measure = false, json = false;
};

/// The present speed of the machine: force evaluations of the scene at rest. It changes by a third within seconds where
/// clocks are raised or neighbours work, so an estimate and a run are compared at one speed.
class Pace {
 public:
  Pace(const Problem& problem, const BodyNeeds& needs) : arrays_(problem, needs), a_(arrays_.x.size()) {}

  /// [ns] of one evaluation, now.
  double ns() {
    constexpr double enough = 2e6;
    std::vector<double> each;
    for (double spent = 0.0; spent < enough;) {
      const std::int64_t start = thread_cpu_ns();
      for (int k = 0; k < 8; ++k) accelerations(arrays_.system(), {}, arrays_.x, arrays_.v, a_);
      each.push_back(static_cast<double>(thread_cpu_ns() - start));
      spent += each.back() + 1.0;
    }
    return median(each) / 8;
  }

 private:
  SystemArrays arrays_;
  std::vector<Eigen::Vector3d> a_;
};

/// The median of three runs, at the pace of the estimate.
double measured_ns(const SceneFile& scene, Pace& pace, double estimated_at) {
  std::vector<double> runs;
  for (int run = 0; run < 3; ++run) {
    Simulation simulation(scene);
    RunWatcher nobody;
    const double before = pace.ns();
    const std::int64_t start = thread_cpu_ns();
    run_scene(simulation, scene.output, nobody);
    const auto ns = static_cast<double>(thread_cpu_ns() - start);
    const double now = (before + pace.ns()) / 2;
    runs.push_back(ns / std::max(1.0, static_cast<double>(simulation.steps_done())) * estimated_at / now);
  }
  return median(runs);
}

void explain(const ExplainOptions& options, Outcome& outcome) {
  SceneFile scene = read_named_scene(options.scene);
  const std::optional<SettledAccuracy> settled = settle_with_progress(scene, options.json);
  const Problem problem = make_problem(scene);
  ScenePlan plan = plan_scene(scene, problem);
  Pace pace(problem, plan.needs.body);
  const double before = pace.ns();
  add_times(plan, scene, measure_unit_costs(scene, problem, plan));
  const double estimated_at = (before + pace.ns()) / 2;
  // building body and events finds whatever they refuse in the scene
  add_bytes(plan, measured_memory(scene));
  std::optional<double> measured;
  if (options.measure) measured = measured_ns(scene, pace, estimated_at);
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

void add_explain(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<ExplainOptions>();
  auto* verb = app.add_subcommand(
      "explain",
      "The plan of a scene before it runs: what will be there and why, its bytes and time, what is left out.");
  verb->add_option("SCENE", options->scene, "a scene file (dartboard scene --keys), or the name of one of the gallery")
      ->required();
  verb->add_flag("--measure", options->measure, "run it, and print its time next to the estimate");
  verb->add_flag("--json", options->json, "print JSON");
  verb->callback([options, &outcome] { explain(*options, outcome); });
}

}  // namespace dartboard
