#include "core/scene/run/scene_run.h"

#include <algorithm>
#include <cmath>

#include "core/plain/nan_maximum.h"
#include "core/time/solve/stop_request.h"

namespace dartboard {
namespace {

class EnergyDrift {
 public:
  explicit EnergyDrift(const Diagnostics& first) : start_(first.energy()) { add(first); }
  void add(const Diagnostics& d) {
    change_ = max_or_nan(change_, std::abs(d.energy() - start_));
    size_ = max_or_nan(size_, d.kinetic + d.elastic);
  }
  double value() const { return change_ == 0.0 ? 0.0 : change_ / size_; }

 private:
  double start_, change_ = 0.0, size_ = 0.0;
};

/// The state after the last step that was taken: to whom it has not been due.
void hand_out_the_rest(const Simulation& simulation, const OutputPlan& plan,
                       const std::optional<std::uint64_t>& probe_steps, RunWatcher& watcher, RunResult& result) {
  const std::uint64_t n = simulation.steps_done();
  const auto lacks = [n](const std::optional<std::uint64_t>& every) { return n > 0 && !(every && n % *every == 0); };
  if (lacks(plan.frame_steps)) watcher.frame(simulation.frame());
  if (lacks(plan.diagnostic_steps)) {
    result.last = simulation.diagnostics();
    watcher.diagnostics(result.last);
  }
  if (lacks(probe_steps)) watcher.probes(simulation.probes());
}

/// When what was handed out last was [s].
struct LastTimes {
  double frame = 0.0, diagnostics = 0.0;
};

/// The last good state of a motion that has diverged, unless it was handed out, or one after it, or it is none.
void hand_out_what_is_kept(const Simulation& simulation, const Diagnostics& kept, const LastTimes& handed_out,
                           RunWatcher& watcher) {
  if (!is_finite(kept)) return;
  if (simulation.time() > handed_out.frame) watcher.frame(simulation.frame());
  if (simulation.time() > handed_out.diagnostics) watcher.diagnostics(kept);
}

}  // namespace

double mass_unaccounted_for(double start, double removed, double end) {
  return start == 0.0 ? 0.0 : std::abs(start - removed - end) / start;
}

RunResult run_scene(Simulation& simulation, const OutputPlan& times, RunWatcher& watcher,
                    std::optional<std::uint64_t> most_steps) {
  const OutputPlan plan = times.in_steps_of(simulation.step());
  const std::optional<std::uint64_t> probe_steps = plan.probe_steps ? plan.probe_steps : plan.diagnostic_steps;
  const std::uint64_t end = std::min(simulation.step_count(), most_steps.value_or(simulation.step_count()));
  RunResult result;
  LastTimes handed_out;
  result.first = result.last = simulation.diagnostics();
  EnergyDrift drift(result.first);
  watcher.frame(simulation.frame());
  watcher.diagnostics(result.first);
  watcher.probes(simulation.probes());
  if (simulation.step_count() == 0) result.divergence = simulation.start_failure();
  while (simulation.steps_done() < end && !result.interrupted) {
    try {
      result.divergence = simulation.advance();
    } catch (const Stopped&) {
      result.interrupted = true;
      hand_out_the_rest(simulation, plan, probe_steps, watcher, result);
      break;
    }
    if (result.divergence) {
      result.last = simulation.diagnostics();
      hand_out_what_is_kept(simulation, result.last, handed_out, watcher);
      break;
    }
    const std::uint64_t n = simulation.steps_done();
    result.interrupted = n < end && watcher.interrupts();
    const auto due = [&](const std::optional<std::uint64_t>& every) {
      return n == end || result.interrupted || (every && n % *every == 0);
    };
    if (due(plan.frame_steps)) {
      watcher.frame(simulation.frame());
      handed_out.frame = simulation.time();
    }
    if (due(plan.diagnostic_steps)) {
      result.last = simulation.diagnostics();
      handed_out.diagnostics = simulation.time();
      drift.add(result.last);
      watcher.diagnostics(result.last);
    }
    if (due(probe_steps)) watcher.probes(simulation.probes());
    watcher.stepped(simulation);
  }
  result.energy_drift = drift.value();
  return result;
}

}  // namespace dartboard
