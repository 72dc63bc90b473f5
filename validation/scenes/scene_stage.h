#pragma once
// Timed runs of a scene or of its first part, with equal steps or with a tolerance.

#include <cstdint>
#include <functional>
#include <limits>
#include <span>
#include <vector>

#include "core/time/method/integrator.h"
#include "core/time/system/accelerations.h"
#include "validation/scenes/spring_columns.h"
#include "validation/scenes/tradeoff_scenes.h"

namespace dartboard {

/// Processor time of this thread [ns], or its substitute in a test.
using CpuClock = std::function<std::int64_t()>;

/// A scene at some moment of a run: what the time loop needs, and the way to the next moment.
class SceneStage {
 public:
  /// At the start.   pre  the scene outlives the stage
  explicit SceneStage(const TradeoffScene& scene);

  SpringSystem system() const;
  Motion motion();
  PointState state() const;
  /// The next event takes place. All that was computed from the system before has to be renewed.
  void pass_event();
  /// One step of h [s] from `time`.   pre  `system` is that of the stage now
  StepResult step(Integrator& integrator, const SpringSystem& system, double time, double h) {
    return frozen_ ? frozen_->step(integrator, system, time, h) : integrator.step(system, motion(), h);
  }
  /// The limits of the step now.
  StableStep limits();

 private:
  const TradeoffScene* scene_;
  std::size_t next_event_ = 0;
  std::optional<FrozenBody> frozen_;  // one of the three
  std::optional<TetBody> body_;
  SpringEndsView ends_;
  SpringColumns columns_;
};

/// The steps of a run: equal ones or, for an AdaptiveIntegrator, those within a tolerance.
struct RunSetting {
  std::uint64_t steps = 0;  // over the whole duration; steps end at events and checkpoints, so there may be more
  double tolerance = 0.0;   // [edges] per step, when steps is 0
};

struct RunLimits {
  std::size_t checkpoints = std::numeric_limits<std::size_t>::max();  // stop after this many
  std::int64_t cpu_ns = std::numeric_limits<std::int64_t>::max();     // give up after this time
};

struct TimedRun {
  std::vector<PointState> states;  // at the checkpoints reached
  WorkCounters work;
  StepResult result;  // of the last step
  double h = 0.0;     // [s] duration / steps; with a tolerance, the mean over the steps taken
  std::int64_t cpu_ns = 0;
};

/// Run a scene from its start. The steps and the events are timed; the copy of the body before them is not.
///
/// throws  InputError for a tolerance with an integrator that cannot choose its steps, or with contact; and for a
///         setting without steps and tolerance
TimedRun run_timed(const TradeoffScene& scene, Integrator& integrator, const RunSetting& setting, const CpuClock& clock,
                   const RunLimits& limits = {});

/// Processor time [ns] of one evaluation of the forces of a scene at its start: the mean of a batch of about
/// `batch_ns`.
class ForceTimer {
 public:
  ForceTimer(const TradeoffScene& scene, CpuClock clock, std::int64_t batch_ns = 2'000'000);
  double measure();

 private:
  SceneStage stage_;
  CpuClock clock_;
  Terms terms_;
  std::vector<Eigen::Vector3d> a_;
  std::uint64_t batch_ = 1;
};

}  // namespace dartboard
