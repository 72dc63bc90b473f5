#include "validation/recommend/recommendation_audit.h"

#include <algorithm>
#include <limits>

#include "core/base/median.h"
#include "core/plain/error.h"

namespace dartboard {
namespace {

using reference::motion_errors;

constexpr double infinity = std::numeric_limits<double>::infinity();

}  // namespace

Audit audit(const TradeoffScene& scene, const SceneReference& reference, const Recommendation& recommendation,
            std::span<const WorkPoint> sweep, const CpuClock& clock, int fewest) {
  const Candidate* pick = recommendation.pick();
  if (pick == nullptr) throw InputError("nothing was recommended");
  Audit a;
  a.error = recommendation.error;
  a.predicted_error = pick->predicted_error;
  a.predicted_cost = pick->predicted_cost;
  a.predicted_evaluations = pick->predicted_evaluations;
  a.printed_s = pick->predicted_s;
  a.pilot_s = recommendation.pilot_s;
  ForceTimer force(scene, clock);
  std::vector<double> costs, seconds;
  double before = force.measure(), total = 0.0;
  for (int k = 0; k < 15 && (k < fewest || total < 0.3) && total < 4.0; ++k) {
    const auto integrator = pick->make();
    const TimedRun run = run_timed(scene, *integrator, pick->setting(), clock);
    const double after = force.measure();
    seconds.push_back(1e-9 * static_cast<double>(run.cpu_ns));
    costs.push_back(static_cast<double>(run.cpu_ns) / (0.5 * (before + after)));
    before = after;
    total += seconds.back();
    a.actual_evaluations = static_cast<double>(run.work.force_evaluations);
    a.actual_error = a.largest_error = run.result.ok() ? std::numeric_limits<double>::quiet_NaN() : infinity;
    if (run.result.ok() && !reference.states.empty()) {
      const reference::MotionErrors errors = motion_errors(scene.motion, run.states, reference.states);
      a.actual_error = errors.x;
      a.largest_error = errors.x_largest;
    }
  }
  a.actual_cost = median_of(costs);
  a.actual_s = median_of(seconds);
  a.predicted_s = a.predicted_cost * a.actual_s / a.actual_cost;  // forces and run timed in turn
  const double errors[]{recommendation.error};
  const Winner winner = winners(sweep, errors)[0];
  a.best = winner.contender;
  a.best_cost = infinity;
  if (!winner.contender.empty()) a.best_cost = winner.cost;
  return a;
}

}  // namespace dartboard
