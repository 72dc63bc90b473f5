#pragma once
// Short runs of a scene, timed, within a limit for all of them together.

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "validation/recommend/candidate.h"

namespace dartboard {

struct PilotRun {
  TimedRun run;
  double step_cost = 0.0;  // in force evaluations, timed before and after
  double cpu_s = 0.0;
};

/// A scene up to a part of its duration, with checkpoints of its own; events after that are left out.
///
/// pre  0 < part <= 1
TradeoffScene first_part(const TradeoffScene& scene, double part, std::size_t checkpoints);

/// Runs pilots and counts the time that they take.
class Pilots {
 public:
  /// `start` is the time of the clock from which all is counted.
  /// pre  the arguments outlive it
  Pilots(const TradeoffScene& scene, const CpuClock& clock, const RecommendOptions& options, std::int64_t start);

  /// One pilot with the integrator of a candidate, on the scene or on a part of it.
  PilotRun run(const Candidate& candidate, const TradeoffScene& scene, const RunSetting& setting,
               std::size_t checkpoints = std::numeric_limits<std::size_t>::max());

  /// The cost of a step of a candidate's fixed setting in force evaluations: the median of short runs, each between two
  /// timings of the forces.
  /// pre  the candidate has been solved for an error
  double step_cost(const Candidate& candidate);

  /// The time [s] of a step of h, measured over some steps from the start.
  double step_seconds(const Candidate& candidate, double h);

  double spent_s() const;
  /// The time left for pilots; without a budget, `most_pilot_s` for the next one as long as nothing is predicted.
  double left_s() const;
  /// Report the predicted time of a run [s]: the cheapest counts.
  void predicted(double seconds) { cheapest_s_ = std::min(cheapest_s_, seconds); }
  double cheapest_s() const { return cheapest_s_; }

  /// [s] The time that a timing of the forces takes: short where the budget is small.
  double timing_s() const;

  const TradeoffScene& scene() const { return scene_; }
  const RecommendOptions& options() const { return options_; }

 private:
  const TradeoffScene& scene_;
  const CpuClock& clock_;
  const RecommendOptions& options_;
  std::int64_t start_;
  ForceTimer force_;
  double force_ns_ = std::numeric_limits<double>::infinity();  // the least so far
  double cheapest_s_ = std::numeric_limits<double>::infinity();
};

/// The distances [edges] of two runs of a scene, one for each checkpoint that both have reached.
std::vector<double> differences(const TradeoffScene& scene, const TimedRun& a, const TimedRun& b);

/// The largest distance [edges] of a point from the place of its number at the start: distinguishes a motion from an
/// explosion, also where an event has given some numbers to other points. NaN propagates.
double distance_from_start(const TradeoffScene& scene, const TimedRun& run);

/// The number of steps of at most h, equal between any two checkpoints: others would be split there, to unequal sizes.
std::uint64_t whole_steps(const TradeoffScene& scene, double h);

}  // namespace dartboard
