#include "benchmarks/studies/step/bench_step_study.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iterator>
#include <nlohmann/json.hpp>
#include <utility>

#include "benchmarks/harness/scratch_folder.h"
#include "benchmarks/studies/step/changed_report.h"
#include "benchmarks/studies/step/changing_report.h"

namespace dartboard {

namespace {

/// The numbers of a run of the study.
struct Extent {
  bool quick;
  std::uint64_t seed;
  int processes() const { return quick ? 3 : 8; }
  /// For bodies that change: as few as give an interval.
  int fewer_processes() const { return quick ? 3 : 6; }
  int rounds() const { return quick ? 5 : 20; }
  std::size_t largest() const { return quick ? 100'000 : 1'000'000; }
};

/// Run a verb of this program that measures: each line is kept, and handed over as a sample or as one of `Counts`.
template <class Counts>
void measure_in_process(std::vector<std::string> arguments, std::uint64_t seed, const char* key, StudyLog& log,
                        std::vector<Sample>& samples, const std::function<void(Counts)>& take,
                        const std::string& folder = "", const std::vector<std::string>& places = {}) {
  arguments.insert(arguments.end(), {"--seed", std::to_string(seed)});
  log.measure(
      arguments,
      [&](const nlohmann::json& json) {
        if (json.contains(key))
          take(json.get<Counts>());
        else
          samples.push_back(json.get<Sample>());
      },
      folder, places);
}

Report report_on_unchanged(const StepBenchPlan& plan, const Extent& extent, StudyLog& log) {
  log.say(fmt::format("bodies of up to {} tetrahedra: first their motions, then times in {} processes",
                      extent.largest(), extent.processes()));
  const StepCosts costs =
      measure_steps({.largest = extent.largest(), .seed = plan.seed, .meshes = plan.meshes}, plan.quick, log);
  if (costs.samples.empty()) return {.claims = claims_of(costs)};
  return {.tables = {{"steps", "A step over springs, by body", steps_table(costs), step_costs_note(costs)},
                     {"limits", "What a step could take", limits_table(costs)}},
          .claims = claims_of(costs),
          .pictures = {{"roofline", roofline_plot(costs)}}};
}

Report report_on_changed(const Extent& extent, StudyLog& log) {
  ChangedCosts costs;
  std::vector<std::string> bodies;
  for (std::size_t size = 100'000; size <= extent.largest(); size *= 10) bodies.push_back(step_box(size, false));
  log.say(fmt::format("bodies that have changed, and fresh ones: times in {} processes", extent.fewer_processes()));
  log.begin("changed bodies",
            bodies.size() * kinds_of_change().size() * (static_cast<std::size_t>(extent.fewer_processes()) + 1));
  for (const std::string& body : bodies)
    for (const std::string& kind : kinds_of_change()) {
      const ScratchFolder folder("step");
      const auto measure = [&](const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"measure-changed", "--body", body, "--kind", kind};
        arguments.insert(arguments.end(), more.begin(), more.end());
        measure_in_process<ChangedCase>(arguments, extent.seed, "changed", log, costs.samples,
                                        [&](const ChangedCase& one) { costs.cases.push_back(one); }, "",
                                        {"--folder", folder.path().string()});
        log.advance(body);
      };
      measure({"--compare"});
      if (costs.count_differing() > 0) return {.claims = claims_of(costs)};
      for (int process = 0; process < extent.fewer_processes(); ++process)
        measure({"--process", std::to_string(process), "--rounds", std::to_string(extent.rounds() / 2)});
    }
  check_repeats(costs.samples);
  return {.tables = {{"changed", "A step of bodies that have changed", changed_table(costs), changed_note()}},
          .claims = claims_of(costs)};
}

Report report_on_changing(const Extent& extent, StudyLog& log) {
  ChangingCosts costs;
  const auto measure = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"measure-changing", "--largest", std::to_string(extent.largest())};
    arguments.insert(arguments.end(), more.begin(), more.end());
    measure_in_process<ChangingCounts>(arguments, extent.seed, "changing", log, costs.samples,
                                       [&](const ChangingCounts& counts) { costs.bodies.push_back(counts); });
    log.advance();
  };
  log.say(fmt::format("a dissociation in every step: times in {} processes", extent.fewer_processes()));
  log.begin("changing bodies", static_cast<std::size_t>(extent.fewer_processes()) + 1);
  measure({"--compare"});
  if (costs.count_differing() > 0) return {.claims = claims_of(costs)};
  for (int process = 0; process < extent.fewer_processes(); ++process)
    measure({"--process", std::to_string(process), "--rounds", std::to_string(extent.rounds())});
  return {.tables = {{"changing", "A dissociation in every step", changing_table(costs), changing_note()}},
          .claims = claims_of(costs)};
}

void append(Report& report, Report more) {
  const auto add = [](auto& to, auto& from) { std::ranges::move(from, std::back_inserter(to)); };
  add(report.tables, more.tables);
  add(report.claims, more.claims);
}

}  // namespace

StepCosts measure_steps(const StepCostPlan& plan, bool quick, StudyLog& log, const std::string& folder) {
  const Extent extent{quick, plan.seed};
  StepCosts costs{.samples = {}, .counts = {}, .largest = plan.largest, .meshes = step_meshes(plan.meshes)};
  const auto measure = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"measure-step", "--largest", std::to_string(plan.largest)};
    if (!plan.only.empty()) arguments.insert(arguments.end(), {"--only", plan.only});
    for (const std::filesystem::path& mesh : plan.meshes) arguments.insert(arguments.end(), {"--mesh", mesh.string()});
    arguments.insert(arguments.end(), more.begin(), more.end());
    measure_in_process<StepCounts>(
        arguments, plan.seed, "body", log, costs.samples,
        [&](const StepCounts& counts) { costs.counts[counts.body] = counts; }, folder);
  };
  log.begin("comparing", 1);
  measure({"--compare"});
  log.advance();
  if (claims_of(costs).front().verdict != Verdict::holds) return costs;
  log.begin("timing", static_cast<std::size_t>(extent.processes()));
  for (int process = 0; process < extent.processes(); ++process) {
    measure({"--process", std::to_string(process), "--rounds", std::to_string(extent.rounds())});
    log.advance();
  }
  check_repeats(costs.samples);
  return costs;
}

Report step_bench(const StepBenchPlan& plan, StudyLog& log) {
  const Extent extent{plan.quick, plan.seed};
  Report report = report_on_unchanged(plan, extent, log);
  append(report, report_on_changed(extent, log));
  append(report, report_on_changing(extent, log));
  return report;
}

}  // namespace dartboard
