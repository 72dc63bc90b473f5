#include "benchmarks/studies/step/bench_step_study.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "benchmarks/harness/processes.h"
#include "benchmarks/studies/step/bench_step_report.h"

namespace dartboard {

Report step_bench(const StepBenchPlan& plan, StudyLog& log) {
  const int processes = plan.quick ? 3 : 8, rounds = plan.quick ? 5 : 20;
  StepCosts costs{.samples = {},
                  .counts = {},
                  .largest = plan.quick ? std::size_t{100'000} : 1'000'000,
                  .meshes = step_meshes(plan.meshes)};
  const auto measure = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"measure-step", "--largest", std::to_string(costs.largest), "--seed",
                                       std::to_string(plan.seed)};
    for (const std::filesystem::path& mesh : plan.meshes) arguments.insert(arguments.end(), {"--mesh", mesh.string()});
    arguments.insert(arguments.end(), more.begin(), more.end());
    run_self(arguments, [&](std::string_view line) {
      const auto json = nlohmann::json::parse(line);
      log.sample(json);
      if (json.contains("body"))
        costs.counts[json.at("body")] = json.get<StepCounts>();
      else
        costs.samples.push_back(json.get<Sample>());
    });
  };
  log.say(fmt::format("bodies of up to {} tetrahedra: first their motions, then times in {} processes", costs.largest,
                      processes));
  log.begin("comparing", 1);
  measure({"--compare"});
  log.advance();
  if (claims_of(costs).front().verdict != Verdict::holds) return {.claims = claims_of(costs)};
  log.begin("timing", static_cast<std::size_t>(processes));
  for (int process = 0; process < processes; ++process) {
    measure({"--process", std::to_string(process), "--rounds", std::to_string(rounds)});
    log.advance();
  }
  check_repeats(costs.samples);
  return {.tables = {{"steps", "A step over springs, by body", steps_table(costs), step_costs_note()},
                     {"limits", "What a step could take", limits_table(costs)}},
          .claims = claims_of(costs),
          .pictures = {{"roofline", roofline_plot(costs)}}};
}

}  // namespace dartboard
