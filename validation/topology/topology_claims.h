#pragma once
// General statements of the paper on maps and graphs, tried out.

#include <cstdint>

#include "core/plain/mesh.h"
#include "core/topology/convert.h"
#include "core/topology/generalized_map.h"
#include "validation/topology/claim_answer.h"

namespace dartboard {

/// Sections 1 and 2: no operation leaves the class of objects in which a face joins at most two volumes. Random
/// dissociations, removals and sews; the conditions are checked after each.
ClaimAnswer try_to_leave_the_class(const Mesh& mesh, int operations, std::uint64_t seed);

/// Fig. 2: cells joined by a vertex or an edge only cannot be built as joined, three cells on a face cannot be built at
/// all.
ClaimAnswer try_non_manifold_inputs();

/// Section 1: one face of the mesh is dissociated without taking a vertex or edge apart. Nodes, springs and tetrahedra
/// are the same before and after, so no adjacency graph can distinguish the two bodies; the maps are not isomorphic.
ClaimAnswer try_same_graph_twice(const Mesh& mesh);

/// Section 2: export to a combinatorial map, with half the darts, and back.
ClaimAnswer try_combinatorial_round_trip(const Mesh& mesh);
/// Whether `half`, exported from `map`, restores it.
ClaimAnswer comes_back(const Map3& map, const CombinatorialMap& half);

}  // namespace dartboard
