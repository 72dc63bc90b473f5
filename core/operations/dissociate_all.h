#pragma once
// Dissociation of a set of faces, such as those of a seam, as one change.

#include <span>

#include "core/operations/topology_change.h"
#include "core/topology/generalized_map.h"

namespace dartboard {

/// Dissociate the face of each dart, in the order given; in a surface, its edge. Those on the boundary already, and
/// those met before, are skipped.
///
/// throws  TopologyError if one of the darts is dead; the map is unchanged then
/// cost    that of dissociating them one by one
template <class Map>
TopologyChange dissociate_all(Map& map, std::span<const Dart> facets);

extern template TopologyChange dissociate_all(Map2&, std::span<const Dart>);
extern template TopologyChange dissociate_all(Map3&, std::span<const Dart>);
extern template TopologyChange dissociate_all(TetMap&, std::span<const Dart>);

}  // namespace dartboard
