#include "benchmarks/studies/solvers/solver_study.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>
#include <utility>

#include "benchmarks/harness/clock.h"
#include "benchmarks/studies/solvers/solver_report.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

constexpr std::string_view parts[]{"accuracy", "edits", "updates", "crossover", "steps"};

bool wants(const SolverPlan& plan, std::string_view part) {
  return plan.only.empty() || std::ranges::find(plan.only, part) != plan.only.end();
}

SolverResults run_part(std::string_view part, const SolverPlan& plan, StudyLog& log) {
  SolverResults results;
  const CpuClock clock = thread_cpu_ns;
  if (part == "accuracy") {
    SolveAccuracyOptions how;
    if (plan.quick) how = {.side = 4, .h_omega_step = 1e3, .pcg_tolerance = 1e-10};
    log.say("accuracy: all scales of mass, stiffness and step");
    results.cells = solve_accuracy(how);
    results.indefinite = indefinite_systems();
  }
  if (part == "edits") {
    const std::size_t edits = plan.quick ? 200 : 3000;
    for (const double stretch : {0.0, 0.2})
      for (const EditPolicy& policy : edit_policies()) {
        log.say(fmt::format("edits: {}, {}", policy.name, stretch == 0.0 ? "at rest" : "stretched"));
        results.edits.push_back(run_edits(policy, plan.quick ? 6 : 8, stretch, edits, clock));
      }
  }
  if (part == "updates")
    for (const int side : {8, 12, 16}) {
      if (plan.quick && side > 8) continue;
      for (const double stretch : {0.0, 0.2}) {
        const int rounds = side == 16 ? 9 : 17;
        results.updates.push_back(time_updates(side, stretch, plan.quick ? 5 : rounds, plan.seed));
        log.say(fmt::format("updates: {}", results.updates.back().body));
      }
    }
  if (part == "crossover") {
    const CrossoverOptions how;
    results.crossover_error = how.error;
    for (const int side : {8, 12, 16}) {
      if (plan.quick && side > 8) continue;
      results.crossovers.push_back(find_crossover(side, how, clock, [&](const CostPair& c) {
        log.say(
            fmt::format("crossover: {}^3 vertices, stiffness factor {:.2g}, T omega_max {:.3g}: explicit {:.3g} s, {} "
                        "{:.3g} s",
                        side, c.factor, c.phase, c.explicit_s, c.implicit_method, c.implicit_s));
      }));
    }
  }
  if (part == "steps")
    // the longest step that the paper's method could take, and longer ones
    for (const double h_omega : {2.83, 10.0, 100.0})
      results.steps.push_back(time_implicit_step(h_omega, plan.quick ? 6 : 30, plan.seed));
  return results;
}

void append(SolverResults& all, SolverResults part) {
  const auto move_to = [](auto& to, auto& from) {
    to.insert(to.end(), std::make_move_iterator(from.begin()), std::make_move_iterator(from.end()));
  };
  move_to(all.cells, part.cells);
  move_to(all.indefinite, part.indefinite);
  move_to(all.edits, part.edits);
  move_to(all.updates, part.updates);
  move_to(all.crossovers, part.crossovers);
  move_to(all.steps, part.steps);
  if (part.crossover_error > 0.0) all.crossover_error = part.crossover_error;
}

}  // namespace

std::span<const std::string_view> solver_parts() { return parts; }

Report solver_study(const SolverPlan& plan, StudyLog& log) {
  for (const std::string& part : plan.only)
    if (std::ranges::find(parts, part) == std::end(parts))
      throw InputError(fmt::format("--only {}: there are {}", part, fmt::join(parts, ", ")));
  SolverResults results;
  for (const std::string_view part : parts) {
    if (!wants(plan, part)) continue;
    SolverResults found = run_part(part, plan, log);
    for_each_sample(found, [&](const nlohmann::json& sample) { log.sample(sample); });
    append(results, std::move(found));
  }
  Report report{.tables = tables_of(results),
                .claims = claims_of(results),
                .limits = {"The law of the crossover was tuned on these bodies.",
                           "A dissociation is followed row by row only where the kept factor was linearised at the "
                           "present state."}};
  if (std::ranges::any_of(results.crossovers, [](const Crossover& c) { return c.failure.empty(); }))
    report.pictures.push_back({"crossover", crossover_plot(results.crossovers)});
  return report;
}

}  // namespace dartboard
