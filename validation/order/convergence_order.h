#pragma once
// The order of convergence that an integrator shows, halving by halving, compared with that of its scheme.

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/time/integrators.h"
#include "reference/error_norms.h"
#include "reference/ode_oracle.h"
#include "validation/scenes/order_scenes.h"
#include "validation/scenes/tradeoff_scenes.h"

namespace dartboard {

/// The stage of an error on its way to zero.
enum class Regime : std::uint8_t {
  failed,          // the run ended with a diagnosis
  large,           // above the window, or NaN
  pre_asymptotic,  // not yet of the order of the method
  asymptotic,
  floor,  // below the resolution of the reference, or the rounding of the method
};
std::string_view name(Regime regime);

/// One run, and the change of its error since the previous one.
struct OrderPoint {
  std::uint64_t steps = 0;
  double h_omega = 0.0;
  reference::MotionErrors errors;
  double p_x = 0.0, p_v = 0.0;  // log2 of the ratio of errors; over two halvings, half of it, across an unaligned cut
  bool has_order = false;       // there was a run to compare with
  Regime regime = Regime::failed;
  std::string diagnosis;  // of a run that ended early
};

struct OrderStudy {
  std::string integrator;
  OrderCase which = OrderCase::undamped;
  double theory = 1;  // the expected order
  std::vector<OrderPoint> points;
  bool holds = false;           // three successive orders, in x and in v, within the tolerance of the theory
  double p_x = 0.0, p_v = 0.0;  // of those three, the ones farthest from theory; else of the last ones in the window
  std::string reason;           // why it does not hold
};

struct OrderOptions {
  double tolerance = 0.1;           // of observed orders
  int successive = 3;               // orders that must be within it
  double most_error = 1e-2;         // of x in edges, and of v: the window's upper end; its lower end is 10 floors
  double velocity_floor = 1.0;      // of relative velocities, over that of positions in edges
  double solved_to = 0.0;           // of the speed: what the equations of an implicit step may leave
  std::uint64_t fewest_steps = 24;  // h omega_max = 0.7
  std::uint64_t most_steps = 24 << 12;
  std::uint64_t most_implicit_steps = 24 << 10;
};

/// A scene of the study with its certified reference.
struct OrderStage {
  OrderCase which;
  TradeoffScene scene;
  reference::CertifiedMotion certified;
};
OrderStage order_stage(OrderCase which);

/// Halve the step, from `fewest_steps` on, until the order of the method has shown itself or the errors reach the
/// floor.
///
/// Across an unaligned cut order 1 is expected of all. A cut at 7/18 of 24 * 2^k steps falls 2/3 and 1/3 of a step
/// short of a step's end in turn, so there orders are taken over two halvings.
OrderStudy study_order(const OrderStage& stage, const IntegratorEntry& entry, const OrderOptions& options = {});

/// Mark the regimes of runs whose errors are known and find the first `successive` orders within the tolerance:
/// the part of `study_order` that does not simulate. `floor` is that of the reference, in edges and,
/// times `velocity_floor`, relative to the largest velocity.
void judge(OrderStudy& study, double floor, const OrderOptions& options);

}  // namespace dartboard
