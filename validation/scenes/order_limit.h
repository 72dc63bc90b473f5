#pragma once
// The order that contact and loads leave to any integrator.

#include <algorithm>
#include <limits>
#include <string>

#include "core/scene/file/scene_file.h"
#include "core/time/method/scheme.h"
#include "validation/scenes/tradeoff_scenes.h"

namespace dartboard {

/// The highest order of errors in a scene, and what limits it.
struct OrderLimit {
  double most = std::numeric_limits<double>::infinity();  // 0: none is promised
  std::string because;                                    // "an energy of exponent 3"; empty without a limit

  bool late_loads = false;  // forces over time, which a method of several steps takes half a step late

  bool is_promised() const { return most > 0.0; }
  /// The order to be expected of a method.
  double of(const Scheme& scheme) const {
    const double order = late_loads && !scheme.one_step ? 1.0 : scheme.order;
    return std::min(order, most);
  }
};

/// Steps do not end where samples come and go, and the forces are not smooth there:
///
///     energy ~ d^p           order p            the derivative of order p jumps
///     speed that is lost     order p/2          the damping ~ d^(p/2 - 1) does so
///     moving obstacles       order 2            they rest half way through a step
///     forces over time       order 2            they are their mean during a step; methods of several steps: order 1
///     drives over time       order 2            vertices go straight during a step
///     friction               order 1            it is constant during a step
///     blocks, bodies         none               the depth has kinks where the nearest face changes
OrderLimit order_limit(const SceneFile& file);
/// No limit for a scene that is not from a file.
OrderLimit order_limit(const TradeoffScene& scene);

}  // namespace dartboard
