#pragma once
// Removal in a surface: isolate the face first, so that mass and stiffness are shared out, then delete it.

#include "core/operations/topology_change.h"
#include "core/topology/generalized_map.h"

namespace dartboard {

/// Dissociate every edge of the face of `d`, then delete its darts.
///
/// The neighbours keep the cells they shared with it. Removed cells are reported by dead darts, one for each vertex and
/// edge of the isolated face and one for the face: labels kept by slot can still be read there until a slot is reused.
/// The edges that it shared are then 2-free: they have joined the boundary.
///
/// throws  TopologyError if d is dead; the map is unchanged then
/// cost    that of dissociating its edges
/// source  section 3.2, for a surface
TopologyChange remove_face(Map2& map, Dart d);

}  // namespace dartboard
