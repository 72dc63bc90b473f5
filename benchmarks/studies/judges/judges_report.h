#pragma once
// The report of `validate judges`: tables and claims.

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/table.h"
#include "validation/judges/judge_trials.h"

namespace dartboard {

struct JudgesResults {
  std::vector<JudgeTrial> trials;
  std::vector<SchemeSlack> slack;
};

/// For each judge: what it is independent of, its bound, how much of that sound integrators take up, and the share of
/// wrong integrators that it sees.
Table judges_table(const JudgesResults& results);

/// The studies that run integrators, or seem to, and do not judge them: they are not expected to see a wrong one.
Table others_table();

/// A row for each judge and part, a column for each way of being wrong: number seen of those tried.
Table trials_table(const JudgesResults& results);

/// Every case in which a wrong integrator was not distinguished from a right one.
Table unseen_table(const JudgesResults& results);

Table slack_table(const JudgesResults& results);

std::vector<Claim> claims_of(const JudgesResults& results);

nlohmann::ordered_json to_json(const JudgesResults& results);

}  // namespace dartboard
