#pragma once
// The report of `dartboard recommend`.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmarks/harness/table.h"
#include "validation/recommend/recommendation_audit.h"
#include "validation/recommend/recommended_scene.h"

namespace dartboard {

/// Numbers that are not finite are null. `scene` is that of the pick; null where the study has no file.
nlohmann::json json_of(const Recommendation& recommendation, const RecommendedScene* scene);
nlohmann::json json_of(const Audit& audit);

/// A row for each usable candidate.
Table candidates_table(const Recommendation& recommendation);

/// The whole recommendation in words, and the scene of the pick where there is one; also on real time where that was
/// requested, with the `duration` [s] of the scene.
std::string text_of(const Recommendation& recommendation, const RecommendedScene* scene, bool realtime,
                    double duration);

/// A pick that was run.
struct FollowedPick {
  std::string scene, contender;
  Audit audit;
  bool is_resolved = true;  // can the reference resolve whether the error was met?

  bool misses() const { return is_resolved && !audit.met(); }
};

/// The predictions compared with the outcome.
Table followed_table(const std::vector<FollowedPick>& picks);

}  // namespace dartboard
