#pragma once
// The order that contact leaves to any integrator.

#include <limits>
#include <string>

#include "core/scene/file/scene_file.h"
#include "validation/scenes/tradeoff_scenes.h"

namespace dartboard {

/// The highest order of errors through the contacts of a scene, and what limits it.
struct ContactOrder {
  double most = std::numeric_limits<double>::infinity();  // 0: none is promised
  std::string because;                                    // "an energy of exponent 3"; empty without contact

  bool is_promised() const { return most > 0.0; }
};

/// Steps do not end where samples come and go, and the forces are not smooth there:
///
///     energy ~ d^p           order p            the derivative of order p jumps
///     speed that is lost     order p/2          the damping ~ d^(p/2 - 1) does so
///     moving obstacles       order 2            they rest half way through a step
///     friction               order 1            it is constant during a step
///     blocks, bodies         none               the depth has kinks where the nearest face changes
ContactOrder contact_order(const SceneFile& file);
/// No limit for a scene that is not from a file.
ContactOrder contact_order(const TradeoffScene& scene);

}  // namespace dartboard
