#pragma once
// Timing of the contenders on one scene: the plan, the child processes that carry it out, and the samples they return.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmarks/harness/paired.h"
#include "benchmarks/report/study_log.h"
#include "core/plain/problem.h"

namespace dartboard {

/// The number of steps of one timed run of a contender: slow walks take fewer, so that rounds stay short and fast ones
/// are well above the clock's resolution. A fixed number for all of a study.
struct TimedContender {
  std::string id;
  int steps;
};

struct MeasurePlan {
  std::string scene;
  std::vector<TimedContender> contenders;
  int processes = 11;
  int rounds = 24;
  std::uint64_t seed = 1;
};

/// A sample and the number of steps it took; one line of samples.jsonl.
struct StepSample {
  Sample sample;
  int steps;
};
void to_json(nlohmann::json& json, const StepSample& s);
void from_json(const nlohmann::json& json, StepSample& s);

/// Choose the steps from one untimed look at each contender.
MeasurePlan plan_measurement(const std::string& scene, const Problem& problem, const std::vector<std::string>& ids,
                             bool quick, std::uint64_t seed, StudyLog& log);

/// Carry out the plan in `plan.processes` processes of this executable, one after the other.
///
/// throws  SolverError for a contender that does not leave the same state in all rounds and processes
std::vector<StepSample> measure(const MeasurePlan& plan, StudyLog& log);

/// The samples scaled to nanoseconds per step.
std::vector<Sample> per_step(const std::vector<StepSample>& samples);

}  // namespace dartboard
