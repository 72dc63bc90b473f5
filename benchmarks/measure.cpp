#include "benchmarks/measure.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>

#include "benchmarks/cli.h"
#include "benchmarks/clock.h"
#include "benchmarks/processes.h"
#include "benchmarks/progress.h"
#include "benchmarks/scenes.h"
#include "core/plain/error.h"
#include "validation/contenders.h"

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
                             bool quick, std::uint64_t seed) {
  MeasurePlan plan{scene, {}, quick ? 6 : 11, quick ? 8 : 24, seed};
  for (const std::string& id : ids) {
    const auto simulation = contender(id).make(problem);
    simulation->step(1);  // first touch of its memory
    const auto start = thread_cpu_ns();
    simulation->step(1);
    const double ms = static_cast<double>(thread_cpu_ns() - start) * 1e-6;
    plan.contenders.push_back({id, ms > 1.0 ? 2 : 20});
  }
  return plan;
}

std::vector<StepSample> measure(const MeasurePlan& plan, const std::function<void(const StepSample&)>& sink) {
  Progress progress("timing", static_cast<std::size_t>(plan.processes * plan.rounds) * plan.contenders.size());
  std::vector<StepSample> samples;
  repeat_self(
      plan.processes,
      [&](int process) {
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
        return arguments;
      },
      [&](std::string_view line) {
        samples.push_back(nlohmann::json::parse(line).get<StepSample>());
        sink(samples.back());
        progress.advance(samples.back().sample.task);
      });
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

// The child's side, a verb that help does not show: prints one sample per line.
void add_measure(CLI::App& app, Outcome&) {
  struct Options {
    std::string scene;
    PairedOptions paired;
    std::vector<std::string> tasks;
  };
  auto options = std::make_shared<Options>();
  auto* verb = app.add_subcommand("measure", "Time contenders in this process (used by reproduce).")->group("");
  verb->add_option("--scene", options->scene)->required();
  verb->add_option("--process", options->paired.process);
  verb->add_option("--rounds", options->paired.rounds)->check(positive_number());
  verb->add_option("--seed", options->paired.seed);
  verb->add_option("CONTENDER:STEPS", options->tasks)->required();
  verb->callback([options] {
    const Problem problem = scene(options->scene).make();
    std::vector<std::unique_ptr<ContenderBody>> simulations;
    std::vector<TimedTask> tasks;
    std::map<std::string, int> steps_of;
    for (const std::string& task : options->tasks) {
      const auto colon = task.find(':');
      const std::string id = task.substr(0, colon);
      const int steps = colon == std::string::npos ? 0 : std::atoi(task.c_str() + colon + 1);
      if (steps < 1) throw InputError(fmt::format("'{}' is not CONTENDER:STEPS with at least one step", task));
      simulations.push_back(contender(id).make(problem));
      ContenderBody& s = *simulations.back();
      auto start = std::make_shared<PointState>(s.state());
      steps_of[id] = steps;
      tasks.push_back({id, [&s, start] { s.set_state(*start); }, [&s, steps] { s.step(steps); },
                       [&s] { return state_hash(s.state()); }});
    }
    run_rounds(tasks, options->paired, [&](const Sample& sample) {
      fmt::print("{}\n", nlohmann::json(StepSample{sample, steps_of[sample.task]}).dump());
    });
  });
}

}  // namespace dartboard
