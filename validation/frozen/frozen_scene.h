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
#include "core/scene/run/applied_forces.h"
#include "core/scene/run/driven_vertices.h"
#include "core/scene/run/scene_contact.h"
#include "core/time/method/step_limit.h"

namespace dartboard {

/// What changes at one time: the cells of events, the velocities of driven vertices, the forces applied.
struct FrozenChange {
  struct Operation {
    std::size_t event;  // its place in the scene's list
    EventTargets targets;
  };
  double time = 0.0;                    // [s]
  std::vector<Operation> operations{};  // none where only velocities or forces change
};

/// A scene that runs alike by any method and step.
struct FrozenScene {
  SceneFile file;  // with the events that take part, and without output
  Problem problem;
  BodyNeeds needs;
  std::vector<FrozenChange> changes;   // ascending in time; those at 0 come before the motion
  double contact_share = 0.0;          // of the depth of their laws, of contacts to come
  std::vector<std::string> omissions;  // what is left out, and what an accurate run has chosen, in sentences
};

/// Events take place at their exact times. What they operate on is found in one run: where it depends on positions, an
/// accurate one up to the last such event, of Dormand's and Prince's method with a tolerance of 1e-8 edges in each
/// step, or in steps of 1/4 of 1/omega_max where there is contact. An event that looks at the body in every step does
/// so at the steps of the scene in that run.
///
/// throws  InputError "/events/3/...: ..." as SimulatedBody::make_ready, DrivenVertices and AppliedForces; SolverError
///         if the motion up to an event cannot be found
FrozenScene freeze(const SceneFile& file, const Problem& problem);

/// The body of a frozen scene, moved by the integrator of a run, and changed as the scene says.
class FrozenBody {
 public:
  /// After the changes at time 0.   pre  the scene outlives it
  explicit FrozenBody(const FrozenScene& scene);

  SimulatedBody& body() { return *body_; }
  const SimulatedBody& body() const { return *body_; }
  /// The next change takes place. Integrators have to be restarted.
  void pass();

  /// What contact does before and after a step of h [s] from `time` (SceneContact); true where the integrator has to be
  /// restarted. Nothing without contact.
  bool begin_step(double time, double h) {
    return contact_ && contact_->begin(time, h, body_->system(), body_->motion());
  }
  bool end_step(double time, double h) { return contact_ && contact_->end(time, h, body_->system(), body_->motion()); }

  /// What limits the step where the body is now, and with contacts as deep as is expected.
  ///
  /// cost  a hundred force evaluations
  StableStep limits() const;
  /// [1/s] At most so fast its state changes there: its highest frequency, or its fastest decay. The same cost.
  double fastest_rate() const;

 private:
  friend class Scout;
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
