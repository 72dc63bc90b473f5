#include "benchmarks/harness/paired.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <random>
#include <set>

#include "benchmarks/harness/clock.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

void check_arguments(std::span<const TimedTask> tasks, const PairedOptions& options) {
  if (tasks.empty()) throw InputError("no task to time");
  if (options.rounds < 1) throw InputError(fmt::format("rounds: {} is not >= 1", options.rounds));
  if (options.warmup < 0) throw InputError(fmt::format("warmup: {} is not >= 0", options.warmup));
  std::set<std::string_view> names;
  for (const TimedTask& task : tasks)
    if (!names.insert(task.name).second) throw InputError(fmt::format("two tasks are named '{}'", task.name));
}

/// The order of the tasks, round after round.
class Turns {
 public:
  Turns(std::size_t tasks, const PairedOptions& options)
      : random_(options.seed + static_cast<std::uint64_t>(options.process)), order_(tasks) {
    std::iota(order_.begin(), order_.end(), std::size_t{0});
  }

  const std::vector<std::size_t>& next() {
    if (round_++ % order_.size() == 0)
      shuffle();
    else
      std::rotate(order_.begin(), order_.begin() + 1, order_.end());
    return order_;
  }

 private:
  // std::shuffle would give another order with another standard library
  void shuffle() {
    for (std::size_t left = order_.size(); left > 1; --left) std::swap(order_[left - 1], order_[random_() % left]);
  }

  std::mt19937_64 random_;
  std::vector<std::size_t> order_;
  std::size_t round_ = 0;
};

Sample measure(const TimedTask& task) {
  Sample sample;
  sample.task = task.name;
  task.restore();
  const std::int64_t wall_start = steady_wall_ns();
  const std::int64_t cpu_start = thread_cpu_ns();
  task.run();
  const std::int64_t cpu_end = thread_cpu_ns();
  const std::int64_t wall_end = steady_wall_ns();
  sample.cpu_ns = cpu_end - cpu_start;
  sample.wall_ns = wall_end - wall_start;
  sample.hash = task.hash();
  return sample;
}

using Rounds = std::map<int, const Sample*>;             // by round
using Processes = std::map<int, Rounds>;                 // by process
using RoundValues = std::map<int, std::vector<double>>;  // by process, one value per round

Processes samples_of(std::span<const Sample> samples, std::string_view task) {
  Processes processes;
  for (const Sample& sample : samples) {
    if (sample.task != task) continue;
    if (!processes[sample.process].emplace(sample.round, &sample).second)
      throw InputError(fmt::format("process {}, round {}: two samples of '{}'", sample.process, sample.round, task));
  }
  if (processes.empty()) throw InputError(fmt::format("no sample of '{}'", task));
  return processes;
}

double cpu_of(const Sample& sample) { return static_cast<double>(sample.cpu_ns); }
double wall_of(const Sample& sample) { return static_cast<double>(sample.wall_ns); }
using Clock = double (*)(const Sample&);

std::vector<double> medians(const RoundValues& by_process) {
  std::vector<double> result;
  for (const auto& [process, values] : by_process) result.push_back(median(values));
  return result;
}

std::size_t flagged(std::span<const double> values) {
  const auto flags = outliers(values);
  return static_cast<std::size_t>(std::count(flags.begin(), flags.end(), true));
}

void check_rounds_match(const Processes& task, const Processes& baseline, std::string_view name) {
  for (const auto& [process, rounds] : baseline)
    for (const auto& [round, sample] : rounds)
      if (!task.contains(process) || !task.at(process).contains(round))
        throw InputError(fmt::format("process {}, round {}: no sample of '{}'", process, round, name));
}

RoundValues ratios(const Processes& task, const Processes& baseline, Clock clock) {
  RoundValues result;
  for (const auto& [process, rounds] : task)
    for (const auto& [round, sample] : rounds) {
      const Sample& base = *baseline.at(process).at(round);
      if (clock(base) <= 0.0)
        throw InputError(fmt::format("process {}, round {}: '{}' took no time, its work is too little for the clock",
                                     process, round, base.task));
      result[process].push_back(clock(*sample) / clock(base));
    }
  return result;
}

struct Spread {
  double median, min, variation;
};

Spread spread_of(const Processes& processes, Clock clock) {
  RoundValues by_process;
  std::vector<double> all;
  for (const auto& [process, rounds] : processes)
    for (const auto& [round, sample] : rounds) {
      by_process[process].push_back(clock(*sample));
      all.push_back(clock(*sample));
    }
  const double n = static_cast<double>(all.size());
  const double mean = std::accumulate(all.begin(), all.end(), 0.0) / n;
  double squares = 0.0;
  for (double x : all) squares += (x - mean) * (x - mean);
  const double deviation = all.size() > 1 ? std::sqrt(squares / (n - 1.0)) : 0.0;
  return {median(medians(by_process)), *std::min_element(all.begin(), all.end()), mean > 0.0 ? deviation / mean : 0.0};
}

nlohmann::json json_of(const Figure& figure) {
  return {{"median", figure.median},
          {"low", figure.interval.low},
          {"high", figure.interval.high},
          {"coverage", figure.interval.coverage},
          {"confidence_reached", figure.interval.reached}};
}

}  // namespace

void to_json(nlohmann::json& json, const Sample& sample) {
  json = {{"task", sample.task},
          {"process", sample.process},
          {"round", sample.round},
          {"position", sample.position},
          {"cpu_ns", sample.cpu_ns},
          {"wall_ns", sample.wall_ns},
          {"hash", fmt::format("{:016x}", sample.hash)}};
}

void from_json(const nlohmann::json& json, Sample& sample) {
  json.at("task").get_to(sample.task);
  json.at("process").get_to(sample.process);
  json.at("round").get_to(sample.round);
  json.at("position").get_to(sample.position);
  json.at("cpu_ns").get_to(sample.cpu_ns);
  json.at("wall_ns").get_to(sample.wall_ns);
  const auto& hash = json.at("hash").get_ref<const std::string&>();
  const auto [end, error] = std::from_chars(hash.data(), hash.data() + hash.size(), sample.hash, 16);
  if (error != std::errc{} || end != hash.data() + hash.size())
    throw InputError(fmt::format("hash of a sample: '{}' is not a hexadecimal number of 64 bits", hash));
}

void run_rounds(std::span<const TimedTask> tasks, const PairedOptions& options,
                const std::function<void(const Sample&)>& sink) {
  check_arguments(tasks, options);
  Turns warmup_turns(tasks.size(), options), turns(tasks.size(), options);
  for (int round = 0; round < options.warmup; ++round)
    for (std::size_t task : warmup_turns.next()) measure(tasks[task]);
  for (int round = 0; round < options.rounds; ++round) {
    int position = 0;
    for (std::size_t task : turns.next()) {
      Sample sample = measure(tasks[task]);
      sample.process = options.process;
      sample.round = round;
      sample.position = position++;
      sink(sample);
    }
  }
}

Figure figure_of(std::span<const double> values) { return {median(values), median_interval(values)}; }

std::string to_string(const Figure& figure) {
  return fmt::format("{:.3g} {}", figure.median, to_string(figure.interval));
}

void to_json(nlohmann::json& json, const Ratio& ratio) {
  json = {{"task", ratio.task},
          {"baseline", ratio.baseline},
          {"cpu", json_of(ratio.cpu)},
          {"wall", json_of(ratio.wall)},
          {"cpu_of_process", ratio.cpu_of_process},
          {"wall_of_process", ratio.wall_of_process},
          {"rounds", ratio.rounds},
          {"flagged_rounds", ratio.flagged_rounds},
          {"flagged_processes", ratio.flagged_processes}};
}

Ratio paired_ratio(std::span<const Sample> samples, std::string_view task, std::string_view baseline) {
  const Processes of_task = samples_of(samples, task);
  const Processes of_baseline = samples_of(samples, baseline);
  check_rounds_match(of_task, of_baseline, task);
  check_rounds_match(of_baseline, of_task, baseline);

  const RoundValues cpu = ratios(of_task, of_baseline, cpu_of);
  const RoundValues wall = ratios(of_task, of_baseline, wall_of);
  Ratio ratio;
  ratio.task = task;
  ratio.baseline = baseline;
  ratio.cpu_of_process = medians(cpu);
  ratio.wall_of_process = medians(wall);
  ratio.cpu = figure_of(ratio.cpu_of_process);
  ratio.wall = figure_of(ratio.wall_of_process);
  for (const auto& [process, values] : cpu) {
    ratio.rounds += values.size();
    ratio.flagged_rounds += flagged(values);
  }
  ratio.flagged_processes = flagged(ratio.cpu_of_process);
  return ratio;
}

Times times_of(std::span<const Sample> samples, std::string_view task) {
  const Processes processes = samples_of(samples, task);
  const Spread cpu = spread_of(processes, cpu_of), wall = spread_of(processes, wall_of);
  return {cpu.median, wall.median, cpu.min, wall.min, cpu.variation, wall.variation};
}

Figure cpu_figure(std::span<const Sample> samples, std::string_view task) {
  RoundValues by_process;
  for (const auto& [process, rounds] : samples_of(samples, task))
    for (const auto& [round, sample] : rounds) by_process[process].push_back(cpu_of(*sample));
  return figure_of(medians(by_process));
}

std::vector<std::uint64_t> hashes_of(std::span<const Sample> samples, std::string_view task) {
  std::set<std::uint64_t> hashes;
  for (const Sample& sample : samples)
    if (sample.task == task) hashes.insert(sample.hash);
  return {hashes.begin(), hashes.end()};
}

void check_repeats(std::span<const Sample> samples) {
  std::set<std::string_view> tasks;
  for (const Sample& sample : samples) {
    if (!tasks.insert(sample.task).second) continue;
    if (const auto hashes = hashes_of(samples, sample.task); hashes.size() > 1)
      throw SolverError(fmt::format("'{}' left {} different states where it was timed: {:016x}, {:016x}", sample.task,
                                    hashes.size(), hashes[0], hashes[1]));
  }
}

}  // namespace dartboard
