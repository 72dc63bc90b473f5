#include "core/scene/run/scene_run.h"

#include <algorithm>
#include <cmath>
#include <variant>

#include "core/time/solve/stop_request.h"

namespace dartboard {
namespace {

/// Hands out a frame, if it is taken; returns the largest stress, where the frame has it.
std::optional<double> hand_out_frame(const Simulation& simulation, RunWatcher& watcher) {
  if (!watcher.takes_frames()) return std::nullopt;
  const Frame frame = simulation.frame();
  watcher.frame(frame);
  return frame.largest_stress;
}

/// Hands out the state after the last step taken in every form in which it has not been due.
void hand_out_the_rest(const Simulation& simulation, const OutputPlan& plan,
                       const std::optional<std::uint64_t>& probe_steps, RunWatcher& watcher, RunProgress& progress) {
  const std::uint64_t n = simulation.steps_done();
  const auto lacks = [n](const std::optional<std::uint64_t>& every) { return n > 0 && !(every && n % *every == 0); };
  std::optional<double> stress;
  if (lacks(plan.frame_steps)) stress = hand_out_frame(simulation, watcher);
  if (lacks(plan.diagnostic_steps)) {
    progress.last = simulation.diagnostics(stress);
    progress.drift.add(progress.last);
    watcher.diagnostics(progress.last);
  }
  if (lacks(probe_steps)) watcher.probes(simulation.probes());
}

/// Hands out the last good state of a diverged motion, unless it or a later one was handed out, or it is not finite.
void hand_out_what_is_kept(const Simulation& simulation, const RunProgress& progress, RunWatcher& watcher) {
  if (!is_finite(progress.last)) return;
  if (simulation.time() > progress.frame_time) watcher.frame(simulation.frame());
  if (simulation.time() > progress.diagnostics_time) watcher.diagnostics(progress.last);
}

}  // namespace

double mass_unaccounted_for(double start, double removed, double end) {
  return start == 0.0 ? 0.0 : std::abs(start - removed - end) / start;
}

RunResult run_scene(Simulation& simulation, const OutputPlan& times, RunWatcher& watcher,
                    std::optional<std::uint64_t> most_steps, const RunProgress* continued) {
  const OutputPlan plan = times.in_steps_of(simulation.step());
  const std::optional<std::uint64_t> probe_steps = plan.probe_steps ? plan.probe_steps : plan.diagnostic_steps;
  const std::uint64_t end = std::min(simulation.step_count(), most_steps.value_or(simulation.step_count()));
  RunResult result;
  RunProgress progress;
  if (continued != nullptr) {
    progress = *continued;
  } else {
    const std::optional<double> stress = hand_out_frame(simulation, watcher);
    progress.first = progress.last = simulation.diagnostics(stress);
    progress.drift = EnergyDrift(progress.first);
    watcher.diagnostics(progress.first);
    watcher.probes(simulation.probes());
  }
  if (simulation.step_count() == 0) result.divergence = simulation.start_failure();
  while (simulation.steps_done() < end && !result.interrupted) {
    try {
      if (const auto early = simulation.advance()) {
        if (const auto* divergence = std::get_if<Divergence>(&*early)) result.divergence = *divergence;
        if (const auto* refusal = std::get_if<StepRefusal>(&*early)) result.refusal = *refusal;
      }
    } catch (const Stopped&) {
      result.interrupted = true;
      if (simulation.undo_stopped_step()) watcher.checkpoint(simulation, progress);
      hand_out_the_rest(simulation, plan, probe_steps, watcher, progress);
      break;
    }
    if (result.ended_early()) {
      progress.last = simulation.diagnostics();
      hand_out_what_is_kept(simulation, progress, watcher);
      break;
    }
    const std::uint64_t n = simulation.steps_done();
    result.interrupted = n < end && watcher.interrupts();
    const bool is_over = n == simulation.step_count();
    const auto due = [&](const std::optional<std::uint64_t>& every) { return is_over || (every && n % *every == 0); };
    std::optional<double> stress;
    if (due(plan.frame_steps)) {
      stress = hand_out_frame(simulation, watcher);
      progress.frame_time = simulation.time();
    }
    if (due(plan.diagnostic_steps)) {
      progress.last = simulation.diagnostics(stress);
      progress.diagnostics_time = simulation.time();
      progress.drift.add(progress.last);
      watcher.diagnostics(progress.last);
    }
    if (due(probe_steps)) watcher.probes(simulation.probes());
    const bool is_cut_short = n == end && !is_over;
    if (result.interrupted || is_cut_short || (plan.checkpoint_steps && (is_over || n % *plan.checkpoint_steps == 0)))
      watcher.checkpoint(simulation, progress);
    // a run that ends here for now hands out a state that its continuation will not
    if (is_cut_short || result.interrupted) hand_out_the_rest(simulation, plan, probe_steps, watcher, progress);
    watcher.stepped(simulation);
  }
  result.first = progress.first;
  result.last = progress.last;
  result.energy_drift = progress.drift.value();
  return result;
}

}  // namespace dartboard
