#pragma once
// `dartboard recommend`: the cheapest integrator and step for an error.

#include <string>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct RecommendPlan {
  std::string scene;           // a name of the study, or a scene file
  std::vector<double> errors;  // [edges]
  double budget_s = 0.0;       // budget of the pilots; 0: by the rule
  bool realtime = false;       // says whether the run is as fast as the motion, and which run would be
  bool verify = false;         // run it, against the oracle and a sweep of all methods
};

Report recommend_study(const RecommendPlan& plan, StudyLog& log);

}  // namespace dartboard
