#pragma once
// `dartboard bench operations`: what each operation costs, by size of the body, beside the time of a step.

#include <cstdint>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct OperationsBenchPlan {
  bool quick = false;      // small bodies, fewer processes
  std::uint64_t seed = 1;  // of the places of the operations
};

Report operations_bench(const OperationsBenchPlan& plan, StudyLog& log);

}  // namespace dartboard
