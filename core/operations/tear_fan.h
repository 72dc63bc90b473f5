#pragma once
// Tearing: "a closed triangle fan around a vertex", whose dissociation takes the vertex apart (section 5.1).

#include <vector>

#include "core/operations/topology_change.h"
#include "core/topology/generalized_map.h"

namespace dartboard {

/// The fan of faces around the vertex of `d` that starts with the face of `d`: one dart of each, all of that vertex.
///
/// The next face is found by alpha_2, alpha_3, alpha_2, alpha_1: across the edge, to the face that leaves it on the
/// other side. The walk stops where it started (a closed fan) or before alpha_3 at the surface; then the other part of
/// an open fan is found the same way from alpha_1(d). A face that the walk meets twice is listed once.
///
/// cost    O(faces of the fan)
/// source  section 5.1
template <class Map>
std::vector<Dart> fan(const Map& map, Dart d);

/// Dissociate every face of the fan of `d`.
/// throws  TopologyError if d is dead; the map is unchanged then
template <class Map>
TopologyChange tear_fan(Map& map, Dart d);

extern template std::vector<Dart> fan(const Map3&, Dart);
extern template std::vector<Dart> fan(const TetMap&, Dart);
extern template TopologyChange tear_fan(Map3&, Dart);
extern template TopologyChange tear_fan(TetMap&, Dart);

}  // namespace dartboard
