#pragma once
// `dartboard tradeoff`: what accuracy costs on a scene, with every integrator and every step.

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
  double most_s = 0.0;              // that one run may take; 0: 8, quick 0.4
  std::uint64_t seed = 1;           // of the order of the integrators
};

/// throws  InputError for an integrator that there is not
void check_tradeoff(const TradeoffPlan& plan);

/// throws  as check_tradeoff, and what reading a scene throws
Report tradeoff_study(const TradeoffPlan& plan, StudyLog& log);

}  // namespace dartboard
