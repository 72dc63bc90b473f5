#pragma once
// The removal of a whole connected component.

#include "core/operations/topology_change.h"
#include "core/topology/generalized_map.h"

namespace dartboard {

/// Delete all darts of the component of `d`. Removed cells are reported by dead darts, one for each (remove_volume.h).
///
/// throws  TopologyError if d is dead; the map is unchanged then
/// cost    O(darts of the component)
template <class Map>
TopologyChange remove_component(Map& map, Dart d);

extern template TopologyChange remove_component(Map2&, Dart);
extern template TopologyChange remove_component(Map3&, Dart);
extern template TopologyChange remove_component(TetMap&, Dart);

}  // namespace dartboard
