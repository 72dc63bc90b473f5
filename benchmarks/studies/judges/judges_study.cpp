#include "benchmarks/studies/judges/judges_study.h"

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "benchmarks/harness/clock.h"
#include "benchmarks/studies/judges/judges_report.h"
#include "core/meshes/generators/mesh_generators.h"
#include "core/time/integrators.h"
#include "validation/judges/followed_trials.h"

namespace dartboard {
namespace {

// A quick run takes every eleventh case: with sixteen integrators to a scene, all of them come up.
constexpr std::size_t quick_stride = 11;

std::vector<ExtremeCase> cases_of(const JudgesPlan& plan) {
  std::vector<ExtremeCase> cases;
  for (const ExtremeAxis& axis : extreme_axes()) {
    if (!plan.axis.empty() && plan.axis != axis.name) continue;
    // every run of these is diagnosed, whatever the integrator: a wrong integrator makes no difference
    if (plan.axis.empty() && (axis.name == "input" || axis.name == "injected")) continue;
    std::vector<ExtremeCase> all = extreme_cases(axis.name, true);
    for (std::size_t k = 0; k < all.size(); k += plan.quick ? quick_stride : 1) cases.push_back(std::move(all[k]));
  }
  return cases;
}

std::vector<IntegratorEntry> methods_of(const JudgesPlan& plan) {
  std::vector<IntegratorEntry> methods;
  for (const IntegratorEntry& entry : integrators())
    if (!plan.quick || entry.name == "verlet" || entry.name == "rk4" || entry.name == "sdirk2")
      methods.push_back(entry);
  return methods;
}

}  // namespace

Report judges_study(const JudgesPlan& plan, StudyLog& log) {
  if (!plan.axis.empty()) (void)extreme_cases(plan.axis, true);  // throws for an unknown axis
  JudgesResults results;
  const std::vector<ExtremeCase> cases = cases_of(plan);
  log.begin("validate judges: wrong integrators at the extremes", cases.size());
  ExtremesTrial extremes;
  for (const ExtremeCase& which : cases) {
    extremes.take(which);
    log.advance(which.axis);
  }
  results.trials = extremes.trials();
  results.slack = extremes.slack();
  if (plan.axis.empty()) {
    const auto add = [&results](std::vector<JudgeTrial> trials) {
      std::ranges::move(trials, std::back_inserter(results.trials));
    };
    // a wrong integrator may have any order: it would halve steps until the time is used up
    const OrderOptions options{.most_error = 0.05, .most_steps = 24 << 7, .most_implicit_steps = 24 << 7};
    log.begin("validate judges: wrong integrators and their orders", 6);
    for (const OrderCase which : {OrderCase::undamped, OrderCase::damped}) {
      add(try_order(order_stage(which), methods_of(plan), options));
      log.advance(name(which));
    }
    for (const double zeta : {0.0, 1e-5}) {
      add(try_exact_maps(zeta, plan.quick ? 1000 : 10000));
      log.advance("exact maps");
    }
    // a motion that is known exactly, and one with dampers
    std::vector<IntegratorEntry> plain = methods_of(plan);
    std::erase_if(plain, [](const IntegratorEntry& entry) { return entry.make()->scheme().compensated; });
    TradeoffScene damped = stiff_scene("damped", kuhn_box(2, 2, 2, 0.1, 0.2, 3), 1.0, {.damped = true});
    damped.name = "a damped box";
    for (const TradeoffScene& scene : {chain_scene(8, 64.0), damped}) {
      add(try_followed(scene, reference_of(scene, thread_cpu_ns, {.gain = false}), plain, 1e-5, thread_cpu_ns));
      log.advance("recommend --verify");
    }
  }
  Report report;
  report.claims = claims_of(results);
  report.tables = {{"judges", "Judges of integrators, and what they rest on", judges_table(results)},
                   {"others", "Studies that do not judge integrators", others_table()},
                   {"trials", "Wrong integrators seen, of those whose results differ", trials_table(results)},
                   {"slack", "Steps of sound integrators in the matrix of extremes", slack_table(results)}};
  if (Table unseen = unseen_table(results); !unseen.rows().empty())
    report.tables.push_back({"unseen",
                             "Not seen: the difference is below what rounding, or the tolerance of a solver, "
                             "explains",
                             std::move(unseen)});
  report.limits = {
      "A wrong integrator is not seen where its fault is below rounding, or below what a solver promises."};
  report.numbers = to_json(results);
  report.data_files = {{"judges.json", report.numbers}};
  return report;
}

}  // namespace dartboard
