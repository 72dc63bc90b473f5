#pragma once
// `dartboard bench ablation`: each feature of a scene on from a bare one and off from a full one.

#include <cstdint>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct AblationBenchPlan {
  bool quick = false;      // fewer rounds, fewer processes
  std::uint64_t seed = 1;  // seeds the order of the tasks
};

Report ablation_bench(const AblationBenchPlan& plan, StudyLog& log);

}  // namespace dartboard
