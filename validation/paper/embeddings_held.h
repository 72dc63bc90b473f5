#pragma once
// Section 2.2: information is attached to all the darts of an orbit or to a single one, with the same results.

#include "core/mechanics/mass_spring_body.h"
#include "validation/topology/claim_answer.h"

namespace dartboard {

/// Each dart finds the same embeddings in both bodies, and after `steps` steps by full coverage, and then as many along
/// lists, both are in the same state, bit for bit, which differs from that at the start.
ClaimAnswer same_results(MassSpringBody<Map3, Held::by_one_dart> one, MassSpringBody<Map3, Held::by_every_dart> every,
                         double h, int steps);

ClaimAnswer try_both_ways_to_hold(const Problem& problem, int steps);

}  // namespace dartboard
