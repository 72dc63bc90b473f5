#pragma once
// What `dartboard recommend` says.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmarks/harness/table.h"
#include "validation/recommend/recommendation_audit.h"

namespace dartboard {

/// What is not finite is null.
nlohmann::json json_of(const Recommendation& recommendation);
nlohmann::json json_of(const Audit& audit);

/// A row for each usable candidate.
Table candidates_table(const Recommendation& recommendation);

/// All of it in words; of real time where that was asked for, with the `duration` [s] of the scene.
std::string text_of(const Recommendation& recommendation, bool realtime, double duration);

/// A pick that was run.
struct FollowedPick {
  std::string contender;
  Audit audit;
  bool told = true;  // can the reference tell whether the error was met?

  bool misses() const { return told && !audit.met(); }
};

/// What was predicted beside what happened.
Table followed_table(const std::vector<FollowedPick>& picks);

}  // namespace dartboard
