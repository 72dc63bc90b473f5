#pragma once
// A recommendation compared with the outcome of following it.

#include <limits>
#include <span>
#include <string>

#include "validation/recommend/recommend.h"
#include "validation/tradeoff/work_precision.h"

namespace dartboard {

struct Audit {
  // [edges] root mean squares over the mass, the largest over time; and the largest of any vertex
  double error = 0.0, actual_error = 0.0, predicted_error = 0.0;
  double largest_error = std::numeric_limits<double>::quiet_NaN();
  double actual_cost = 0.0, predicted_cost = 0.0;                // in force evaluations, by time: both timed in turn
  double actual_evaluations = 0.0, predicted_evaluations = 0.0;  // counted
  double actual_s = 0.0, predicted_s = 0.0;                      // at the speed of the machine during the run
  double printed_s = 0.0;                                        // the prediction as it was printed
  double pilot_s = 0.0;
  std::string best;        // of the sweep, for that error
  double best_cost = 0.0;  // infinite when no run of the sweep meets it
  bool met() const { return actual_error <= error; }
  double regret() const { return actual_cost / best_cost; }
};

/// Run the pick and compare it with the reference and with a sweep; at least `fewest` times, if
/// that takes no longer than four seconds. Where the reference has no states, the actual error is
/// NaN.
///
/// throws  InputError when there is no pick
Audit audit(const TradeoffScene& scene, const SceneReference& reference, const Recommendation& recommendation,
            std::span<const WorkPoint> sweep, const CpuClock& clock, int fewest = 3);

}  // namespace dartboard
