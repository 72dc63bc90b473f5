#pragma once
// Section 4.3 and Fig. 8: the shares of the parts of a vertex or an edge that comes apart.

#include "validation/paper/cut_subject.h"
#include "validation/topology/claim_answer.h"

namespace dartboard {

/// The sentences of section 4.3, each with an answer of its own.
struct SharesAfterCuts {
  ClaimAnswer mass;        // m = m1 + m2, and each is the sum over the cells around it
  ClaimAnswer stiffness;   // k = k1 + k2, likewise
  ClaimAnswer viscosity;   // proportional to the mass, before and after
  ClaimAnswer rest_shape;  // the masses are those of the rest shape, though the body is deformed
  ClaimAnswer state;       // parts have the position and velocity of the whole, and embeddings of their own
};

/// Dissociate random faces of a deformed body, one after another. After each, the vertices and edges of the face are
/// found by mesh point: a witness lists their remaining cells (RemainingCells, which knows no dart), exact rationals
/// give the masses of these. Every answer is no if nothing came apart.
SharesAfterCuts try_dissociations(const Problem& problem, int dissociations, std::uint64_t seed,
                                  const Adapt& follow = core_adapt);

}  // namespace dartboard
