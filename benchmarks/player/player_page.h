#pragma once
// A run as one page that plays it in a browser, without a network.

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "benchmarks/player/recorded_frames.h"

namespace dartboard {

/// The most pictures of a player, after the first.
inline constexpr std::uint64_t most_player_pictures = 120;

/// What a page says about its run besides its pictures.
struct PlayedRun {
  const SceneFile& scene;
  const Look& look;                             // as pictures are seen
  std::vector<std::string> facts;               // a line that names the run, then others
  std::vector<std::vector<std::string>> table;  // quantities, at the start and at the end
};

/// The data of a page, which takes less than 3 MB: bodies of many points have fewer pictures.
nlohmann::json player_page(const RecordedFrames& frames, const PlayedRun& run);

/// Is this file a page made by `write_page`?
bool is_page(const std::filesystem::path& file);

/// `made_later` is a folder that will be there when the page is written.
/// throws  IoError if there is no folder for it, or the file exists and is not to be replaced, or is no page made here
void require_writable_page(const std::filesystem::path& file, bool replace, const std::filesystem::path& made_later);

/// Make a page by a template of this folder, `name`.html.
///
/// returns  a sentence on what went wrong; empty when all is well
/// throws   IoError when the file cannot be written
std::string write_page(const std::string& name, const nlohmann::json& page, const std::filesystem::path& file);

}  // namespace dartboard
