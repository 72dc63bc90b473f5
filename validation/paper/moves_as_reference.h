#pragma once
// The motion of a body on a map, compared with the same steps in extended precision by independent code.

#include "core/plain/mesh.h"

namespace dartboard {

/// The allowed deviation of a state in spreads of rounding: a program rounds some ten times in a step, the spread once.
inline constexpr double spreads_allowed = 10.0;

/// The distance of the state after a hundred steps under gravity, the lowest point held, over cell arrays of a body on
/// a map, from the reference's: over `spreads_allowed` spreads, so that more than 1 is too much. Positions and
/// velocities alike.
/// pre  the mesh is not empty
double motion_beside_reference(const Mesh& mesh);

}  // namespace dartboard
