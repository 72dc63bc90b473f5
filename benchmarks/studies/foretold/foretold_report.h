#pragma once
// What an audit of recommendations for long motions says: its pairs of scene and error, claims, tables and picture.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmarks/figures/plot.h"
#include "benchmarks/harness/claim.h"
#include "benchmarks/harness/table.h"
#include "validation/recommend/recommendation_audit.h"

namespace dartboard {

/// A recommendation that pilots over a small part of a motion gave for the whole, and what came of it.
struct ForetoldPair {
  std::string scene, what;
  std::size_t vertices = 0, springs = 0;
  double omega_phase = 0.0;  // duration times omega_max
  double floor = 0.0;        // [edges] what the other codes can tell
  std::string pick;          // empty when nothing was recommended, or nothing followed
  bool followed = true;      // else the run recommended takes longer than an audit can
  std::string confidence;    // of the pick
  RunSetting setting;        // of the pick
  double seen_part = 1.0;    // of the duration, by the pilots of the pick
  bool warned = false;       // that errors were seen to grow as those of chaotic motions
  Audit audit;

  /// Is it a prediction: does the run cost 20 times the pilots, and have they kept to 2 s or a tenth of it?
  bool foretold() const;
  /// Can the other codes tell whether the error was met?
  bool told() const { return audit.error >= floor; }
  double seconds_ratio() const { return audit.printed_s / audit.actual_s; }
};

/// The targets: 40 pairs that are predictions; of those errors met in 95 %, seconds as printed within 15 % in 95 %,
/// median regret at most 1.2. A pair without a pick misses its error; of one whose run is too long to be
/// followed nothing is known.
std::vector<Claim> foretold_claims(const std::vector<ForetoldPair>& pairs);

Table foretold_table(const std::vector<ForetoldPair>& pairs);
/// What was drawn, a row for each scene.   pre  the pairs of a scene follow each other
Table foretold_scenes_table(const std::vector<ForetoldPair>& pairs);

/// One line of samples.jsonl; what is not finite is null.
nlohmann::json json_of(const ForetoldPair& pair);

/// Actual over asked error against the part of the motion that was seen, a point for each pair.
Plot foretold_plot(const std::vector<ForetoldPair>& pairs, const std::string& subtitle);

}  // namespace dartboard
