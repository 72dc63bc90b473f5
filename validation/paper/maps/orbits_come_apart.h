#pragma once
// Section 3.2, Fig. 6 and 7: a cell comes apart exactly when two unsewn darts no longer share its orbit.

#include <functional>

#include "core/operations/topology_change.h"
#include "core/topology/generalized_map.h"
#include "validation/topology/claim_answer.h"

namespace dartboard {

/// Dissociates the facet of a dart: core's operation, or a faulty stand-in.
template <class Map>
using DissociateFacet = std::function<TopologyChange(Map&, Dart)>;

/// Dissociate random faces of a solid, or edges of a surface (Map2). After each the alphas, as plain numbers, are
/// gathered into orbits by union-find; the vertices and edges whose two sides are in different ones must be those that
/// the operation reports, each once. The answer is no if no vertex, or in a solid no edge, came apart, or all did.
template <class Map>
ClaimAnswer try_orbits(const Map& at_rest, int dissociations, std::uint64_t seed,
                       const DissociateFacet<Map>& dissociate);
/// Tries core's operation.
template <class Map>
ClaimAnswer try_orbits(const Map& at_rest, int dissociations, std::uint64_t seed);

extern template ClaimAnswer try_orbits(const Map2&, int, std::uint64_t, const DissociateFacet<Map2>&);
extern template ClaimAnswer try_orbits(const Map3&, int, std::uint64_t, const DissociateFacet<Map3>&);
extern template ClaimAnswer try_orbits(const Map2&, int, std::uint64_t);
extern template ClaimAnswer try_orbits(const Map3&, int, std::uint64_t);

}  // namespace dartboard
