#pragma once
// The report of an audit of `recommend` on unseen scenes: its pairs of scene and error, claims, tables and picture.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmarks/figures/plot.h"
#include "benchmarks/harness/claim.h"
#include "benchmarks/studies/tradeoff/audit_plan.h"
#include "validation/recommend/recommendation_audit.h"

namespace dartboard {

/// One recommendation, followed.
struct AuditedPair {
  std::string scene, what;   // the scene's name, and what was drawn
  std::string reference;     // name(ReferenceKind)
  double floor = 0.0;        // [edges] smaller errors cannot be resolved
  std::string pick;          // empty when nothing was recommended, or nothing followed
  bool followed = true;      // else its pilots or its run take longer than an audit can
  std::string confidence;    // of the pick
  RunSetting setting;        // of the pick
  double seen_part = 1.0;    // of the duration, by the pilots of the pick
  bool warned = false;       // that errors grow as those of chaotic motions
  double omega_phase = 0.0;  // duration times omega_max
  std::size_t vertices = 0, springs = 0;
  bool swept = false;  // is there a sweep to compare with?
  Audit audit;

  /// Can the reference resolve whether the error was met?
  bool is_resolved() const { return audit.error >= floor; }
  /// Is it a prediction: does the run cost 20 times the pilots, and have they kept to 2 s or a tenth of it?
  bool is_long_prediction() const;
  double count_ratio() const { return audit.predicted_evaluations / audit.actual_evaluations; }
  double pilot_part() const { return audit.pilot_s / audit.actual_s; }
  /// Predicted over measured seconds: for long motions the predicted ones as they were printed.
  double time_ratio(AuditKind kind) const {
    return (kind == AuditKind::long_motions ? audit.printed_s : audit.predicted_s) / audit.actual_s;
  }
};

/// The targets of both: errors met in 95 %, seconds within 15 % in 95 %, median regret at most 1.2; a pair without a
/// pick misses its error. For scenes, also force evaluations within 15 % in 95 %, and pilots at most 20 % of runs
/// longer than 5 s. For long motions, 40 pairs that are predictions, and only these count; of a pair whose run is too
/// long to be followed nothing is known.
std::vector<Claim> audit_claims(AuditKind kind, const std::vector<AuditedPair>& pairs);

Table audit_table(AuditKind kind, const std::vector<AuditedPair>& pairs);

/// The scenes drawn, a row for each.
/// pre  the pairs of a scene follow each other
Table audited_scenes_table(AuditKind kind, const std::vector<AuditedPair>& pairs);

/// One line of samples.jsonl; numbers that are not finite are null.
nlohmann::json json_of(const AuditedPair& pair);

/// Actual over requested error, a point for each pair: against predicted over actual time, for long motions against the
/// part of the motion that was seen.
Plot audit_plot(AuditKind kind, const std::vector<AuditedPair>& pairs, const std::string& subtitle);

}  // namespace dartboard
