#pragma once
// `dartboard bench step`: the cost of an RK4 step over springs, compared with the naive graph and with what the machine
// allows; of bodies that have changed with fresh ones; and with a change in every step.

#include <cstdint>
#include <filesystem>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct StepBenchPlan {
  bool quick = false;                           // bodies of up to 10^5 tetrahedra, fewer processes and rounds
  std::uint64_t seed = 1;                       // seeds the order of the tasks, shuffled meshes, velocities and changes
  std::vector<std::filesystem::path> meshes{};  // of further bodies
};

Report step_bench(const StepBenchPlan& plan, StudyLog& log);

}  // namespace dartboard
