#pragma once
// `dartboard validate order`: do the integrators have the orders they claim, also on a user's scenes, and are their
// maps the exact ones?

#include <string>
#include <vector>

#include "benchmarks/report/report.h"
#include "benchmarks/report/study_log.h"

namespace dartboard {

struct OrderPlan {
  std::vector<std::string> integrators{};  // empty: all
  bool quick = false;                      // fewer halvings and steps, a wider window of errors
  std::vector<std::string> scenes{};       // scene files, or names of the study; empty: the study's own question
};

/// With scenes, the orders that integrators show on these; else on the study's own, compared with the exact maps, and
/// what goes with it.
///
/// throws  InputError for an unknown integrator, and as find_scene
Report order_study(const OrderPlan& plan, StudyLog& log);

}  // namespace dartboard
