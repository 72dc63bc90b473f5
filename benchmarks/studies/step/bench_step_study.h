#pragma once
// `dartboard bench step`: the cost of an RK4 step over springs, compared with the naive graph and with what the machine
// allows; of bodies that have changed with fresh ones; and with a change in every step.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"
#include "benchmarks/studies/step/bench_step_report.h"

namespace dartboard {

struct StepBenchPlan {
  bool quick = false;                           // bodies of up to 10^5 tetrahedra, fewer processes and rounds
  std::uint64_t seed = 1;                       // seeds the order of the tasks, shuffled meshes, velocities and changes
  std::vector<std::filesystem::path> meshes{};  // of further bodies
};

Report step_bench(const StepBenchPlan& plan, StudyLog& log);

/// The steps of bodies that do not change: compared in a process of its own and, where they agree, timed in as many
/// processes and rounds as a quick run of the study has, or a whole one. Samples are those of a folder within that of
/// the run.
StepCosts measure_steps(const StepCostPlan& plan, bool quick, StudyLog& log, const std::string& folder = "");

}  // namespace dartboard
