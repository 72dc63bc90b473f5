#pragma once
// Removal as the paper does it: isolate the volume first, so that mass and stiffness are shared out, then delete it.

#include "core/operations/topology_change.h"
#include "core/topology/generalized_map.h"

namespace dartboard {

/// Dissociate every face of the volume of `d`, then delete its darts.
///
/// The neighbours keep the cells they shared with it. Removed cells are reported by dead darts, one for each vertex,
/// edge and face of the isolated volume and one for the volume: labels kept by slot can still be read there until a
/// slot is reused. The faces that it shared are then 3-free: they have joined the boundary.
///
/// throws  TopologyError if d is dead; the map is unchanged then
/// cost    that of dissociating its faces
/// source  section 3.2
template <class Map>
TopologyChange remove_volume(Map& map, Dart d);

extern template TopologyChange remove_volume(Map3&, Dart);
extern template TopologyChange remove_volume(TetMap&, Dart);

}  // namespace dartboard
