#pragma once
// `dartboard bench contact`: the cost of contact at rest, in a pile, after a cut, and its growth with the body.

#include <cstdint>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct ContactBenchPlan {
  bool quick = false;      // small plates, fewer processes
  std::uint64_t seed = 1;  // seeds the order of the tasks and the places in the pile
};

Report contact_bench(const ContactBenchPlan& plan, StudyLog& log);

}  // namespace dartboard
