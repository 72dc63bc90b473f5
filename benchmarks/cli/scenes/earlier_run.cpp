#include "benchmarks/cli/scenes/earlier_run.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "benchmarks/pages/page.h"
#include "core/base/folder_claim.h"
#include "core/plain/error.h"
#include "core/scene/output/scene_output.h"
#include "core/scene/restart/checkpoint.h"

namespace dartboard {
namespace fs = std::filesystem;
namespace {

/// Is this the name of a file that `simulate` writes?
bool is_of_a_run(const fs::path& file) {
  const std::string name = file.filename().string(), extension = file.extension().string();
  constexpr std::array drawn{".png", ".svg", ".gif", ".gnuplot", ".dat"};
  if (name == "manifest.json" || name == "summary.json" || name == checkpoint_name || SceneOutput::writes(name))
    return true;
  if (extension == ".html") return is_page(file, "player");
  const bool is_drawn = name.starts_with("picture") || name.starts_with("film") || name.starts_with("curves");
  return is_drawn && std::ranges::find(drawn, extension) != drawn.end();
}

}  // namespace

bool is_run_folder(const fs::path& folder) {
  std::ifstream in(folder / "manifest.json", std::ios::binary);
  const auto manifest = nlohmann::json::parse(in, nullptr, false);
  return manifest.is_object() && manifest.contains("dartboard");
}

void empty_run_folder(const fs::path& folder, std::span<const fs::path> inputs) {
  std::error_code error;
  if (!fs::exists(folder, error) || fs::is_empty(folder, error)) return;
  const auto refuse = [&folder](const std::string& what) {
    throw IoError(
        fmt::format("{}: {}; expected the folder of a run to replace, and nothing else in it", folder.string(), what));
  };
  if (!is_run_folder(folder)) refuse("has no manifest of a run");
  const FolderClaim claim = FolderClaim::of_ended_run(folder);
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
    if (!entry.is_regular_file() || entry.is_symlink() || !is_of_a_run(entry.path()))
      refuse(fmt::format("has '{}'", entry.path().filename().string()));
    for (const fs::path& input : inputs)
      if (fs::equivalent(input, entry.path(), error))
        refuse(fmt::format("has '{}', which the new run reads", entry.path().filename().string()));
    files.push_back(entry.path());
  }
  // the manifest goes last: what is left of an interrupted removal is still a run
  std::stable_partition(files.begin(), files.end(),
                        [](const fs::path& file) { return file.filename() != "manifest.json"; });
  for (const fs::path& file : files)
    if (!fs::remove(file, error) || error)
      throw IoError(fmt::format("{}: cannot be removed: {}", file.string(), error.message()));
}

}  // namespace dartboard
