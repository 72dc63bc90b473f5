#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "benchmarks/cli.h"
#include "benchmarks/clock.h"
#include "benchmarks/json_text.h"
#include "benchmarks/scene_names.h"
#include "benchmarks/settle_accuracy.h"
#include "benchmarks/statistics.h"
#include "benchmarks/table.h"
#include "benchmarks/tell.h"
#include "benchmarks/unit_costs.h"
#include "core/scene/measured_plan.h"
#include "core/scene/scene_problem.h"
#include "core/scene/scene_run.h"
#include "core/scene/simulation.h"
#include "core/scene/system_arrays.h"
#include "core/time/accelerations.h"

namespace dartboard {
namespace {

struct Options {
  std::string scene;
  bool measure = false, json = false;
};

/// What --measure adds: the bytes of each item, and the time of the run.
struct Measured {
  MeasuredPlan found;
  bool equal = true;
  std::size_t total = 0;
  double ns = 0.0;  // per step, events and output included, at the pace of the estimate; nothing is written
};

/// How fast the machine is just now: force evaluations of the scene at rest. It changes by a third within seconds where
/// clocks are raised or neighbours work, so an estimate and a run are compared at one speed.
class Pace {
 public:
  Pace(const Problem& problem, const MeshTally& counts) : arrays_(problem, counts), a_(arrays_.x.size()) {}

  /// [ns] of one, now.
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

Measured measure(const SceneFile& scene, const ScenePlan& plan, Pace& pace, double estimated_at) {
  Measured m;
  m.found = measured_plan(scene, plan);
  m.equal = m.found.unplanned.empty();
  for (std::size_t k = 0; k < plan.items.size(); ++k) {
    m.total += m.found.bytes[k];
    m.equal = m.equal && m.found.bytes[k] == plan.items[k].bytes;
  }
  for (const MemoryItem& item : m.found.unplanned) m.total += item.bytes;
  m.ns = measured_ns(scene, pace, estimated_at);
  return m;
}

std::string counted(const ScenePlan& plan) {
  return fmt::format("{} vertices, {} edges, {} faces, {} cells, {} darts", plan.counts.vertices, plan.counts.edges,
                     plan.counts.faces, plan.counts.cells, plan.counts.darts);
}

std::string time_text(double ns, double below = 0.0) {
  return below > 0.0 ? fmt::format("not measurable (< {:.0f})", std::max(1.0, below))
         : ns == 0.0 ? ""
                     : fmt::format("{:.0f}", ns);
}

void print(const SceneFile& scene, const ScenePlan& plan, const std::optional<Measured>& measured) {
  tell("{}\n{}; {}; {} steps of {:.6g} s\n\n", one_line(scene.name), plan.map, counted(plan), plan.steps, scene.step);
  std::vector<Column> columns{{"part", Align::left}, {"bytes", Align::right}};
  if (measured) columns.push_back({"measured", Align::right});
  columns.insert(columns.end(), {{"ns per step", Align::right}, {"what", Align::left}, {"why", Align::left}});
  Table table(columns);
  const auto row = [&](const std::string& part, std::size_t bytes, std::size_t found, const std::string& ns,
                       const std::string& what, const std::string& why) {
    std::vector<std::string> cells{part, fmt::format("{}", bytes)};
    if (measured) cells.push_back(fmt::format("{}{}", found, found == bytes ? "" : " DIFFERS"));
    cells.insert(cells.end(), {ns, what, why});
    table.add_row(cells);
  };
  for (std::size_t k = 0; k < plan.items.size(); ++k) {
    const PlanItem& item = plan.items[k];
    row(std::string(name(item.part)), item.bytes, measured ? measured->found.bytes[k] : 0,
        time_text(item.ns, item.ns_below), item.what, item.why);
  }
  if (measured)
    for (const MemoryItem& item : measured->found.unplanned)
      row(std::string(name(item.part)), 0, item.bytes, "", "not planned", "");
  row("in all", plan.bytes(), measured ? measured->total : 0, time_text(plan.ns()), "", "");
  Table without({{"left out", Align::left}, {"because", Align::left}});
  for (const LeftOut& item : plan.left_out) without.add_row({item.what, item.why});
  tell("{}\n{}\n", to_text(table), to_text(without));
  tell(
      "Bytes are those of the elements of all containers that live as long as the run, at the start; of a factor, its "
      "numbers.\nTimes are estimates from unit costs measured just now on arrays of this size, averaged over the run, "
      "output in memory included.\nNot in them: building the body, writing files, what stress tears, steps divided by "
      "/unstable_step.\n");
  if (!measured) return;
  tell("\nmeasured: {:.0f} ns per step, {:+.1f} % from the estimate; bytes {}\n", measured->ns,
       100.0 * (measured->ns / plan.ns() - 1.0), measured->equal ? "exactly as planned" : "DIFFER");
}

nlohmann::ordered_json to_json(const SceneFile& scene, const ScenePlan& plan, const std::optional<Measured>& measured) {
  nlohmann::ordered_json json{{"scene", scene.name},
                              {"map", plan.map},
                              {"integrator", scene.integrator},
                              {"steps", plan.steps},
                              {"counts",
                               {{"vertices", plan.counts.vertices},
                                {"edges", plan.counts.edges},
                                {"faces", plan.counts.faces},
                                {"cells", plan.counts.cells},
                                {"darts", plan.counts.darts}}},
                              {"bytes", plan.bytes()},
                              {"ns_per_step", plan.ns()}};
  json["plan"] = json["left_out"] = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < plan.items.size(); ++k) {
    const PlanItem& item = plan.items[k];
    json["plan"].push_back({{"part", name(item.part)},
                            {"what", item.what},
                            {"why", item.why},
                            {"bytes", item.bytes},
                            {"ns_per_step", item.ns}});
    if (item.ns_below > 0.0) json["plan"].back()["ns_per_step_below"] = item.ns_below;
    if (measured) json["plan"].back()["measured_bytes"] = measured->found.bytes[k];
  }
  for (const LeftOut& item : plan.left_out) json["left_out"].push_back({{"what", item.what}, {"why", item.why}});
  if (measured) {
    json["measured"] = {
        {"bytes", measured->total}, {"bytes_as_planned", measured->equal}, {"ns_per_step", measured->ns}};
    for (const MemoryItem& item : measured->found.unplanned)
      json["measured"]["unplanned"].push_back({{"part", name(item.part)}, {"bytes", item.bytes}});
  }
  return json;
}

void explain(const Options& options, Outcome& outcome) {
  SceneFile scene = read_scene(scene_file(options.scene));
  const std::optional<SettledAccuracy> settled = settle_accuracy(scene, thread_cpu_ns);
  const Problem problem = make_problem(scene);
  ScenePlan plan = plan_scene(scene, problem);
  Pace pace(problem, plan.counts);
  const double before = pace.ns();
  add_times(plan, scene, measure_unit_costs(scene, problem, plan));
  const double estimated_at = (before + pace.ns()) / 2;
  // the plan is made: what the body or an event of the scene refuses is found by building them
  { const Simulation refuses_or_not(with_events_held_back(scene)); }
  std::optional<Measured> measured;
  if (options.measure) measured = measure(scene, plan, pace, estimated_at);
  outcome.exit_code = !measured || measured->equal ? exit_agrees : exit_disagrees;
  if (options.json) {
    nlohmann::ordered_json json = to_json(scene, plan, measured);
    if (settled) json["settled"] = nlohmann::json(*settled);
    tell("{}\n", json_text(json, 2));
  } else {
    if (settled) tell("{}\n", to_string(*settled));
    print(scene, plan, measured);
  }
}

}  // namespace

void add_explain(CLI::App& app, Outcome& outcome) {
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand(
      "explain",
      "The plan of a scene before it runs: what will be there and why, its bytes and time, what is left out.");
  verb->add_option("SCENE", options->scene, "a scene file (dartboard scene --keys), or the name of one of the gallery")
      ->required();
  verb->add_flag("--measure", options->measure, "build it, run it, and print what it took beside the plan");
  verb->add_flag("--json", options->json, "print JSON");
  verb->callback([options, &outcome] { explain(*options, outcome); });
}

}  // namespace dartboard
