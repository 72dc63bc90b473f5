#pragma once
// The loop of a simulation from start to end, observed by a watcher.

#include <functional>
#include <optional>

#include "core/scene/run/run_progress.h"
#include "core/scene/run/simulation.h"

namespace dartboard {

/// The receiver of what a run hands out. It cannot change the motion.
class RunWatcher {
 public:
  virtual ~RunWatcher() = default;
  virtual void frame(const Frame&) {}
  /// Where not, no frame is made.
  virtual bool takes_frames() const { return true; }
  virtual void diagnostics(const Diagnostics&) {}
  virtual void probes(const ProbeRow&) {}
  /// A state that the run can be continued from: the output until then is that of an uninterrupted run until
  /// then.
  virtual void checkpoint(const Simulation&, const RunProgress&) {}
  virtual void stepped(const Simulation&) {}
  /// Must the run end here? Called after every step.
  virtual bool interrupts() { return false; }
};

struct RunResult {
  std::optional<Divergence> divergence;  // at most one of these two has a value
  std::optional<StepRefusal> refusal;
  bool interrupted = false;

  bool ended_early() const { return divergence || refusal; }
  Diagnostics first, last;  // of those handed out; after a divergence the last is of the kept state
  // largest change of the total energy in any of them, over the largest sum of kinetic and elastic energy
  double energy_drift = 0.0;
};

/// The mass lost beyond what removals took, relative to the mass at the start; 0 without mass at the start.
double mass_unaccounted_for(double start, double removed, double end);

/// Run to the end, to `most_steps`, until the watcher interrupts it or a StopRequest (stop_request.h) a step, or until
/// the motion diverges. The first state is always handed out, and the last; after a divergence the last good one.
///
/// Checkpoints are written where the plan has them, and then at the end too; also where the run is interrupted,
/// unless the stop lost the factor that a step began with
/// (Simulation::undo_stopped_step). A continued run, with a simulation that was loaded, goes on after the progress of
/// its checkpoint.
RunResult run_scene(Simulation& simulation, const OutputPlan& plan, RunWatcher& watcher,
                    std::optional<std::uint64_t> most_steps = {}, const RunProgress* continued = nullptr);

}  // namespace dartboard
