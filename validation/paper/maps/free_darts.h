#pragma once
// Section 2.1: closed objects have no fixed points; of open ones, the fixed points of alpha_n are the boundary.

#include "core/plain/mesh.h"
#include "core/topology/generalized_map.h"
#include "validation/topology/claim_answer.h"

namespace dartboard {

/// For a map of a mesh, in which point[d] is the mesh point of dart d: its n-free darts, gathered by the points of
/// their facets, are the sides that only one cell of the mesh has, each with all its darts; no other dart is free.
template <class Map>
ClaimAnswer free_darts_are_boundary(const Map& map, const std::vector<std::uint32_t>& point, const Mesh& mesh);

/// All of this for an open solid, and for a sphere and a torus, which have no boundary.
ClaimAnswer try_free_darts(const Mesh& solid);

extern template ClaimAnswer free_darts_are_boundary(const Map2&, const std::vector<std::uint32_t>&, const Mesh&);
extern template ClaimAnswer free_darts_are_boundary(const Map3&, const std::vector<std::uint32_t>&, const Mesh&);

}  // namespace dartboard
