#include "benchmarks/studies/compare/compared_times.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "core/plain/error.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;

void add_samples(const fs::path& file, const std::string& prefix, TimedTasks& to) {
  std::ifstream in(file);
  std::string line;
  for (std::size_t number = 1; std::getline(in, line); ++number) {
    const auto sample = nlohmann::json::parse(line, nullptr, false);
    if (!sample.is_object()) throw IoError(fmt::format("{}:{}: is no sample, or cut off", file.string(), number));
    if (!sample.contains("task") || !sample.contains("process") || !sample.contains("cpu_ns")) continue;
    std::string task = prefix;
    for (const auto& [key, value] : sample.items())
      if (value.is_string() && key != "hash")
        task += (task.size() == prefix.size() ? "" : ", ") + value.get<std::string>();
    try {
      TimedTasks::Task& known = to.tasks[task];
      known.ns[sample.at("process").get<int>()].push_back(sample.at("cpu_ns").get<double>() /
                                                          sample.value("steps", 1.0));
      known.hashes.insert(sample.value("hash", ""));
    } catch (const nlohmann::json::exception& error) {
      throw IoError(fmt::format("{}:{}: is no sample: {}", file.string(), number, error.what()));
    }
  }
}

/// By process and task: the logarithm of the median over rounds.
using Values = std::map<int, std::map<std::string, double>>;

Values values_of(const TimedTasks& run, const TimedTasks& other) {
  Values values;
  for (const auto& [name, task] : run.tasks)
    if (other.tasks.contains(name))
      for (const auto& [process, ns] : task.ns) values[process][name] = std::log(median(ns));
  return values;
}

constexpr std::size_t fewest_tasks = 3;  // of fewer, a change of one would be taken for what they have in common

/// What all tasks of each process have in common, taken out of them where they are enough for that.
std::vector<double> take_out_common(Values& values, const std::map<std::string, double>& middle) {
  std::vector<double> common;
  for (auto& [process, tasks] : values) {
    std::vector<double> off;
    for (const auto& [name, value] : tasks) off.push_back(value - middle.at(name));
    common.push_back(median(off));
    if (middle.size() >= fewest_tasks)
      for (auto& [name, value] : tasks) value -= common.back();
  }
  return common;
}

std::vector<double> of_task(const Values& values, const std::string& name) {
  std::vector<double> all;
  for (const auto& [process, tasks] : values)
    if (const auto found = tasks.find(name); found != tasks.end()) all.push_back(found->second);
  return all;
}

Shift as_ratio(Shift shift) {
  for (double* value : {&shift.median, &shift.interval.low, &shift.interval.high}) *value = std::exp(*value);
  return shift;
}

TimeVerdict verdict_of(const Shift& ratio, double least) {
  if (!ratio.interval.reached) return TimeVerdict::cannot_tell;
  if (ratio.interval.low >= 1.0 + 0.5 * least && ratio.median >= 1.0 + least) return TimeVerdict::slower;
  if (ratio.interval.high <= 1.0 / (1.0 + 0.5 * least) && ratio.median <= 1.0 / (1.0 + least))
    return TimeVerdict::faster;
  const bool within = ratio.interval.low >= 1.0 / (1.0 + least) && ratio.interval.high <= 1.0 + least;
  return within ? TimeVerdict::same : TimeVerdict::cannot_tell;
}

}  // namespace

TimedTasks read_timed_tasks(const fs::path& folder) {
  TimedTasks run;
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().filename() == "samples.jsonl") files.push_back(entry.path());
  std::ranges::sort(files);
  for (const fs::path& file : files) {
    const fs::path within = fs::relative(file.parent_path(), folder);
    add_samples(file, within == "." ? "" : within.string() + ": ", run);
  }
  return run;
}

std::string_view name(TimeVerdict verdict) {
  switch (verdict) {
    case TimeVerdict::same: return "same";
    case TimeVerdict::slower: return "slower";
    case TimeVerdict::faster: return "faster";
    case TimeVerdict::cannot_tell: break;
  }
  return "cannot tell";
}

ComparedTimes compare_times(const TimedTasks& first, const TimedTasks& second, double least) {
  ComparedTimes found;
  for (const auto& [mine, others] : {std::pair(&first, &second), {&second, &first}})
    for (const auto& [task, of] : mine->tasks)
      if (!others->tasks.contains(task)) found.alone.push_back(task);
  Values values[2]{values_of(first, second), values_of(second, first)};
  std::map<std::string, double> middle;
  for (const auto& [task, of] : first.tasks)
    if (second.tasks.contains(task))
      middle[task] = 0.5 * (median(of_task(values[0], task)) + median(of_task(values[1], task)));
  if (middle.empty()) return found;
  const std::vector<double> common[2]{take_out_common(values[0], middle), take_out_common(values[1], middle)};
  found.all = as_ratio(shift_between(common[0], common[1]));
  for (const auto& [task, of] : middle) {
    const std::vector<double> from = of_task(values[0], task), to = of_task(values[1], task);
    ComparedTask compared{.task = task,
                          .processes = {from.size(), to.size()},
                          .shift = as_ratio(shift_between(from, to, 1.0 - 0.05 / static_cast<double>(middle.size()))),
                          .same_state = first.tasks.at(task).hashes == second.tasks.at(task).hashes};
    compared.verdict = verdict_of(compared.shift, least);
    found.tasks.push_back(std::move(compared));
  }
  return found;
}

}  // namespace dartboard
