#pragma once
// The loop of a simulation from start to end, with somebody to watch it.

#include <functional>
#include <optional>

#include "core/scene/run/run_progress.h"
#include "core/scene/run/simulation.h"

namespace dartboard {

/// What a run hands out. Nothing here can change the motion.
class RunWatcher {
 public:
  virtual ~RunWatcher() = default;
  virtual void frame(const Frame&) {}
  virtual void diagnostics(const Diagnostics&) {}
  virtual void probes(const ProbeRow&) {}
  /// A place that the run can be continued from: what has been handed out is what an uninterrupted run hands out until
  /// then.
  virtual void checkpoint(const Simulation&, const RunProgress&) {}
  virtual void stepped(const Simulation&) {}
  /// Asked after every step: must the run end here?
  virtual bool interrupts() { return false; }
};

struct RunResult {
  std::optional<Divergence> divergence;
  bool interrupted = false;
  Diagnostics first, last;  // of those handed out; after a divergence the last of the state that is kept
  // largest change of the total energy in any of them, over the largest sum of kinetic and elastic energy
  double energy_drift = 0.0;
};

/// What became of the mass beyond what removals took, relative to the mass at the start; 0 where there was none.
double mass_unaccounted_for(double start, double removed, double end);

/// Run to the end, to `most_steps`, until the watcher interrupts it or a StopRequest (stop_request.h) a step, or until
/// the motion diverges. The first state is always handed out, and the last; after a divergence the last good one.
///
/// Checkpoints are where the plan has them, and then at the end too; and where the run is interrupted, unless a stop
/// has
/// cost a step its factor (Simulation::undo_stopped_step). One that is continued, with a simulation that was loaded,
/// goes on after the progress of that checkpoint.
RunResult run_scene(Simulation& simulation, const OutputPlan& plan, RunWatcher& watcher,
                    std::optional<std::uint64_t> most_steps = {}, const RunProgress* continued = nullptr);

}  // namespace dartboard
