#pragma once
// What `reproduce` says about the paper's body: tables and claims from the gates and the samples.

#include <map>
#include <string>
#include <vector>

#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/paired.h"
#include "benchmarks/harness/table.h"
#include "benchmarks/studies/operations/operation_study.h"
#include "core/mechanics/mass_spring_body.h"
#include "core/plain/problem.h"
#include "validation/contenders/motion_agreement.h"
#include "validation/contenders/motion_second.h"
#include "validation/contenders/topology_agreement.h"

namespace dartboard {

/// Everything measured about the contenders; those that failed a gate have no sample.
struct ReproduceResults {
  std::vector<CountAgreement> counts;
  std::vector<MotionAgreement> motion;
  std::vector<SecondOfMotion> second;
  std::vector<Sample> per_step;  // scaled to one step
  bool quick = false;            // few rounds: they may confirm what is known of times, and are no witness against it

  bool timed(const std::string& id) const;
  Ratio ratio(const std::string& id, const std::string& baseline) const { return paired_ratio(per_step, id, baseline); }
  double ms(const std::string& id) const { return times_of(per_step, id).cpu_median * 1e-6; }
};

Table counts_table(const ReproduceResults& results);
Table agreement_table(const ReproduceResults& results);
Table second_table(const ReproduceResults& results);
/// Why the bounds of the one table are wide and those of the other are not.
std::string bounds_note();
/// The paper's milliseconds and ratios beside ours.
Table timing_table(const ReproduceResults& results);
/// Why our ratios are not the paper's, in numbers.
std::string timing_note(const ReproduceResults& results, const Problem& problem);

/// What the gates let through: no timing without agreement.
struct ReproduceGates {
  std::vector<std::string> agreed;  // the contenders that may be timed; none where the topology differs from CGAL's
  bool passed = false;              // all of them, and there is at least one
};
/// A contender that a second of motion is not right of is not timed, and, where it is the core's, no walk of it.
ReproduceGates gates_of(const std::vector<CountAgreement>& counts, const std::vector<MotionAgreement>& motion,
                        const std::vector<SecondOfMotion>& second);

/// What the paper says of maps and of its body, tried out on the body of the problem.
std::vector<Claim> answer_topology(const std::vector<CountAgreement>& counts, const Problem& problem);

/// The part of them that a built body can be wrong in: its map, its masses and its springs.
std::vector<Claim> answer_body(const MassSpringBody<Map3, Held::by_every_dart>& body, const Problem& problem);

/// What it says of times, where all contenders were timed.
std::vector<Claim> answer_time(const ReproduceResults& results);

/// The paper's Fig. 9: series of `removals` removals, the arrays rebuilt once after each. Negligible is read as a
/// tenth.   pre  there is a series
Claim answer_rebuild(const std::vector<SeriesTime>& series, int removals);
/// Seven series of twenty removals, timed.
Claim measure_rebuild_claim(const Problem& problem);

/// By the rows of `paper_claims`.
std::vector<Claim> in_order_of_paper(std::vector<Claim> claims);

/// All of them, in the order of the paper.
std::vector<Claim> answer_claims(const ReproduceResults& results, const Problem& problem);

/// What the run comes to: 1 if a gate has failed, or as exit_code(claims).
int reproduce_exit_code(const std::vector<Claim>& claims, bool gates_passed);
/// The last lines: what was found, and what to try next.
std::string closing_words(const std::vector<Claim>& claims, bool gates_passed, bool quick);

}  // namespace dartboard
