#pragma once
// `dartboard validate order`: do the integrators have the orders they claim, and are their maps the exact ones?

#include <string>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct OrderPlan {
  std::vector<std::string> integrators{};  // empty: all
  bool quick = false;                      // fewer halvings and steps, a wider window of errors
};

/// throws  InputError for an unknown integrator
Report order_study(const OrderPlan& plan, StudyLog& log);

}  // namespace dartboard
