#include "core/scene/scene_run.h"

#include <algorithm>

namespace dartboard {

RunResult run_scene(Simulation& simulation, const OutputPlan& times, RunWatcher& watcher,
                    std::optional<std::uint64_t> most_steps) {
  const OutputPlan plan = times.in_steps_of(simulation.step());
  const std::uint64_t end = std::min(simulation.step_count(), most_steps.value_or(simulation.step_count()));
  RunResult result;
  result.first = result.last = simulation.diagnostics();
  watcher.frame(simulation.frame());
  watcher.diagnostics(result.first);
  while (simulation.steps_done() < end) {
    result.divergence = simulation.advance();
    if (result.divergence) break;
    const std::uint64_t n = simulation.steps_done();
    const auto due = [n, end](const std::optional<std::uint64_t>& every) {
      return n == end || (every && n % *every == 0);
    };
    if (due(plan.frame_steps)) watcher.frame(simulation.frame());
    if (due(plan.diagnostic_steps)) {
      result.last = simulation.diagnostics();
      watcher.diagnostics(result.last);
    }
    watcher.stepped(simulation);
  }
  return result;
}

}  // namespace dartboard
