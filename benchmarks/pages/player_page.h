#pragma once
// The page that plays a run.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmarks/pages/recorded_frames.h"

namespace dartboard {

/// The most pictures of a player, after the first.
inline constexpr std::uint64_t most_player_pictures = 120;

/// What a page says about its run besides its pictures.
struct PlayedRun {
  const SceneFile& scene;
  const Look& look;                   // as pictures are seen
  std::vector<std::string> facts;     // a line that names the run, one that says how it is run, then others
  std::vector<std::string> warnings;  // printed before it
  std::string text;                   // printed after it
};

/// The data of a page, which takes less than 3 MB: bodies of many points have fewer pictures.
nlohmann::json player_page(const RecordedFrames& frames, const PlayedRun& run);

}  // namespace dartboard
