#include "benchmarks/studies/elements/element_costs.h"

#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>
#include <utility>

#include "core/time/system/accelerations.h"
#include "core/time/watch/stable_step.h"
#include "core/topology/storage/hash.h"
#include "validation/elements/cantilever.h"

namespace dartboard {
namespace {

constexpr std::pair<Model, CellKind> timed_models[] = {{Model::springs, CellKind::tetrahedron},
                                                       {Model::neo_hookean, CellKind::tetrahedron},
                                                       {Model::corotational, CellKind::tetrahedron},
                                                       {Model::stvk, CellKind::tetrahedron},
                                                       {Model::neo_hookean, CellKind::hexahedron}};

/// A body that is bent a little, its forces taken over and over.
struct Timed {
  ModelCost cost;
  std::unique_ptr<SimulatedBody> body;
  std::vector<Eigen::Vector3d> a;

  Timed(Model model, CellKind cells, int across)
      : cost{model, cells}, body(cantilever_body(model, across, 0.25, cells)) {
    for (Eigen::Vector3d& x : body->motion().x) x[2] += 0.05 * x[0] * x[0];
    const SpringSystem system = body->system();
    a.resize(system.vertex_count());
    cost.pieces = system.springs.size();
    for (const ForceTerm* term : system.terms) cost.pieces += term->size();
  }
  void run(int evaluations) {
    const SpringSystem system = body->system();
    for (int k = 0; k < evaluations; ++k)
      accelerations(system, {}, body->vertices().position, body->vertices().velocity, a);
  }
  std::uint64_t hash() const {
    Hash hash;
    hash.add(a);
    return hash.value();
  }
};

std::vector<Timed> timed_bodies(int across) {
  std::vector<Timed> bodies;
  for (const auto& [model, cells] : timed_models) bodies.emplace_back(model, cells, across);
  return bodies;
}

Figure times(double factor, Figure figure) {
  figure.median *= factor;
  figure.interval.low *= factor;
  figure.interval.high *= factor;
  return figure;
}

}  // namespace

std::string in_words(Model model, CellKind cells) {
  if (model == Model::springs) return "springs";
  return fmt::format("{} {}", name(model), cells == CellKind::hexahedron ? "hexahedra" : "tetrahedra");
}

void measure_element_costs(const ElementCostPlan& plan, const std::function<void(const Sample&)>& sink) {
  std::vector<Timed> bodies = timed_bodies(plan.across);
  std::vector<TimedTask> tasks;
  for (Timed& t : bodies)
    tasks.push_back({in_words(t.cost.model, t.cost.cells), [] {}, [&t, &plan] { t.run(plan.evaluations); },
                     [&t] { return t.hash(); }});
  run_rounds(tasks, {.rounds = plan.rounds, .process = plan.process}, sink);
}

std::vector<ModelCost> element_costs(const ElementCostPlan& plan, StudyLog& log) {
  std::vector<Sample> samples;
  for (int process = 0; process < plan.processes; ++process)
    log.measure({"measure-elements", "--process", std::to_string(process), "--rounds", std::to_string(plan.rounds),
                 "--evaluations", std::to_string(plan.evaluations), "--across", std::to_string(plan.across)},
                [&](const nlohmann::json& json) { samples.push_back(json.get<Sample>()); });
  check_repeats(samples);
  std::vector<ModelCost> costs;
  for (Timed& t : timed_bodies(plan.across)) {
    ModelCost& cost = t.cost;
    const std::string task = in_words(cost.model, cost.cells);
    cost.frequency = StableStepEstimate().refresh(t.body->system(), t.body->vertices().position).upper;
    cost.ns = times_of(samples, task).cpu_median / plan.evaluations;
    if (!costs.empty())
      cost.over_springs = times(cost.frequency / costs[0].frequency,
                                paired_ratio(samples, task, in_words(costs[0].model, costs[0].cells)).cpu);
    costs.push_back(cost);
  }
  return costs;
}

}  // namespace dartboard
