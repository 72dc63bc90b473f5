#pragma once
// Predictions for one method on one scene: its errors, its costs, and the setting for an error.

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/time/method/integrator.h"
#include "validation/scenes/scene_stage.h"
#include "validation/tradeoff/rounding_floor.h"

namespace dartboard {

struct RecommendOptions {
  double safety = 0.93;                             // factor of the step
  double stability = 0.95;                          // factor of the limit of stability
  double pilot_part = 0.1;                          // for all pilots together: this part of the cheapest predicted run,
  double pilot_floor_s = 0.5;                       // and this in addition
  double last_look_s = 0.25;                        // for each of the best two in any case
  double most_pilot_s = 4.0;                        // for one pilot, as long as nothing is predicted
  double budget_s = 0.0;                            // for all pilots together; 0: given by the options above
  double kept_back = 0.4;                           // part of a budget, for longer pilots and timings of the best
  double most_steps = 1e9;                          // of a run; methods that need more are left out
  bool adaptive = true;                             // may the method choose its steps?
  std::string only{};                               // the one integrator to consider; empty for all
  std::function<void(const std::string&)> tells{};  // called after each pilot, with the name of its method
};

/// The confidence in a prediction.
enum class Confidence : std::uint8_t {
  asymptotic,      // the errors of the pilots fall with the order of the method
  pre_asymptotic,  // not yet: a smaller order is used, and a smaller error is aimed at
  sufficient,      // the coarsest stable steps are accurate enough by far; no order was looked for
  none             // the pilots failed
};
std::string_view name(Confidence confidence);

/// The predictions for one method.
struct Candidate {
  std::string contender;  // as in tradeoff_contenders(): "rk4", "dormand-prince-54-adaptive"
  bool implicit = false, adaptive = false;
  std::string pruned;    // why it was left out before or after its pilots; empty when it was not
  bool untried = false;  // there was no time left for its pilots: nothing shows that it is worse
  Confidence confidence = Confidence::none;
  bool full_length = false;     // pilots over the whole duration confirm it
  double seen_part = 1.0;       // of the duration, by the longest pilots; the rest is predicted
  double growth_rate = 0.0;     // [1/s] of errors, where they were seen to grow as those of chaotic motions do; else 0
  int order = 1;                // of the method, or what contact leaves of it
  double observed_order = 0.0;  // for an adaptive one, the power of the tolerance
  double limit_h = 0.0;         // [s] the predicted limit of stability; infinite when there is none

  // error(h) = error_at_pilot (h / pilot_h)^slope, over the whole duration; above pilot_h by the coarser pilots. For an
  // adaptive one, h is a tolerance [edges] here, and is not extrapolated upwards. Rounding is added.
  double pilot_h = 0.0, error_at_pilot = 0.0, slope = 1.0;
  struct Seen {
    double h, error;
    double steps = 0.0;  // taken in all; for adaptive ones
  };
  std::vector<Seen> coarser{};  // ascending in step and error
  RoundingFloor rounding{};
  // time of a step in force evaluations = step_cost (h / pilot_h)^step_slope; and the evaluations counted in a step
  double step_cost = 0.0, step_slope = 0.0, step_evaluations = 0.0;
  // the steps that an adaptive one takes = pilot_steps (tolerance / pilot_h)^-steps_slope, below pilot_h
  double pilot_steps = 0.0, steps_slope = 0.0;
  double duration = 0.0;  // [s] of the whole run

  // for the requested error
  std::uint64_t steps = 0;
  double h = 0.0, tolerance = 0.0;  // [s], for an adaptive one the mean; [edges] 0 for fixed steps
  double predicted_error = 0.0, predicted_s = 0.0, predicted_cost = 0.0;  // cost: time in force evaluations
  double predicted_evaluations = 0.0;                                     // force evaluations, counted
  bool limited_by_stability = false;
  bool fewest_steps = false;  // one for each checkpoint: fewer were not tried
  // [edges] the least error of the method, where rounding keeps it from the requested one; else 0
  double least_error = 0.0;

  bool usable() const { return pruned.empty(); }
  /// The error over the whole duration [edges], rounding included.
  double error_at(double step) const;
  /// The step (or tolerance) of the least error: in shorter ones rounding adds up to more than they save.
  double best_step() const;
  RunSetting setting() const { return adaptive ? RunSetting{.tolerance = tolerance} : RunSetting{.steps = steps}; }
  /// The integrator to run it with.
  std::unique_ptr<Integrator> make() const;
};

/// The error of fixed steps in a run that may take as long as the motion that it simulates.
struct RealTime {
  double error = std::numeric_limits<double>::quiet_NaN();  // [edges]; NaN when no method is fast enough
  std::string by;
};
/// The least error of the usable candidates. Predictions that are not finite are skipped.
///
/// units   force_s is the time of a force evaluation; stability as in RecommendOptions
RealTime best_in_real_time(std::span<const Candidate> candidates, double force_s, double stability);

/// Find the step or tolerance that meets an error, and its cost, by a candidate's fits; sets the last group of its
/// members. Where rounding exceeds the error at every step, or the steps are too many, the candidate is left out; the
/// predictions are then those of its best step.
///
/// Their number is whole between checkpoints; steps that are split at the times of events are counted.
void solve_for_error(Candidate& candidate, double error, const reference::NetworkMotion& motion, double force_s,
                     const RecommendOptions& options);

}  // namespace dartboard
