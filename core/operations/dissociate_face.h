#pragma once
// The paper's elementary operation: separate two volumes by dissociating their common face.

#include "core/operations/topology_change.h"
#include "core/topology/generalized_map.h"

namespace dartboard {

/// Separate the two volumes that share the face of `d` by 3-unsewing it.
///
/// Returns the face, and the edges and vertices of it that came apart; the side of `d` keeps the embeddings. Nothing
/// happens when the face is on the boundary already. The darts touched are checked before it returns. If a face meets
/// one cell at several corners, which is possible after sewing faces of one volume, a cell may be reported more than
/// once.
///
/// throws  TopologyError if d is dead
/// cost    O(darts around the edges of the face), and around a vertex when two of its edges came apart
/// source  section 3.2 and appendix A
template <class Map>
TopologyChange dissociate_face(Map& map, Dart d);

/// Dissociates exactly as in appendix A: every vertex and edge is tested by walking its whole orbit. The oracle of
/// `dissociate_face`.
template <class Map>
TopologyChange dissociate_face_by_orbits(Map& map, Dart d);

/// Separates the two faces of a surface that share the edge of `d` (Fig. 6 and 7).
TopologyChange dissociate_edge(Map2& map, Dart d);

extern template TopologyChange dissociate_face(Map3&, Dart);
extern template TopologyChange dissociate_face(TetMap&, Dart);
extern template TopologyChange dissociate_face_by_orbits(Map3&, Dart);
extern template TopologyChange dissociate_face_by_orbits(TetMap&, Dart);

}  // namespace dartboard
