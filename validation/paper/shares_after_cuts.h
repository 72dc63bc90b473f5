#pragma once
// Section 4.3 and Fig. 8: what a vertex or an edge that comes apart leaves to its parts.

#include "validation/paper/cut_subject.h"
#include "validation/topology/claim_answer.h"

namespace dartboard {

/// The sentences of section 4.3, each with an answer of its own.
struct SharesAfterCuts {
  ClaimAnswer mass;        // m = m1 + m2, and each is what the cells around it give
  ClaimAnswer stiffness;   // k = k1 + k2, likewise
  ClaimAnswer viscosity;   // proportional to the mass, before and after
  ClaimAnswer rest_shape;  // the masses are those of the rest shape, though the body is deformed
  ClaimAnswer state;       // parts have the position and velocity of the whole, and embeddings of their own
};

/// Dissociate random faces of a deformed body, one after another. After each, the vertices and edges of the face are
/// asked for by mesh point: a witness says which cells they have left (RemainingCells, which knows no dart), exact
/// rationals what these weigh. Every answer is no where nothing came apart.
SharesAfterCuts try_dissociations(const Problem& problem, int dissociations, std::uint64_t seed,
                                  const Adapt& follow = core_adapt);

}  // namespace dartboard
