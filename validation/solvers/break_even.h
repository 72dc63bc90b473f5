#pragma once
// The break-even law: the cost of a run with an explicit and with an implicit method, from the costs of its parts.

#include <limits>

#include "core/time/method/integrator.h"
#include "validation/scenes/scene_features.h"

namespace dartboard {

/// Seconds of the parts of steps on one machine, for one system.
struct StepPrices {
  double force = 0.0;          // evaluation of the forces
  double linearisation = 0.0;  // tangents of the springs and the matrix made of them
  double factorisation = 0.0;  // its entries and its Cholesky factor, analysed before
  double solve = 0.0;          // with the factor, and a product with the matrix: an iteration with a kept factor
};

/// Measured on the scene at its start, for steps of h [s]: the least of five of each.
StepPrices step_prices(const TradeoffScene& scene, double h, const CpuClock& clock);

/// The work of an implicit run, from the counters of a shorter one.
struct ImplicitWork {
  double forces = 0.0, linearisations = 0.0, solves = 0.0;  // in a step
  double factorisations = 1.0;                              // in the run: a kept factor lasts, however short the steps
};
ImplicitWork implicit_work(const WorkCounters& work);

/// Steps that a method of that order needs for a motion of that rate and size: the local error of a turn, over all
/// turns. Crude: it uses the motion at the start only.
double steps_for_error(const SceneFeatures& features, int order, double duration, double error);

/// Steps of an explicit method that stability requires: duration / (0.9 limit), with `limit` [s] as of
/// `stability_limit`, z_lim / omega_max.
double steps_for_stability(double duration, double limit);

/// N (f t_force + l t_linearisation + s t_solve) + q t_factorisation.
double implicit_seconds(double steps, const ImplicitWork& work, const StepPrices& prices);

/// The law solved for T omega_max: from there on an explicit method, limited by stability, takes longer than
/// `implicit_s` seconds; `steps_for_stability` with limit = z_lim / omega_max.
double break_even_phase(double imaginary_limit, double step_s, double implicit_s);

}  // namespace dartboard
