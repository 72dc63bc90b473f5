#pragma once
// A scene that runs: body, integrator and events, one step at a time.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/scene/body/contact_forecast.h"
#include "core/scene/body/diagnostics.h"
#include "core/scene/body/frame.h"
#include "core/scene/body/simulated_body.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/run/motion_watch.h"
#include "core/scene/run/probes.h"
#include "core/scene/run/run_end.h"
#include "core/scene/run/scene_contact.h"
#include "core/scene/run/step_guard.h"
#include "core/scene/timeline/timeline.h"
#include "core/time/method/integrator.h"
#include "core/time/system/coordinate_precision.h"
#include "core/time/watch/preflight.h"

namespace dartboard {

class Sleeping;

/// Events that are due at a step boundary happen before the state there is examined: at the start in the constructor,
/// then at the end of each step.
class Simulation {
 public:
  /// throws  InputError naming the path of the key for a scene that its mesh does not fit, that asks for an accuracy
  ///         and has not been given a step and an integrator, that refuses unstable steps and has too long a step, or
  ///         whose numbers are too large to move; IoError for a mesh that cannot be read
  explicit Simulation(const SceneFile& scene);
  /// For a problem that has been made already, which is not needed afterwards.
  ///
  /// pre  it is make_problem(scene)
  Simulation(const SceneFile& scene, const Problem& problem);
  ~Simulation();
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;

  /// Steps in all: the run is over at the first multiple of the step that is not before the duration.
  std::uint64_t step_count() const { return step_count_; }
  std::uint64_t steps_done() const { return done_; }
  double step() const { return step_; }  // [s]
  /// [s] steps_done() * step; after a divergence, of the state that the body has gone back to
  double time() const { return static_cast<double>(done_ - taken_back_) * step_ + taken_back_within_; }

  /// One step, then the events due at its end, then the velocities of driven vertices and the forces of the next.
  ///
  /// The motion has diverged where MotionWatch finds a fault, or a stress that an event asks for is not finite. The
  /// body then goes back to the state kept last: `taken_back` gives the number of steps. If another event of the same
  /// step has changed the body already, or the state at the start is not valid, there is no state to go back to. A step
  /// that the scene refuses (StepGuard) is not taken.
  /// throws  InputError naming the key of an event that cannot happen to the body as it is then; the simulation must not
  ///         be used any more
  std::optional<EarlyEnd> advance();
  /// The failure of the state at the start, which `advance` reports too: for a scene without steps.
  std::optional<Divergence> start_failure();

  /// The limits of the step, found at the start or after the last event: only a quick bound, if the step is stable by
  /// that bound.
  const StableStep& stable_step() const { return guard_.limits(); }
  /// Of each factor that its implicit steps will need, for the body as it is (Integrator).
  std::optional<FactorForecast> factor_forecast() const { return integrator_->factor_forecast(body_->system()); }
  /// The longest stable step [s] for the body as it is now, which warnings, refusals and divided steps use; see
  /// StableStep::limit.
  /// cost  a close estimate: a hundred force evaluations
  StepLimit step_limit() const { return guard_.limit(*body_, integrator_->scheme()); }
  /// The limit by what `stable_step` has: that step or, of a quick bound, a shorter one.
  /// cost  about a millisecond
  StepLimit step_limit_found() const { return guard_.limits().limit(integrator_->scheme(), guard_.horizon()); }
  /// The first step found to be too long, and how steps are divided since.
  const std::optional<StepWarning>& step_warning() const { return guard_.warning(); }
  /// Coordinates too far from the origin for the springs they belong to, found now.
  std::optional<CoordinatePrecision> find_coarse_coordinate() const;
  /// The same where the run ended.
  const std::optional<CoordinatePrecision>& coordinate_warning() const { return coarse_; }
  /// The checks before the first step.
  Preflight check_before_run() const;

  /// The facets that each event would have dissociated before anything happened, in the order of the scene; no value
  /// for one that is no cut.
  std::span<const std::optional<std::size_t>> facets_of_events() const { return facets_of_events_; }
  /// Before the first event.
  const CellCounts& counts_at_rest() const { return counts_at_rest_; }
  /// The contacts expected at the start, on which warnings and the division of steps depend.
  const ExpectedContacts& expected_contacts() const { return expected_contacts_; }

  /// The number of a vertex of the body in the file of the mesh; in a generated mesh the number of its point. Parts of
  /// one vertex share it. `no_point` for a vertex that refinement made.
  std::uint32_t file_number(std::uint32_t vertex) const;

  const SimulatedBody& body() const { return *body_; }
  /// The dimension of the cells: 3, 2 for a surface, 0 for a chain.
  int dimension() const { return dimension_; }
  std::size_t operations() const { return timeline_->operations(); }
  /// The warnings of its contacts; empty without contact.
  std::span<const ContactWarning> contact_warnings() const;
  /// The paths of the events that have been due and have never changed anything.
  std::vector<std::string> idle_events() const { return timeline_->idle_events(); }
  /// `largest_stress` is that of the body as it is now, where it is known.
  Diagnostics diagnostics(std::optional<double> largest_stress = {}) const;
  /// A frame with the fields that the scene asks for, or with others; its points in the order of the mesh's file.
  /// pre  displacement is asked for only if the scene does
  Frame frame() const { return frame(fields_); }
  Frame frame(const FrameFields& fields) const;
  ProbeRow probes() const;

  /// Measure momentum and energy before and after events from now on. This does not change the run.
  void watch_events(bool watch) { timeline_->watch_events(watch); }
  const EventJumps& jumps() const { return timeline_->jumps(); }
  const WorkCounters& work() const { return integrator_->work(); }
  /// The memory that the parts of the run take now.
  MemoryReport memory() const;

  /// Write all that the rest of the run depends on and that is not in the scene.
  void save(Archive& archive) const;
  /// Read it: the run goes on with the bits that it would have had.
  ///
  /// pre     it was saved by a simulation of the same scene, and this one has taken no step
  /// throws  IoError if it is not such a state; then this simulation must not be used
  void load(Archive& archive) { state(archive); }
  /// After `advance` has ended by Stopped (stop_request.h): can the step be taken again, and a state saved? No if the
  /// factor that it began with has been replaced or given up, or after an event within the step: then this must not be
  /// used any more.
  bool undo_stopped_step() { return !within_step_ && integrator_->undo_stopped_step(); }

 private:
  std::optional<EarlyEnd> take_step();
  SpringSystem stepped_system() const;
  Motion stepped_motion();
  void step_another_part();
  StepResult integrate(double from, double duration);
  StepResult integrate_part(double from, double duration);
  StepResult step_in_parts();
  double end_of_part(double now, double end) const;
  /// What has changed between two steps or parts: nothing, the motion, or which components are stepped.
  enum class Change { none, of_motion, of_what_is_stepped };
  Change go_on(bool operated, double now, double until);
  void state(Archive& archive);
  void examine_step();
  bool sums_work() const;
  void begin_work(double now);
  void add_work_of_forces(double now);
  void keep_sums();
  Fault of_body(Fault fault) const;
  Divergence diverged(const Fault& fault, bool goes_back = true);

  std::string file_;  // of the scene, for errors
  double step_;
  std::uint64_t step_count_, done_ = 0, taken_back_ = 0;
  double taken_back_within_ = 0.0;  // [s] that the state after those steps back is later
  std::unique_ptr<SimulatedBody> body_;
  std::unique_ptr<Integrator> integrator_;
  std::unique_ptr<Timeline> timeline_;
  std::unique_ptr<SceneContact> contact_;  // null without contact
  std::unique_ptr<Sleeping> sleeping_;     // null where nothing falls asleep
  StepGuard guard_;
  MotionWatch watch_;
  FrameFields fields_;
  bool exact_events_;
  bool within_step_ = false;  // after the first part of a step that is divided
  // [J] minus the work of forces that change in time up to the last change of them, and their potential there
  double applied_ = 0.0, potential_ = 0.0;
  double kept_applied_ = 0.0;  // [J] at the state that the body may go back to
  double work_from_ = 0.0;     // [s] when the work began that is added next
  std::optional<CoordinatePrecision> coarse_;
  int dimension_ = 0;
  ExpectedContacts expected_contacts_;
  CellCounts counts_at_rest_;
  std::vector<std::optional<std::size_t>> facets_of_events_;
  std::vector<std::uint32_t> file_number_;   // of each point of the mesh; empty where it is the point's own
  std::vector<std::uint32_t> body_of_cell_;  // by cell of the mesh, then by link; empty for one body
};

}  // namespace dartboard
