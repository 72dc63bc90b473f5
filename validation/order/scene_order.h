#pragma once
// The orders that integrators show on a user's scene, compared with the reference that there is for it.

#include "validation/order/convergence_order.h"
#include "validation/scenes/order_limit.h"
#include "validation/scenes/scene_reference.h"

namespace dartboard {

enum class OrderAnswer : std::uint8_t {
  shown,   // three successive halvings show the order of the scheme, in x or in v, and no lower one in the other
  missed,  // they show a lower one, with steps so short that this is the method's
  open     // neither: a motion need not allow an answer
};

struct SceneOrder {
  OrderStudy study;  // of no case; the reason says why the order is missed, or the answer open
  OrderAnswer answer = OrderAnswer::open;
};

struct SceneOrderOptions {
  OrderOptions order{};        // but for numbers of steps
  double first_h_omega = 5.6;  // of the longest steps: slow motions are accurate long before all that is fast is
  double most_s = 10.0;        // [s] of processor time that a run may take
  int most_halvings = 16;
};

/// The answer of runs that are judged (`judge`) on a scene with contact: there the error of each run depends on where
/// in its steps samples come and go, so that orders of single halvings scatter.
///
/// A line is fitted to the last successive errors in the window, five at least. An order is shown where it falls with
/// that of the study (`theory`) less 0.3, or faster; missed where it is lower by two standard errors more, and steps
/// are short. Where contact promises none, the answer is open, with the orders.
SceneOrder answer_by_fit(OrderStudy judged, const OrderLimit& limit, const OrderOptions& options);

/// Halve the steps in every interval between events and checkpoints, until the order of the method has shown itself,
/// the errors reach the floor, or the next run would take too long. No run is made where the reference resolves no
/// error in the window.
///
/// The floor of positions is the larger of the reference's and of what rounding leaves of the method. That of
/// velocities assumes that the positions are off in oscillations of the fastest rate.
SceneOrder observe_order(const TradeoffScene& scene, const SceneReference& reference, const IntegratorEntry& entry,
                         const CpuClock& clock, const SceneOrderOptions& options = {});

/// The answer of runs that are judged (`judge`), with its reason: the part of `observe_order` that does not simulate.
///
/// An order is missed where the last three in the window agree and are half an order below that of the scheme, for
/// steps of h omega of 1/4 and less, and for errors that the equations solved in all steps cannot leave. A higher order
/// leaves it open: from rest, for instance, a term of the error may be missing.
SceneOrder answer_of(OrderStudy judged, const OrderOptions& options);

}  // namespace dartboard
