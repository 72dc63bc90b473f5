#pragma once
// The error of a position that is left by rounding, however short the steps.

#include "core/time/method/scheme.h"
#include "validation/scenes/tradeoff_scenes.h"

namespace dartboard {

/// The error [edges] that rounding adds up to: `factor` h^-`power` with steps of h [s], over the whole duration.
struct RoundingFloor {
  double factor = 0.0, power = 0.5;
  double at(double h) const;
};

/// A random walk of the roundings of positions: 1.5 * 2^-53 X sqrt(u n) after n steps, u the number of times that a
/// step rounds positions (once; in every stage of a splitting method), X the root mean square of the coordinates over
/// mass, plus the path of the centre of mass.
///
/// One rounding is off by 0.3 to 0.6 of 2^-53 of the coordinate, with the root mean square over its binade. Runs in
/// ever shorter steps, against compensated ones, show 0.2 to 0.6 of 2^-53 X sqrt(u n) on undamped bodies and 1.0 to 1.3
/// on a damped one, which is swept over for the damping too. Implicit methods are off by no more (`extremes --axis
/// offset`: up to 10 eps D, Verlet 9.6). Compensated methods keep the parts that are rounded off: 1 to 2 of 2^-53 X
/// however many steps; 4 are counted. The growth of disturbances in a motion is not included.
RoundingFloor rounding_floor(const TradeoffScene& scene, const Scheme& scheme);

}  // namespace dartboard
