#pragma once
// Fig. 3: a manifold body, and a quasi-manifold that is not a manifold and can be simulated as well.

#include "core/plain/mesh.h"
#include "validation/topology/claim_answer.h"

namespace dartboard {

/// Two bodies of tetrahedra. In the first the neighbourhood of every vertex is a ball or half of one, in the second
/// that of some vertex is neither: the Euler characteristic of its link (the triangles opposite to it) is not 2 or 1.
/// Each link is counted from the orbits of the map and from the cells of the mesh. Both maps have to be valid, with one
/// vertex for each mesh point, and both bodies have to move as the reference does (moves_as_reference.h).
ClaimAnswer try_pinched_vertex(const Mesh& manifold, const Mesh& pinched);

}  // namespace dartboard
