#pragma once
// Timed runs of a scene or of its first part, with equal steps or with a tolerance.

#include <cstdint>
#include <functional>
#include <limits>
#include <optional>
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
  /// At the start.
  /// pre  the scene outlives the stage
  explicit SceneStage(const TradeoffScene& scene);

  SpringSystem system() const;
  Motion motion();
  PointState state() const;
  /// The state at the end of a step, with the velocities that driven vertices have at that time [s].
  PointState state_at(double time);
  /// The next event takes place. All that was computed from the system before has to be renewed.
  void pass_event();
  /// As FrozenBody::load.
  bool load(Integrator& integrator, double time, double h) { return frozen_ && frozen_->load(integrator, time, h); }
  /// One step of h [s] from `time`.
  /// pre  `system` is that of the stage now
  StepResult step(Integrator& integrator, const SpringSystem& system, double time, double h) {
    return frozen_ ? frozen_->step(integrator, system, time, h) : integrator.step(system, motion(), h);
  }
  /// [J] Work that moving obstacles have done on the body since the last call.
  double new_contact_work() { return frozen_ ? frozen_->new_contact_work() : 0.0; }
  /// The limits of the step now.
  StableStep limits();

 private:
  std::optional<FrozenBody> frozen_;  // one of the two
  SpringColumns columns_;
};

/// A clock that stands still, for runs that are not timed.
inline std::int64_t no_clock() { return 0; }

enum class EventTiming {
  split_step,   // as a simulation with exact event times: steps that an event is within are divided there
  end_of_step,  // all steps are h, and an event takes place at the end of the first step that reaches it
};

/// The steps of a run: equal ones or, for an AdaptiveIntegrator, those within a tolerance.
struct RunSetting {
  std::uint64_t steps = 0;  // over the whole duration; those that end at events or checkpoints are divided
  double tolerance = 0.0;   // [edges] per step, when steps is 0
  std::uint64_t parts = 1;  // of each step: with twice as many, every interval has exactly twice as many steps
  EventTiming timing = EventTiming::split_step;  // end_of_step only with steps, a multiple of the checkpoints
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

/// Run a scene from its start. The integrator is restarted there and after every event. Checkpoints show the state
/// before an event of the same time. A run ends with the first step that is not ok. The steps and the events are timed;
/// the making of the body before them is not.
///
/// throws  InputError for a tolerance with an integrator that cannot choose its steps, or where steps have to be equal;
///         for a setting without steps and tolerance; and for `end_of_step` with other numbers of steps
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
