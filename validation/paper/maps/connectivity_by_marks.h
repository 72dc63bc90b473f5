#pragma once
// Conclusion: the loss of connectivity is verified by "checking if all the darts are marked while walking through the
// structure following all the alpha-links".

#include <functional>

#include "core/plain/mesh.h"
#include "core/topology/generalized_map.h"
#include "validation/topology/claim_answer.h"

namespace dartboard {

/// Walks from some dart along all alphas, marking, and returns whether all darts are marked then.
bool all_darts_are_marked(const Map3& map);

/// Dissociate random faces of a fresh body until a piece comes off, in several series. After each dissociation, all
/// darts must be marked exactly if the cells are connected by joined sides, as found without a dart. The answer is no
/// if one of the two cases never occurred.
ClaimAnswer try_marking(const Mesh& mesh, int series, std::uint64_t seed,
                        const std::function<bool(const Map3&)>& is_connected = all_darts_are_marked);

}  // namespace dartboard
