#pragma once
// What is predicted of one method on one scene: its errors, its costs, and the setting for an error.

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
  double safety = 0.93;                             // of the step
  double stability = 0.95;                          // of the limit of stability
  double pilot_part = 0.1;                          // of the cheapest predicted run that all pilots together may take,
  double pilot_floor_s = 0.5;                       // beyond this
  double last_look_s = 0.05;                        // that each of the best two gets in any case
  double most_pilot_s = 4.0;                        // of one pilot, as long as nothing is predicted
  double budget_s = 0.0;                            // that all pilots together may take; 0: the three above say it
  double kept_back = 0.4;                           // of a budget, for longer pilots and timings of the best
  double most_steps = 1e9;                          // of a run; what needs more is left out
  bool adaptive = true;                             // may the method choose its steps?
  std::string only{};                               // the one integrator to consider; empty for all
  std::function<void(const std::string&)> tells{};  // whose pilot has run, after each
};

/// How far a prediction can be trusted.
enum class Confidence : std::uint8_t {
  asymptotic,      // the errors of the pilots fall as the order says
  pre_asymptotic,  // they do not yet: a smaller order is used, and less than the error aimed at
  sufficient,      // the coarsest stable steps are accurate enough by far; no order was looked for
  none             // the pilots failed
};
std::string_view name(Confidence confidence);

/// What is predicted of one method.
struct Candidate {
  std::string contender;  // as in tradeoff_contenders(): "rk4", "dormand-prince-54-adaptive"
  bool implicit = false, adaptive = false;
  std::string pruned;    // why it was left out before or after its pilots; empty when it was not
  bool untried = false;  // because there was no time left for pilots: nothing is known against it
  Confidence confidence = Confidence::none;
  bool full_length = false;  // pilots over the whole duration confirm it
  double seen_part = 1.0;    // of the duration, by the longest pilots; the rest is predicted
  double growth_rate = 0.0;  // [1/s] of errors, where they were seen to grow as those of chaotic motions do; else 0
  int order = 1;
  double observed_order = 0.0;  // of an adaptive one, the power of the tolerance
  double limit_h = 0.0;         // [s] the predicted limit of stability; infinite when there is none

  // error(h) = error_at_pilot (h / pilot_h)^slope, over the whole duration; above pilot_h what coarser pilots showed.
  // Of an adaptive one, h is a tolerance [edges] here, and is not extrapolated upwards. Rounding comes on top.
  double pilot_h = 0.0, error_at_pilot = 0.0, slope = 1.0;
  struct Seen {
    double h, error;
    double steps = 0.0;  // taken in all; of adaptive ones
  };
  std::vector<Seen> coarser{};  // ascending in step and error
  RoundingFloor rounding{};
  // force evaluations whose time a step takes (h) = step_cost (h / pilot_h)^step_slope; and those counted in a step
  double step_cost = 0.0, step_slope = 0.0, step_evaluations = 0.0;
  // the steps that an adaptive one takes = pilot_steps (tolerance / pilot_h)^-steps_slope, below pilot_h
  double pilot_steps = 0.0, steps_slope = 0.0;
  double duration = 0.0;  // [s] of the whole run

  // for the error asked for
  std::uint64_t steps = 0;
  double h = 0.0, tolerance = 0.0;  // [s], of an adaptive one the mean; [edges] 0 for fixed steps
  double predicted_error = 0.0, predicted_s = 0.0, predicted_cost = 0.0;  // cost: in the time of one
  double predicted_evaluations = 0.0;                                     // of the forces, counted
  bool limited_by_stability = false;
  bool fewest_steps = false;  // one for each checkpoint: fewer were not tried
  // [edges] the least that the method reaches, where rounding keeps it from the error asked for; else 0
  double least_error = 0.0;

  bool usable() const { return pruned.empty(); }
  /// Over the whole duration [edges], rounding included.
  double error_at(double step) const;
  /// The step (or tolerance) of the least error: in shorter ones rounding adds up to more than they save.
  double best_step() const;
  RunSetting setting() const { return adaptive ? RunSetting{.tolerance = tolerance} : RunSetting{.steps = steps}; }
  /// The integrator to run it with.
  std::unique_ptr<Integrator> make() const;
};

/// What fixed steps reach when the run may take as long as what it simulates.
struct RealTime {
  double error = std::numeric_limits<double>::quiet_NaN();  // [edges]; NaN when nobody is fast enough
  std::string by;
};
/// The least error of the usable candidates. Predictions that are no finite number are passed over.
///
/// units   force_s is what an evaluation of the forces takes; stability as in RecommendOptions
RealTime best_in_real_time(std::span<const Candidate> candidates, double force_s, double stability);

/// The step or tolerance that meets an error, and what it costs, by a candidate's fits; sets the last group of its
/// members. Where rounding leaves more than the error at every step, or the steps are too many, the candidate is left
/// out; what is predicted then is of its best step.
///
/// Steps are whole between checkpoints; those split at the times of events are counted.
void solve_for_error(Candidate& candidate, double error, const reference::NetworkMotion& motion, double force_s,
                     const RecommendOptions& options);

}  // namespace dartboard
