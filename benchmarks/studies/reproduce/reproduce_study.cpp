#include "benchmarks/studies/reproduce/reproduce_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <vector>

#include "benchmarks/paper/paper_bodies.h"
#include "benchmarks/studies/extremes/extremes_study.h"
#include "benchmarks/studies/reproduce/measure.h"
#include "benchmarks/studies/reproduce/reproduce_report.h"
#include "benchmarks/studies/step/bench_step_report.h"
#include "benchmarks/studies/step/bench_step_study.h"
#include "benchmarks/studies/step/step_bodies.h"

namespace dartboard {
namespace {

constexpr int agreement_steps = 10;
const std::string body = "liver";

/// The paper's walks, gated and timed, and its claims.
Report reproduce_paper(const ReproducePlan& plan, StudyLog& log) {
  const Problem problem = paper_body(body).make();
  ReproduceResults results;
  results.quick = plan.quick;
  results.counts = compare_counts(problem);
  log.finished(
      {.opening = fmt::format("Topology-based Physical Simulation, section 5, on a body of the paper's size{}\n",
                              plan.quick ? " (a quick run: few rounds, wide intervals)" : ""),
       .tables = {{"counts", "1. Topology, against CGAL", counts_table(results)}}});
  results.motion = compare_motion(problem, agreement_steps);
  log.finished(
      {.tables = {{"agreement",
                   fmt::format("2. Forces, and states after {} steps, against the first contender", agreement_steps),
                   agreement_table(results)}}});

  results.second = compare_second(problem, 1.0, contenders_for_a_second());
  log.finished({.tables = {{"second", "   A second of motion, against the same steps in extended precision",
                            second_table(results), bounds_note()}}});

  const ReproduceGates gates = gates_of(results.counts, results.motion, results.second);
  if (!gates.agreed.empty()) {
    const MeasurePlan measured = plan_measurement(body, problem, gates.agreed, plan.quick, plan.seed, log);
    log.say(fmt::format("3. Time per step: {} processes, {} interleaved rounds each\n", measured.processes,
                        measured.rounds));
    results.per_step = per_step(measure(measured, log));
  }
  Report report{
      .tables = {{"timing", "Time per RK4 step", timing_table(results), timing_note(results, problem)}},
      .claims = answer_claims(results, problem, log),
      .limits = {"The body has the counts of the paper's body, not its shape, which is not published.",
                 "The paper's map library, MOKA, is not compared; CGAL's linear cell complex is in its place."}};
  if (!gates.passed) report.disagreements.emplace_back("A gate has failed: see above which contenders were not timed.");
  return report;
}

/// The step of a body that threads share, by one processor and by all.
Report reproduce_larger(const ReproducePlan& plan, StudyLog& log) {
  const StepCosts costs =
      measure_steps({.seed = plan.seed, .only = step_box(100'000, false)}, plan.quick, log, "larger");
  Report report{.claims = {claims_of(costs).front()}};
  if (costs.samples.empty()) {
    report.disagreements.emplace_back("The larger body moves otherwise than the naive graph: it was not timed.");
    return report;
  }
  report.tables = {{"steps", "Time of an RK4 step of a larger body", steps_table(costs), step_costs_note(costs)},
                   {"limits", "What that step could take", limits_table(costs)}};
  return report;
}

}  // namespace

Report reproduce_study(const ReproducePlan& plan, StudyLog& log) {
  std::vector<Claim> claims;
  bool gates_passed = true;
  const auto add = [&](const Report& part, const std::string& folder) {
    log.finished(part, folder);
    std::ranges::copy(part.claims, std::back_inserter(claims));
    gates_passed = gates_passed && part.disagreements.empty();
  };
  const auto has = [&plan](const char* part) { return plan.part.empty() || plan.part == part; };
  if (has("paper")) add(reproduce_paper(plan, log), "");
  if (has("larger")) {
    log.say("4. A body large enough for all processors: its motions, then its times\n");
    add(reproduce_larger(plan, log), "larger");
  }
  if (has("extremes")) {
    log.say(fmt::format("5. Numerical stability at the extremes{}\n", plan.quick ? " (a third of the values)" : ""));
    add(extremes_study({.quick = plan.quick, .shows_tables = false, .folder = "extremes"}, log), "extremes");
  }
  return {.numbers = {{"gates_passed", gates_passed}}, .sentence = closing_words(claims, gates_passed, plan.quick)};
}

}  // namespace dartboard
