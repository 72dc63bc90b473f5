#pragma once
// The reference motion of a scene by codes that contain no integrator of ours, whatever time they take.

#include "validation/scenes/scene_reference.h"

namespace dartboard {

/// Odeint's method of order 8 in extended precision, and CVODE (without SUNDIALS: Odeint's extrapolation), in two
/// threads at the same time. Steps and tolerances are made finer once if the two do not agree to `accepted` edges and
/// finer ones could change that.
///
/// The states are Odeint's. The floor is ten times the distance between the two; for a chaotic motion that is large.
/// pre  the scene is not beyond the references
SceneReference reference_by_other_codes(const TradeoffScene& scene, double accepted);

}  // namespace dartboard
