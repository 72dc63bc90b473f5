#pragma once
// `dartboard bench large`: the time and the memory of each part of a run, up to ten million tetrahedra.

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct LargeBenchPlan {
  bool quick = false;  // the smallest body alone, in fewer processes
};

Report large_bench(const LargeBenchPlan& plan, StudyLog& log);

}  // namespace dartboard
