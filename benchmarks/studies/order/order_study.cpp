#include "benchmarks/studies/order/order_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <utility>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/harness/clock.h"
#include "benchmarks/studies/order/order_report.h"
#include "benchmarks/studies/order/scene_order_report.h"
#include "core/plain/error.h"
#include "validation/scenes/scene_of_file.h"

namespace dartboard {
namespace {

constexpr double quick_error = 0.05;  // upper end of the window of a quick run

std::vector<const IntegratorEntry*> wanted(const OrderPlan& plan) {
  for (const std::string& name : plan.integrators) (void)make_integrator(name);  // throws for an unknown name
  std::vector<const IntegratorEntry*> entries;
  for (const IntegratorEntry& entry : integrators())
    if (plan.integrators.empty() || std::ranges::find(plan.integrators, entry.name) != plan.integrators.end())
      entries.push_back(&entry);
  return entries;
}

double most_error(const OrderPlan& plan) { return plan.quick ? quick_error : OrderOptions{}.most_error; }

std::string marks_text(const OrderPlan& plan) {
  return fmt::format("^ error above {:g}, ~ not within 0.1, _ near the floor of the reference, ! no result",
                     most_error(plan));
}

OrderResults measure(const OrderPlan& plan, StudyLog& log) {
  OrderResults results;
  const auto entries = wanted(plan);
  log.begin("validate order", std::size(order_cases) * (entries.size() + 1) + entries.size() + 2);
  OrderOptions order;
  order.most_error = most_error(plan);  // methods of order 1 get to a larger one two halvings earlier
  for (const OrderCase which : order_cases) {
    const OrderStage stage = order_stage(which);
    results.references.push_back({which, stage.certified});
    log.advance(fmt::format("{}: reference", name(which)));
    for (const IntegratorEntry* entry : entries) {
      results.studies.push_back(study_order(stage, *entry, order));
      log.advance(fmt::format("{}: {}", name(which), entry->name));
    }
    if (which == OrderCase::undamped) results.force = compare_forces_with_energy(stage.scene);
    if (which == OrderCase::aligned_cut || which == OrderCase::unaligned_cut) {
      const TradeoffScene& scene = stage.scene;
      for (const CutJump& jump : cut_jumps(scene, *make_integrator("blanes-moan-4"), 0.5 / scene.fastest_rate))
        results.jumps.push_back(jump);
    }
  }
  for (const IntegratorEntry* entry : entries) {
    if (entry->make()->scheme().amplification == nullptr)
      results.no_discrete.emplace_back(entry->name);
    else
      for (const double zeta : {0.0, 1e-5})
        results.discrete.push_back(compare_with_discrete_map(*entry, zeta, plan.quick ? 10000 : 100000));
    log.advance(fmt::format("discrete map: {}", entry->name));
  }
  results.drift = measure_energy_drift(plan.quick ? 1000 : 10000, 20.0);
  log.advance("energy-momentum at large steps");
  results.factor = compare_kept_factor(100, source_folder() / "benchmarks" / "meshes");
  log.advance("a factor that is kept");
  return results;
}

/// Find the reference of a scene, and the orders of the integrators.
///
/// throws  SolverError without a reference
void observe(const TradeoffScene& scene, const OrderPlan& plan, StudyLog& log, SceneOrders& found) {
  for (const std::string& omission : scene.omissions) log.say(omission);
  ReferenceOptions how{.low_floor = true};
  if (plan.quick) how = {.oracle_s = 2.0, .self_converged_s = 3.0};
  log.say(fmt::format("{}: computing a reference: runs of up to {:.0f} s each", scene.name,
                      scene.beyond_references.empty() ? how.oracle_s : how.self_converged_s));
  found.reference = reference_of(scene, thread_cpu_ns, how);
  log.say(fmt::format("reference: {}; floor {:.1e} edges, {:.1f} s", found.reference.what, found.reference.floor,
                      found.reference.cpu_s));
  const auto entries = wanted(plan);
  log.begin("validate order on " + scene.name, entries.size());
  SceneOrderOptions options;
  options.order.most_error = most_error(plan);
  if (plan.quick) options.most_s = 1.0;
  found.limit = order_limit(scene);
  for (const IntegratorEntry* entry : entries) {
    found.orders.push_back(observe_order(scene, found.reference, *entry, thread_cpu_ns, options));
    log.advance(entry->name);
  }
}

Report scene_order_study(const OrderPlan& plan, StudyLog& log) {
  (void)wanted(plan);
  std::vector<SceneOrders> found;
  std::vector<TradeoffScene> scenes(plan.scenes.size());
  // a motion that cannot be followed leaves its scene untested
  const auto unless_unsolved = [&](std::size_t k, const std::function<void()>& work) {
    try {
      if (found[k].failure.empty()) work();
    } catch (const SolverError& error) {
      found[k].failure = error.what();
      log.say(found[k].failure);
    }
  };
  for (std::size_t k = 0; k < scenes.size(); ++k) {
    found.push_back({.name = std::filesystem::path(plan.scenes[k]).stem().string(), .reference = {}});
    unless_unsolved(k, [&] { scenes[k] = find_scene(plan.scenes[k], source_folder() / "benchmarks" / "meshes"); });
  }
  for (std::size_t k = 0; k < scenes.size(); ++k) unless_unsolved(k, [&] { observe(scenes[k], plan, log, found[k]); });
  Report report;
  report.claims = claims_of(found);
  report.tables = {{"references", "The references of the scenes", scene_reference_table(found)},
                   {"orders", "Observed orders", scene_order_table(found), marks_text(plan)}};
  report.numbers = to_json(found, report.claims);
  report.data_files = {{"order.json", report.numbers}};
  return report;
}

}  // namespace

Report order_study(const OrderPlan& plan, StudyLog& log) {
  if (!plan.scenes.empty()) return scene_order_study(plan, log);
  const OrderResults results = measure(plan, log);
  Report report;
  report.claims = claims_of(results);
  report.tables = {
      {"references", "The references: a box of 3 x 3 x 3 cubes for 16.5 / omega_max, " + references_heading(results),
       oracle_table(results)},
      {"orders", "Observed orders", order_table(results),
       marks_text(plan) + "; over two halvings across the unaligned cut"},
      {"discrete", "Against the exact maps of the methods", discrete_table(results)}};
  report.numbers = to_json(results, report.claims);
  report.data_files = {{"order.json", report.numbers}};
  return report;
}

}  // namespace dartboard
