#pragma once
// `dartboard validate judges`: would the judges of integrators notice a wrong one?

#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct JudgesPlan {
  bool quick = false;  // a sample of the matrix of extremes, orders of three methods
  std::string axis{};  // of the matrix alone; empty: all of it, and the other judges
};

/// throws  InputError for an unknown axis
Report judges_study(const JudgesPlan& plan, StudyLog& log);

}  // namespace dartboard
