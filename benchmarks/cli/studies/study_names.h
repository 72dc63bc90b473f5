#pragma once
// Names of scenes for the verbs that study them: tradeoff, recommend.

#include <algorithm>
#include <string>
#include <vector>

#include "benchmarks/cli/scene_names.h"
#include "validation/scenes/tradeoff_scenes.h"

namespace dartboard {

/// A name of a study scene as it is, else the file that `scene_file` finds.
inline std::string study_scene_or_file(const std::string& given) {
  std::vector<std::string> names;
  for (const TradeoffEntry& entry : tradeoff_scenes()) names.emplace_back(entry.name);
  if (std::ranges::find(names, given) != names.end()) return given;
  return scene_file(given, names).string();
}

/// "smooth, cut, ..."
inline std::string study_scene_names() {
  std::string known;
  for (const TradeoffEntry& entry : tradeoff_scenes()) known += (known.empty() ? "" : ", ") + std::string(entry.name);
  return known;
}

}  // namespace dartboard
