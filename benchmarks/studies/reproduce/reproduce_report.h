#pragma once
// The report of `reproduce` on the paper's body: tables and claims from the gates and the samples.

#include <map>
#include <string>
#include <vector>

#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/paired.h"
#include "benchmarks/harness/table.h"
#include "benchmarks/report/study_log.h"
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
  bool quick = false;            // few rounds: they may confirm the known times, but are no witness against them

  bool timed(const std::string& id) const;
  Ratio ratio(const std::string& id, const std::string& baseline) const { return paired_ratio(per_step, id, baseline); }
  double ms(const std::string& id) const { return times_of(per_step, id).cpu_median * 1e-6; }
};

Table counts_table(const ReproduceResults& results);
Table agreement_table(const ReproduceResults& results);
Table second_table(const ReproduceResults& results);
/// Explains why the bounds of the one table are wide and those of the other are not.
std::string bounds_note();
/// The paper's milliseconds and ratios next to ours.
Table timing_table(const ReproduceResults& results);
/// Explains in numbers why our ratios differ from the paper's.
std::string timing_note(const ReproduceResults& results, const Problem& problem);

/// The outcome of the gates: no timing without agreement.
struct ReproduceGates {
  std::vector<std::string> agreed;  // the contenders that may be timed; none where the topology differs from CGAL's
  bool passed = false;              // all contenders passed, and there is at least one
};
/// A contender whose second of motion is wrong is not timed; if it is the core's, no walk of the core is timed.
ReproduceGates gates_of(const std::vector<CountAgreement>& counts, const std::vector<MotionAgreement>& motion,
                        const std::vector<SecondOfMotion>& second);

/// The paper's sentences on maps and on its body, tried out on the body of the problem.
std::vector<Claim> answer_topology(const std::vector<CountAgreement>& counts, const Problem& problem);

/// Those of them that a built body can violate: they concern its map, its masses and its springs.
std::vector<Claim> answer_body(const MassSpringBody<Map3, Held::by_every_dart>& body, const Problem& problem);

/// The paper's sentences on times; all contenders must have been timed.
std::vector<Claim> answer_time(const ReproduceResults& results);

/// The paper's Fig. 9: series of `removals` removals, the arrays rebuilt once after each. Negligible is read as a
/// tenth.
/// pre  there is a series
Claim answer_rebuild(const std::vector<SeriesTime>& series, int removals);
/// Seven series of twenty removals, timed.
Claim measure_rebuild_claim(const Problem& problem, StudyLog& log);

/// Sorted by the rows of `paper_claims`.
std::vector<Claim> in_order_of_paper(std::vector<Claim> claims);

/// All claims, in the order of the paper.
std::vector<Claim> answer_claims(const ReproduceResults& results, const Problem& problem, StudyLog& log);

/// The exit status of the run: 1 if a gate has failed, or as exit_code(claims).
int reproduce_exit_code(const std::vector<Claim>& claims, bool gates_passed);
/// The last lines: the findings, and a next step for the user.
std::string closing_words(const std::vector<Claim>& claims, bool gates_passed, bool quick);

}  // namespace dartboard
