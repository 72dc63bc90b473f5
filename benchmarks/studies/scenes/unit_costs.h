#pragma once
// Costs of the pieces of a step on this machine: measured in a fraction of a second, before a scene is built.

#include <span>
#include <vector>

#include "core/scene/plan/scene_plan.h"

namespace dartboard {

/// Nanoseconds of processor time. Those of a step are measured on arrays of the size and order of the scene's own, with
/// nothing of the simulator around; those of events and output on a body of some thousand cells of the same kind, and
/// assumed to grow with the number of cells, faces, vertices or springs.
struct UnitCosts {
  // a step
  double force = 0.0;  // one evaluation without damping, viscosity and fixed vertices
  double evaluations = 0.0;
  double damping = 0.0, element_damping = 0.0, viscosity = 0.0, fixed = 0.0, contact = 0.0;  // what each adds to a step
  double stages = 0.0;  // a step without these, but for its force evaluations
  double noise = 0.0;   // the most by which a step with a term took less than one without: less cannot be measured
  double solver = 0.0;  // a step of an implicit method, all in all, in place of the above
  double detector = 0.0, speed_check = 0.0;
  // after operations
  double look = 0.0;  // at the stable step, and for the restart of detector and integrator
  // events
  double stress = 0.0;                                              // of all vertices, once
  double by_place = 0.0;                                            // to ask each cell where it is
  double by_lot = 0.0;                                              // to draw among the cells
  double across = 0.0;                                              // to look for faces across a plane
  double dissociate = 0.0, remove = 0.0, tear = 0.0, refine = 0.0;  // one operation, embeddings and views with it
  // output
  double frame = 0.0, row = 0.0;
};

/// The times of steps with more and more terms, made to ascend: a time longer than that of a step with a term more is
/// lowered to it. The last, a step with all of them, stays.
///
/// returns the largest reduction
double make_ascending(std::span<double> ns);

/// The costs of a step from the times [ns] of one force evaluation, of a bare step with so many evaluations, and of
/// steps with one of the `terms` more each.
UnitCosts step_costs(double evaluations, std::vector<double> ns, std::span<double UnitCosts::*const> terms);

UnitCosts measure_unit_costs(const SceneFile& scene, const Problem& problem, const ScenePlan& plan);

/// Estimate the time of each item of the plan: a cost times how often, over the steps of the run.
///
/// Not included: writing files, building the body, and tearing by stress. Steps are those of the body's mean size.
void add_times(ScenePlan& plan, const SceneFile& scene, const UnitCosts& costs);

}  // namespace dartboard
