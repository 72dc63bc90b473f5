#pragma once
// `dartboard recommend`: the cheapest integrator and step for an error.

#include <string>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct RecommendPlan {
  std::vector<std::string> scenes;  // names of the study, or scene files
  std::vector<double> errors;       // [edges]
  double budget_s = 0.0;            // budget of the pilots; 0: by the rule
  bool realtime = false;            // says whether the run is as fast as the motion, and which run would be
  bool verify = false;              // run it, against the oracle and a sweep of all methods
  std::string write{};              // the file of the scene with the pick, for one scene and error; empty: none
};

/// throws  IoError if the file to write exists or cannot be written
Report recommend_study(const RecommendPlan& plan, StudyLog& log);

}  // namespace dartboard
