#include "benchmarks/studies/reproduce/measure.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "benchmarks/harness/clock.h"
#include "validation/contenders/contenders.h"

namespace dartboard {

void to_json(nlohmann::json& json, const StepSample& s) {
  to_json(json, s.sample);
  json["steps"] = s.steps;
}

void from_json(const nlohmann::json& json, StepSample& s) {
  from_json(json, s.sample);
  s.steps = json.at("steps").get<int>();
}

MeasurePlan plan_measurement(const std::string& scene, const Problem& problem, const std::vector<std::string>& ids,
                             bool quick, std::uint64_t seed, StudyLog& log) {
  MeasurePlan plan{scene, {}, quick ? 6 : 11, quick ? 8 : 24, seed};
  for (const std::string& id : ids) {
    const int steps = log.once("steps of a round of " + id, [&] {
      const auto simulation = contender(id).make(problem);
      simulation->step(1);  // first touch of its memory
      const auto start = thread_cpu_ns();
      simulation->step(1);
      const double ms = static_cast<double>(thread_cpu_ns() - start) * 1e-6;
      return ms > 1.0 ? 2 : 20;
    });
    plan.contenders.push_back({id, steps});
  }
  return plan;
}

std::vector<StepSample> measure(const MeasurePlan& plan, StudyLog& log) {
  log.begin("timing", static_cast<std::size_t>(plan.processes * plan.rounds) * plan.contenders.size());
  std::vector<StepSample> samples;
  for (int process = 0; process < plan.processes; ++process) {
    std::vector<std::string> arguments{"measure",
                                       "--scene",
                                       plan.scene,
                                       "--process",
                                       std::to_string(process),
                                       "--rounds",
                                       std::to_string(plan.rounds),
                                       "--seed",
                                       std::to_string(plan.seed)};
    for (const auto& c : plan.contenders) arguments.push_back(fmt::format("{}:{}", c.id, c.steps));
    log.measure(arguments, [&](const nlohmann::json& json) {
      samples.push_back(json.get<StepSample>());
      log.advance(samples.back().sample.task);
    });
  }
  std::vector<Sample> plain;
  for (const StepSample& s : samples) plain.push_back(s.sample);
  check_repeats(plain);
  return samples;
}

std::vector<Sample> per_step(const std::vector<StepSample>& samples) {
  std::vector<Sample> scaled;
  for (const StepSample& s : samples) {
    scaled.push_back(s.sample);
    scaled.back().cpu_ns /= s.steps;
    scaled.back().wall_ns /= s.steps;
  }
  return scaled;
}

}  // namespace dartboard
