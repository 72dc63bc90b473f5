#pragma once
// The times of two runs of a study, task by task.

#include <cstdint>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "benchmarks/harness/statistics.h"

namespace dartboard {

/// The samples of a run: processor times of a task, and the states that it left.
struct TimedTasks {
  struct Task {
    std::map<int, std::vector<double>> ns{};  // by process: of each round, per step where samples have steps
    std::set<std::string> hashes{};
  };
  std::map<std::string, Task>
      tasks{};  // by name, after the texts that tell samples of one name apart: "liver564, orbit"
};
/// Those in samples.jsonl of a folder and of the folders within; lines that time no task are left out.
///
/// throws  IoError that names the file and the line, where one is cut off or damaged
TimedTasks read_timed_tasks(const std::filesystem::path& folder);

enum class TimeVerdict { same, slower, faster, cannot_tell };
std::string_view name(TimeVerdict verdict);

struct ComparedTask {
  std::string task;
  std::size_t processes[2]{};  // that measured it
  Shift shift{};               // as ratios: the second run's time over the first's, that of all tasks divided out
  TimeVerdict verdict = TimeVerdict::cannot_tell;
  bool same_state = true;  // the tasks left the same bits
};

struct ComparedTimes {
  Shift all{};                      // the ratio that the tasks have in common: of the machines, or of the builds
  std::vector<ComparedTask> tasks;  // that both runs have
  std::vector<std::string> alone;   // in one of them
};

/// Compare. A process is a sample of one value for each task, the median over its rounds. What all tasks of a process
/// have in common is taken out first, the median over them: another machine, a clock that changes, memory that others
/// use. So a change of more than half of all tasks is seen as common, and does not show in any. Fewer than three tasks
/// are compared as they are.
///
/// The intervals hold together: each at a confidence of 1 - 0.05 / tasks. A task is slower or faster where the ratio is
/// off by at least `least`, and the whole interval by half of that, since two runs of one program part by more than
/// their processes show; the same where the interval is within that; else one cannot tell.
ComparedTimes compare_times(const TimedTasks& first, const TimedTasks& second, double least);

}  // namespace dartboard
