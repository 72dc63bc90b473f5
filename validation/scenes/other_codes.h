#pragma once
// Where a scene really goes, by codes of which no integrator is part, however long it takes them.

#include "validation/scenes/scene_reference.h"

namespace dartboard {

/// Odeint's method of order 8 in extended precision, and CVODE (without SUNDIALS: Odeint's extrapolation), at the same
/// time in two threads, with steps and tolerances made finer once if they do not agree to `accepted` edges and that
/// could mend it.
///
/// The states are Odeint's. The floor is ten times the distance between the two; of a chaotic motion that is large.
/// pre  the scene is not beyond the references
SceneReference reference_by_other_codes(const TradeoffScene& scene, double accepted);

}  // namespace dartboard
