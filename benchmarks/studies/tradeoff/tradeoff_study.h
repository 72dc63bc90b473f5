#pragma once
// `dartboard tradeoff`: the cost of accuracy on a scene, with every integrator and every step.

#include <cstdint>
#include <string>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct TradeoffPlan {
  std::vector<std::string> scenes;  // names of the study, or scene files
  std::vector<std::string> only{};  // names of the integrators that take part; empty: all
  bool solvers = false;             // implicit methods with every linear solver
  bool quick = false;               // short runs, few repetitions
  double most_s = 0.0;              // limit on the time of one run; 0: 8, quick 0.4
  std::uint64_t seed = 1;           // seeds the order of the integrators
};

/// throws  InputError for an unknown integrator
void check_tradeoff(const TradeoffPlan& plan);

/// throws  as check_tradeoff, and what reading a scene throws
Report tradeoff_study(const TradeoffPlan& plan, StudyLog& log);

}  // namespace dartboard
