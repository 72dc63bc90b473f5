#include "benchmarks/paper/paper_claims.h"

#include <utility>

namespace dartboard {

Claim claim_of(PaperClaimId id) {
  const PaperClaim& row = id.row();
  return {.id = std::string(row.id),
          .text = std::string(row.text),
          .section = std::string(row.section),
          .paper_value = std::string(row.paper_value),
          .expected = row.does_not_carry_over.empty() ? Verdict::holds : Verdict::does_not_carry_over};
}

bool is_impossibility(PaperClaimId id) { return id.row().about == About::programs; }

Claim answered(PaperClaimId id, Met met, std::string measured, std::string bound_or_interval) {
  Claim claim = claim_of(id);
  claim.measured = std::move(measured);
  claim.bound_or_interval = std::move(bound_or_interval);
  judge(claim, met);
  if (claim.verdict == Verdict::falls_short && id.row().about != About::bodies) {
    claim.verdict = Verdict::does_not_carry_over;
    claim.reason = id.row().does_not_carry_over;
  }
  return claim;
}

}  // namespace dartboard
