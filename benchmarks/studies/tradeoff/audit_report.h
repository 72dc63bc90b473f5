#pragma once
// What an audit of `recommend` on unseen scenes says: its pairs of scene and error, claims, table and picture.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmarks/figures/plot.h"
#include "benchmarks/harness/claim.h"
#include "validation/recommend/recommendation_audit.h"

namespace dartboard {

/// One recommendation, followed.
struct AuditedPair {
  std::string scene, what;   // the scene's name, and what was drawn
  std::string reference;     // name(ReferenceKind)
  double floor = 0.0;        // [edges] errors below say nothing
  std::string pick;          // empty when nothing was recommended
  std::string confidence;    // of the pick
  RunSetting setting;        // of the pick
  double omega_phase = 0.0;  // duration times omega_max
  std::size_t vertices = 0, springs = 0;
  bool swept = false;  // is there a sweep to compare with?
  Audit audit;

  /// Can the reference tell whether the error was met?
  bool told() const { return audit.error >= floor; }
  double cost_ratio() const { return audit.predicted_s / audit.actual_s; }
  double count_ratio() const { return audit.predicted_evaluations / audit.actual_evaluations; }
  double pilot_part() const { return audit.pilot_s / audit.actual_s; }
};

/// The targets: errors met in 95 %, costs within 15 % in 95 %, median regret at most 1.2, pilots at most 20 % of runs
/// longer than 5 s. A pair without a pick misses its error.
std::vector<Claim> audit_claims(const std::vector<AuditedPair>& pairs);

Table audit_table(const std::vector<AuditedPair>& pairs);

/// What was drawn, a row for each scene.   pre  the pairs of a scene follow each other
Table audited_scenes_table(const std::vector<AuditedPair>& pairs);

/// One line of samples.jsonl; what is not finite is null.
nlohmann::json json_of(const AuditedPair& pair);

/// Actual over asked error against predicted over actual time, a point for each pair.
Plot audit_plot(const std::vector<AuditedPair>& pairs, const std::string& subtitle);

}  // namespace dartboard
