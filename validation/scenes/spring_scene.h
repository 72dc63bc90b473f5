#pragma once
// The scenes of the studies in time: a body and its events, run by any integrator, and as plain lists for the oracle.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/mechanics/mass_spring_body.h"
#include "core/time/method/integrator.h"
#include "core/views/spring_ends.h"
#include "reference/ode_codes.h"

namespace dartboard {

using TetBody = MassSpringBody<TetMap, Held::by_every_dart>;

/// Faces come apart at a time, at 0 before the motion starts. They are found once, in the body at rest: the same faces
/// in every run, however wrong its positions are by then.
struct TimedCut {
  double time;  // [s]
  std::function<std::vector<Dart>(const TetBody& at_rest)> faces;
};
/// All faces between cells on different sides of a plane (`faces_on_plane`).
TimedCut plane_cut(double time, const Eigen::Vector3d& point, const Eigen::Vector3d& normal);
/// The fan of the lowest dart at a mesh point (`fan`).
TimedCut fan_tear(double time, std::uint32_t point);

/// A scene of a study in time. In contrast to a `SceneFile`, its faces come from a function of the body at rest, and it
/// starts from any positions.
struct SpringScene {
  std::string name;
  Problem problem;                                  // at rest in its mesh; tetrahedra; `h` is not used
  std::vector<Eigen::Vector3d> initial_position{};  // [m] by mesh point; empty for rest
  std::vector<TimedCut> events{};                   // ascending in time
  double duration = 1.0;                            // [s]
  std::size_t checkpoints = 8;                      // at equal distances, the last at the end
};

/// A scene made ready to be run many times: the body before the start, the faces of each event, and the same motion as
/// plain lists for the oracle.
struct PreparedScene {
  std::string name;
  TetBody body;
  std::vector<std::vector<Dart>> faces;  // by event
  reference::NetworkMotion motion;
  double duration;
  double fastest_rate;  // [1/s] the largest of reference::fastest_rate over the networks, at rest
};

/// Build the body and take it apart once, at rest, to know the network of each interval.
///
/// The networks come from the cells that remain (RemainingCells, which has no darts) by reference/rebuild; parallel
/// springs are one there, with the sum of their stiffnesses. Only the numbers of the vertices come from the body.
/// throws  InputError as build_body; if an event is not within the duration, or finds no face; and if the vertices of
///         the body are not those of the cells that remain
PreparedScene prepare(const SpringScene& scene);

/// The mechanics of a body as the time loop sees it; valid until the body changes.
SpringSystem system_of(const TetBody& body, const SpringEndsView& ends);

enum class EventTiming {
  split_step,   // steps end at every event: the steps of an interval are equal, and at most h
  end_of_step,  // all steps are h, and an event takes place at the end of the first step that reaches it
};

struct SceneRun {
  std::vector<PointState> states;  // at the checkpoints reached, by vertex number
  WorkCounters work;
  StepResult result;  // of the last step
  double h = 0.0;     // [s] duration / steps; 0 where the integrator chose
};

/// Run a scene in `steps` steps, more where steps are split; the integrator is restarted at the start and after every
/// event.
///
/// Checkpoints show the state before an event of the same time. A run ends with the first step that is not ok.
/// throws  InputError without a step, or for `end_of_step` unless steps is a multiple of the number of checkpoints
SceneRun run_scene(const PreparedScene& scene, Integrator& integrator, std::uint64_t steps,
                   EventTiming timing = EventTiming::split_step);

/// The same in steps that the integrator chooses; they end at the events and checkpoints.
SceneRun run_scene(const PreparedScene& scene, AdaptiveIntegrator& integrator, const Tolerance& tolerance);

}  // namespace dartboard
