#pragma once
// Scenes whose events operate on the same cells in every run, whatever the method that moves the body.

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "core/plain/problem.h"
#include "core/scene/body/needs.h"
#include "core/scene/body/simulated_body.h"
#include "core/scene/file/scene_file.h"
#include "core/scene/run/scene_contact.h"
#include "core/scene/timeline/applied_forces.h"
#include "core/scene/timeline/driven_vertices.h"
#include "core/time/method/step_limit.h"

namespace dartboard {

/// Does a load of the scene change in time, so that it is another one in every step?
bool changes_in_every_step(const SceneFile& file);
/// Does an event operate on what is somewhere, or is stressed, at its time, or happen at every step? Then the run
/// decides what it operates on.
bool is_left_to_the_run(const SceneEvent& event);

/// The changes at one time: the cells of events, the velocities of driven vertices, the forces applied.
struct FrozenChange {
  struct Operation {
    std::size_t event;  // its place in the scene's list
    EventTargets targets;
    std::size_t made = 0;  // operations
  };
  double time = 0.0;                    // [s]
  std::vector<Operation> operations{};  // empty where only velocities or forces change
};

/// A scene that changes alike for every method and step.
struct FrozenScene {
  SceneFile file;  // with the events that take part, without the points of faces, and without output
  Problem problem;
  std::vector<Eigen::Vector3d> initial_position{};  // [m] by mesh point; empty for rest
  BodyNeeds needs;
  std::vector<FrozenChange> changes;   // ascending in time; those at 0 come before the motion
  double edge = 1.0;                   // [m] mean_edge of the mesh
  double contact_share = 0.0;          // the predicted depth of contacts, as a share of that of their laws
  std::vector<std::string> omissions;  // what is left out, and what an accurate run has chosen, in sentences
};

/// Freeze the events: they take place at their exact times, and one run finds the cells that they operate on. Where
/// these depend on positions, it is an accurate run up to the last such event: the method of Dormand and Prince with a
/// tolerance of 1e-8 edges in each step, or steps of 1/4 of 1/omega_max where there is contact or a load changes in
/// time. An event that looks at
/// the body in every step does so at the steps of the scene in that run.
///
/// throws  InputError "/events/3/...: ..." as SimulatedBody::make_ready, DrivenVertices and AppliedForces; SolverError
///         if the motion up to an event cannot be found
FrozenScene freeze(const SceneFile& file, const Problem& problem);
/// Freezes a body that starts from other positions than those of its mesh, where it is at rest: [m] by mesh point,
/// or empty. Its events look up what they refer to in the body at rest.
///
/// throws  also InputError for positions that are not as many as the points
FrozenScene freeze(const SceneFile& file, const Problem& problem, std::vector<Eigen::Vector3d> initial_position);

/// The body of a frozen scene, moved by the integrator of a run, and changed as the scene says.
class FrozenBody {
 public:
  /// The body after the changes at time 0.
  /// pre  the scene outlives it
  explicit FrozenBody(const FrozenScene& scene);

  SimulatedBody& body() { return *body_; }
  const SimulatedBody& body() const { return *body_; }
  /// The next change takes place. Integrators have to be restarted.
  void pass();

  /// Loads that change in time take their means over the step of h [s] from `time`; returns whether any has changed.
  /// `step` does so too.
  bool load(Integrator& integrator, double time, double h);
  /// The velocities of vertices on a path or a turn at a time [s], into those of a state: in the body they are means
  /// over a step.
  void show_drives(double time, std::span<Eigen::Vector3d> velocity);

  /// One step of h [s] from `time`, with what contact does before and after it (SceneContact).
  ///
  /// pre  `system` is that of the body
  StepResult step(Integrator& integrator, const SpringSystem& system, double time, double h);
  /// [J] Work that moving obstacles have done on the body since the last call.
  double new_contact_work() { return contact_ ? contact_->new_work() : 0.0; }

  /// The limits of the step at the present positions, with contacts as deep as predicted.
  ///
  /// cost  a hundred force evaluations
  StableStep limits() const;
  /// [1/s] An upper bound of its rates of change there: of frequencies and of decays. The same cost.
  double fastest_rate() const;

 private:
  class Scout;
  friend FrozenScene freeze(const SceneFile& file, const Problem& problem,
                            std::vector<Eigen::Vector3d> initial_position);
  bool drive(double time);
  void look_at_contact();

  const FrozenScene& scene_;
  std::unique_ptr<SimulatedBody> body_;
  std::vector<std::unique_ptr<ReadyEvent>> events_;
  DrivenVertices driven_;
  AppliedForces forces_;
  std::unique_ptr<SceneContact> contact_;  // null without contact
  std::size_t next_ = 0;
};

}  // namespace dartboard
