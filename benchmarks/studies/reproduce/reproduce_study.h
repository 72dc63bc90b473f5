#pragma once
// `dartboard reproduce`: the paper's walks gated and timed, its claims answered; the step of a larger body on all
// cores; all integrators at the extremes.

#include <cstdint>
#include <string>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct ReproducePlan {
  std::string part{};      // "paper", "larger" or "extremes"; empty: all
  bool quick = false;      // fewer processes and rounds, a third of the extremes
  std::uint64_t seed = 1;  // seeds the order in which contenders take turns
};

Report reproduce_study(const ReproducePlan& plan, StudyLog& log);

}  // namespace dartboard
