#pragma once
// A recommendation beside what happens when it is followed.

#include <span>
#include <string>

#include "validation/recommend/recommend.h"
#include "validation/tradeoff/work_precision.h"

namespace dartboard {

struct Audit {
  double error = 0.0, actual_error = 0.0, predicted_error = 0.0;
  double actual_cost = 0.0, predicted_cost = 0.0;                // in force evaluations: times, measured in turn
  double actual_evaluations = 0.0, predicted_evaluations = 0.0;  // counted
  double actual_s = 0.0, predicted_s = 0.0;                      // at the speed of the machine during the run
  double printed_s = 0.0;                                        // what was predicted, as it was printed
  double pilot_s = 0.0;
  std::string best;        // of the sweep, for that error
  double best_cost = 0.0;  // infinite when no run of the sweep meets it
  bool met() const { return actual_error <= error; }
  double regret() const { return actual_cost / best_cost; }
};

/// Run the pick and compare it with the reference and with a sweep; three times at least, if that takes no longer than
/// four seconds, or `fewest` times. Where the reference has no states, the actual error
/// is not a number.
///
/// throws  InputError when there is no pick
Audit audit(const TradeoffScene& scene, const SceneReference& reference, const Recommendation& recommendation,
            std::span<const WorkPoint> sweep, const CpuClock& clock, int fewest = 3);

}  // namespace dartboard
