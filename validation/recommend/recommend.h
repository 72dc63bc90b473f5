#pragma once
// The cheapest integrator and its step for a scene and an error, predicted from short runs, without a
// reference.

#include <string>
#include <vector>

#include "validation/recommend/candidate.h"
#include "validation/scenes/scene_features.h"

namespace dartboard {

struct Recommendation {
  std::string scene;
  double error = 0.0;  // [edges] requested
  SceneFeatures features;
  std::vector<Candidate> candidates;  // usable ones first, of these fixed steps before tolerances, the cheapest first
  double one_more_digit = 0.0;        // predicted cost of a tenth of the error over that of the error
  std::string one_more_digit_by;      // with which method
  double realtime_factor = 0.0;       // simulated over predicted seconds of the pick
  double realtime_error = 0.0;        // the error of the best method in real time; NaN when none is fast enough
  std::string realtime_by;
  double best_error = 0.0;  // [edges] where rounding keeps every method from the error: the least of all
  std::string best_error_by;
  double pilot_s = 0.0;  // spent in all
  /// The methods that there was no time to try: another run may pick one of them.
  std::vector<std::string> untried() const;

  /// The cheapest with fixed steps, as a simulation of a scene takes them; null where there is none.
  const Candidate* pick() const;
  const Candidate* runner_up() const;  // with fixed steps
  /// One that chooses its steps within a tolerance, for programs, if it is cheaper than the pick.
  const Candidate* cheaper_by_tolerance() const;
};

/// The algorithm:
///
/// 1. features of the scene, and of this machine;
/// 2. explicit methods, those first that are cheapest as a rule: three to five pilots with h, h/2 and h/4, ... until
///    their order shows, from the largest stable step on (`pilot_prefix`); a method is left out if even its largest
///    stable step costs more than the best so far. On stiff scenes they would use up the time for pilots: they leave a
///    part of it, and implicit methods that take far less by the law (4.) than the first explicit one come before the
///    second;
/// 3. methods that choose their steps, where they might win: pilots with three or four tolerances;
/// 4. implicit methods by the break-even law: steps that the motion needs at their order, times the cost of a step;
///    only those that might beat the cheapest explicit one get pilots;
/// 5. the step or tolerance for the error, by the order, with safety and within stability; longer pilots, coarser than
///    that step, for the best two, where they are stable and cheap enough (`pilot_longer`); their steps timed again;
/// 6. the ranking by predicted cost, fixed steps first; compensated methods take part where rounding keeps all others
/// from the error.
///
/// All pilots together take no longer than a floor and a part of the cheapest predicted run (RecommendOptions); methods
/// that have had none by then are left out and reported (`untried`). They may differ from run to run.
///
/// Through contact a part of a motion foresees nothing: all pilots are whole runs (`pilot_whole`), no method chooses
/// its steps, and the recommendation may take ten times as long as the run. Nothing is recommended where no errors
/// fall with the step, as in chaotic piles.
///
/// throws  InputError unless error > 0
Recommendation recommend(const TradeoffScene& scene, double error, const CpuClock& clock,
                         const RecommendOptions& options = {});

}  // namespace dartboard
