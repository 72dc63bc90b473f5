#pragma once
// What `reproduce` says about the paper's body: tables and claims from the gates and the samples.

#include <map>
#include <string>
#include <vector>

#include "benchmarks/claim.h"
#include "benchmarks/paired.h"
#include "benchmarks/table.h"
#include "core/plain/problem.h"
#include "validation/motion_agreement.h"
#include "validation/topology_agreement.h"

namespace dartboard {

/// Everything measured about the contenders; those that failed a gate have no sample.
struct ReproduceResults {
  std::vector<CountAgreement> counts;
  std::vector<MotionAgreement> motion;
  std::vector<Sample> per_step;  // scaled to one step
  double rebuild_ms = 0.0;       // building the cell arrays from scratch

  bool timed(const std::string& id) const;
  Ratio ratio(const std::string& id, const std::string& baseline) const { return paired_ratio(per_step, id, baseline); }
  double ms(const std::string& id) const { return times_of(per_step, id).cpu_median * 1e-6; }
};

Table counts_table(const ReproduceResults& results);
Table agreement_table(const ReproduceResults& results);
/// The paper's milliseconds and ratios beside ours.
Table timing_table(const ReproduceResults& results);
/// Why our ratios are not the paper's, in numbers.
std::string timing_note(const ReproduceResults& results, const Problem& problem);

/// Time to build the cell arrays of the problem's body from scratch [ms], median of a few.
double measure_rebuild_ms(const Problem& problem);

/// The claims about the body that need no clock, then those about time.
std::vector<Claim> answer_claims(const ReproduceResults& results, const Problem& problem);

}  // namespace dartboard
