#pragma once
// Paired, interleaved timing: all tasks take turns within each round, and only ratios within a round are compared.

#include <cstdint>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/harness/statistics.h"

namespace dartboard {

/// A fixed amount of work. Only `run` is timed; `hash` is taken of the state it leaves.
struct TimedTask {
  std::string name;
  std::function<void()> restore;
  std::function<void()> run;
  std::function<std::uint64_t()> hash;
};

struct PairedOptions {
  int rounds = 20;         // a multiple of the number of tasks puts each task in each place equally often
  int warmup = 2;          // rounds before them, run alike but not reported
  int process = 0;         // the number of this process within the study
  std::uint64_t seed = 1;  // seeds the order of the tasks
};

/// One run of one task. As JSON, the hash is a string of 16 hexadecimal digits: many readers of JSON round numbers of
/// 64 bits.
struct Sample {
  std::string task;
  int process = 0;
  int round = 0;
  int position = 0;  // place of the task within its round, from 0
  std::int64_t cpu_ns = 0;
  std::int64_t wall_ns = 0;
  std::uint64_t hash = 0;
};
void to_json(nlohmann::json& json, const Sample& sample);
void from_json(const nlohmann::json& json, Sample& sample);

/// Run every task once per round, each from its restored state, and hand each sample to `sink` once it is measured.
///
/// A block is as many rounds as there are tasks. It starts from an order drawn from (seed, process) and rotates it by
/// one each round: each task takes each place once per block, and its predecessor changes from block to block.
///
/// throws  InputError for no task, two tasks of one name, rounds < 1 or warmup < 0; and whatever a task throws
void run_rounds(std::span<const TimedTask> tasks, const PairedOptions& options,
                const std::function<void(const Sample&)>& sink);

/// A figure of the report.
struct Figure {
  double median = 0.0;
  Interval interval;
};

/// The median of the values, and the interval for it.
///
/// throws  InputError for no value or one that is NaN
Figure figure_of(std::span<const double> values);

/// "1.04 [1.02, 1.07] at 96.9 %".
std::string to_string(const Figure& figure);

/// The time of a task relative to the baseline.
struct Ratio {
  std::string task, baseline;
  Figure cpu, wall;
  std::vector<double> cpu_of_process, wall_of_process;  // the values behind the figures, processes ascending
  std::size_t rounds = 0;                               // over all processes
  std::size_t flagged_rounds = 0;                       // outliers among the CPU ratios of their own process
  std::size_t flagged_processes = 0;                    // outliers in `cpu_of_process`
};
void to_json(nlohmann::json& json, const Ratio& ratio);

/// The ratio of two tasks, from samples of any number of processes in any order.
///
/// Per process, the median over its rounds of (task / baseline in the same round); the figure is the median of those
/// over the processes, with the distribution-free interval over the *processes*. The process is the unit of
/// replication: the address layout, the placement of pages and so the conflicts in caches and predictors are drawn when
/// a process starts and stay until it ends. More rounds in one process repeat the same draw; an interval over rounds
/// would shrink around the accident of that draw and promise a precision that the next process refutes. Rounds only
/// sharpen each process's value: what disturbs both tasks of a round cancels in its ratio, and what hits only one of
/// them is left to the median.
///
/// throws  InputError if either task is missing from a round, occurs twice in it, or the baseline took no time
Ratio paired_ratio(std::span<const Sample> samples, std::string_view task, std::string_view baseline);

/// The absolute times of a task [ns], to be printed next to its ratio and never compared across machines.
struct Times {
  double cpu_median = 0.0, wall_median = 0.0;  // median over processes of the median over rounds
  double cpu_min = 0.0, wall_min = 0.0;        // over all samples
  double cpu_variation = 0.0;                  // standard deviation over mean, all samples
  double wall_variation = 0.0;
};

/// throws  InputError if there is no sample of the task
Times times_of(std::span<const Sample> samples, std::string_view task);

/// Processor time of a task [ns]: the median over processes of the median over rounds, and the interval over processes.
///
/// throws  InputError if there is no sample of the task
Figure cpu_figure(std::span<const Sample> samples, std::string_view task);

/// The different state hashes that a task left, ascending; more than one means that the task is not reproducible.
std::vector<std::uint64_t> hashes_of(std::span<const Sample> samples, std::string_view task);

/// For tasks that start from the same state in every round: each must leave one and the same state, in all processes.
///
/// throws  SolverError that names the first task that does not: the work timed is then not the work compared before
void check_repeats(std::span<const Sample> samples);

}  // namespace dartboard
