#pragma once
// `dartboard validate solvers`: are the solutions of linear systems right, and what do they cost?

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct SolverPlan {
  std::vector<std::string> only{};  // of the parts; empty: all
  bool quick = false;               // smaller bodies, one size, fewer repetitions
  std::uint64_t seed = 1;           // seeds the order of the timed tasks
};

/// "accuracy", "edits", "updates", "crossover", "steps"
std::span<const std::string_view> solver_parts();

/// throws  InputError for an unknown part
Report solver_study(const SolverPlan& plan, StudyLog& log);

}  // namespace dartboard
