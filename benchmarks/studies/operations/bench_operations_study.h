#pragma once
// `dartboard bench operations`: the cost of each operation, by size of the body, compared with the time of a step.

#include <cstdint>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct OperationsBenchPlan {
  bool quick = false;      // small bodies, fewer processes
  std::uint64_t seed = 1;  // seeds the places of the operations
};

Report operations_bench(const OperationsBenchPlan& plan, StudyLog& log);

}  // namespace dartboard
