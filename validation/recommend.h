#pragma once
// Which integrator, with which step, is the cheapest for a scene and an error: predicted from short runs, without a
// reference.

#include <span>
#include <string>
#include <vector>

#include "validation/scene_features.h"
#include "validation/work_precision.h"

namespace dartboard {

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
  std::string contender;
  bool implicit = false;
  std::string pruned;  // why it was left out before or after its pilots; empty when it was not
  Confidence confidence = Confidence::none;
  bool full_length = false;  // pilots over the whole duration confirm it
  int order = 1;
  double observed_order = 0.0;
  double limit_h = 0.0;  // [s] the predicted limit of stability; infinite when there is none

  // error(h) = error_at_pilot (h / pilot_h)^slope, over the whole duration
  double pilot_h = 0.0, error_at_pilot = 0.0, slope = 1.0;
  // force evaluations that a step is worth (h) = step_cost (h / pilot_h)^step_slope
  double step_cost = 0.0, step_slope = 0.0;

  // for the error asked for
  std::uint64_t steps = 0;
  double h = 0.0, predicted_error = 0.0, predicted_s = 0.0, predicted_cost = 0.0;  // cost: in force evaluations
  bool limited_by_stability = false;

  bool usable() const { return pruned.empty(); }
};

struct RecommendOptions {
  double safety = 0.9;        // of the step
  double stability = 0.95;    // of the limit of stability
  double confirm_part = 0.1;  // of the predicted run that full-length pilots may take,
  double confirm_s = 0.3;     // or this many seconds
  double most_pilot_s = 4.0;  // of one pilot
};

struct Recommendation {
  std::string scene;
  double error = 0.0;  // [edges] asked for
  SceneFeatures features;
  std::vector<Candidate> candidates;  // usable ones first, the cheapest first
  double one_more_digit = 0.0;        // predicted cost of a tenth of the error over that of the error
  std::string one_more_digit_by;      // with which method
  double realtime_factor = 0.0;       // simulated over predicted seconds of the pick
  double realtime_error = 0.0;        // what the best method would reach in real time; NaN when none is fast enough
  std::string realtime_by;
  double pilot_s = 0.0;  // spent on all of this

  const Candidate* pick() const;
  const Candidate* runner_up() const;
};

/// The algorithm:
///
/// 1. features of the scene, and of this machine;
/// 2. explicit methods: three pilots with h, h/2 and h/4, from the largest stable step on, on the first quarter of the
///    scene or up to the checkpoint after its first event; Richardson's estimate at each checkpoint, the observed
///    order, and the growth of the error with time give the error of the whole run;
/// 3. implicit methods by the break-even law: steps that the motion needs at their order, times the cost of a step;
/// only
///    those that might beat the cheapest explicit one get pilots;
/// 4. the step for the error, by the order, with safety and within stability; pilots of full length, coarser than that
///    step, for the best two, where they are stable and cheap enough;
/// 5. the ranking by predicted cost.
///
/// throws  InputError unless error > 0
Recommendation recommend(const TradeoffScene& scene, double error, const CpuClock& clock,
                         const RecommendOptions& options = {});

/// The step that meets an error, and what it costs, by a candidate's fits; sets the last group of its members.
void solve_for_error(Candidate& candidate, double error, double duration, std::size_t checkpoints, double force_s,
                     const RecommendOptions& options);

/// A prediction beside what happened.
struct Audit {
  double error = 0.0, actual_error = 0.0, predicted_error = 0.0;
  double actual_cost = 0.0, predicted_cost = 0.0, actual_s = 0.0;
  std::string best;        // of the sweep, for that error
  double best_cost = 0.0;  // infinite when no run of the sweep meets it
  bool met() const { return actual_error <= error; }
  double regret() const { return actual_cost / best_cost; }
};

/// Run the pick and compare it with the reference and with a sweep.
///
/// throws  InputError when there is no pick
Audit audit(const TradeoffScene& scene, const SceneReference& reference, const Recommendation& recommendation,
            std::span<const WorkPoint> sweep, const CpuClock& clock);

}  // namespace dartboard
