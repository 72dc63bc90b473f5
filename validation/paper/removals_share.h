#pragma once
// Section 3.2: removing a volume shares out mass and stiffness, and frees the faces that it shared with others.

#include "validation/paper/cut_subject.h"
#include "validation/topology/claim_answer.h"

namespace dartboard {

struct RemovalAnswers {
  ClaimAnswer shares;      // the neighbours keep their shares, the body loses the volume's mass and springs
  ClaimAnswer free_faces;  // "the unsewed faces of the volumes surrounding the removed volume become 3-free"
};

/// Remove random volumes of a deformed body. After each, compare every vertex and edge around it with the cells that
/// remain, exact masses and counts of cells; the sums of all masses and stiffnesses; and all free faces.
RemovalAnswers try_removals(const Problem& problem, int removals, std::uint64_t seed, const Adapt& follow = core_adapt);

}  // namespace dartboard
