#pragma once
// All that is scheduled in a scene, on the steps of a run: events, driven vertices, applied forces.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/scene/body/simulated_body.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/timeline/applied_forces.h"
#include "core/scene/timeline/driven_vertices.h"
#include "core/scene/timeline/event_clock.h"
#include "core/scene/timeline/event_jumps.h"
#include "core/time/method/integrator.h"

namespace dartboard {

/// Changes the body at step boundaries, or between them, and restarts the integrator after each change.
class Timeline {
 public:
  /// The drives and forces of a scene; its events are added by `schedule`. Body and integrator must outlive it.
  ///
  /// throws  InputError as DrivenVertices and AppliedForces
  Timeline(const SceneFile& scene, const Mesh& mesh, SimulatedBody& body, Integrator& integrator, double step);

  /// Make an event ready.
  ///
  /// returns for a cut: the facets that it would dissociate now
  /// throws  InputError as SimulatedBody::make_ready
  std::optional<std::size_t> schedule(const SceneEvent& event);

  /// Apply the events that are due after n steps, by their times; of one time in the order of the list.
  ///
  /// throws  StressError; the events before count
  void happen(std::uint64_t n);
  /// [s] The first time in a step, between these two, at which an event is due or a load begins, turns back or ends.
  /// pre  the events before have been applied
  std::optional<double> next_between(double begin, double end) const;
  /// Apply the events between two boundaries that are due until then.
  void happen_until(double time);
  /// Set the velocities of driven vertices and the forces to their means from one time to another [s].
  LoadChange drive(double begin, double end);

  bool has_forces() const { return forces_.size() > 0; }
  bool sums_work() const { return forces_.sum_work(); }
  /// Is this a point of the mesh that some drive moves?
  bool moves(std::uint32_t point) const { return driven_.moves(point); }
  std::size_t operations() const { return operations_; }
  /// The paths of the events that have been due and have never changed anything.
  std::vector<std::string> idle_events() const;
  /// Measure momentum and energy before and after events from now on.
  void watch_events(bool watch) { watch_ = watch; }
  const EventJumps& jumps() const { return jumps_; }
  std::size_t driven_bytes() const { return driven_.bytes(); }
  /// The memory of forces and events.
  MemoryReport memory() const;

  /// Writes or reads what has happened; the times are in the scene.
  void state(Archive& archive);
  /// As EventClock::extend, after a state has been read.
  void extend();

 private:
  struct Scheduled {
    std::unique_ptr<ReadyEvent> event;
    EventClock clock;
    bool dissociates;  // it dissociates and does nothing else
    std::string path;
    bool was_due = false;
    std::size_t operations = 0;
  };
  void apply(Scheduled& scheduled);

  SimulatedBody& body_;
  Integrator& integrator_;
  double step_;
  DrivenVertices driven_;
  AppliedForces forces_;
  std::vector<Scheduled> events_;
  std::size_t operations_ = 0;
  bool watch_ = false;
  EventJumps jumps_;
};

}  // namespace dartboard
