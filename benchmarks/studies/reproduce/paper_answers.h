#pragma once
// The paper's sentences on maps, operations and embeddings, tested on its body in its situations: validation/paper.

#include <string>
#include <vector>

#include "benchmarks/harness/claim.h"
#include "benchmarks/paper/paper_claims.h"
#include "core/plain/problem.h"
#include "validation/topology/claim_answer.h"

namespace dartboard {

/// The claim of this id, answered: `where` names the body it was tried on, and the witness. For a sentence that says
/// that something is impossible, `tried.holds` means that it was done, and the sentence is not met.
Claim tried_out(PaperClaimId id, const ClaimAnswer& tried, std::string where);

/// All of these claims; some 3 seconds on the paper's body.
/// pre  its cells are tetrahedra
std::vector<Claim> answer_by_trials(const Problem& problem);

}  // namespace dartboard
