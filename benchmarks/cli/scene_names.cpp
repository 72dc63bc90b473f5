#include "benchmarks/cli/scene_names.h"

#include <fmt/format.h>

#include <algorithm>

#include "benchmarks/checkout/source_folder.h"
#include "benchmarks/harness/tell.h"
#include "core/meshes/mesh_io.h"
#include "core/plain/error.h"
#include "core/scene/file/keys/scene_check.h"
#include "core/scene/file/keys/scene_keys.h"

namespace dartboard {
namespace {

namespace fs = std::filesystem;

/// Names that differ by a slip of the keys or contain the word; all names if there are none.
std::vector<std::string> near_names(const std::vector<std::string>& names, const std::string& word) {
  std::vector<std::string> near;
  for (const std::string& name : names)
    if (nearest_of(std::span(&name, 1), word) || (word.size() > 2 && name.find(word) != std::string::npos))
      near.push_back(name);
  return near.empty() ? names : near;
}

}  // namespace

fs::path gallery_folder() { return source_folder() / "benchmarks" / "scenes"; }

std::vector<std::string> scene_names(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".json") names.push_back(entry.path().stem().string());
  std::ranges::sort(names);
  return names;
}

std::vector<fs::path> gallery_files() {
  std::vector<fs::path> files;
  for (const std::string& name : scene_names()) files.push_back(gallery_folder() / (name + ".json"));
  if (files.empty()) throw IoError(fmt::format("{}: no scenes there", gallery_folder().string()));
  return files;
}

fs::path scene_file(const std::string& given, std::span<const std::string> others) {
  std::error_code error;
  fs::path path(given);
  if (fs::exists(path, error)) return path;
  std::vector<std::string> names = scene_names();
  const bool bare = !given.empty() && !path.has_parent_path();
  const std::string stem = path.extension() == ".json" ? path.stem().string() : path.filename().string();
  if (bare && std::ranges::find(names, stem) != names.end()) return gallery_folder() / (stem + ".json");
  names.insert(names.end(), others.begin(), others.end());
  const std::string hint = quoted_list(near_names(names, stem), ", ");
  if (bare && stem == given)
    throw InputError(fmt::format("'{}' is neither a scene file nor the name of a scene; there are {}", given, hint));
  throw IoError(fmt::format("{}: there is no such file; expected a scene{}", given, bare ? ", or one of " + hint : ""));
}

SceneFile read_named_scene(const std::string& given) { return read_scene(scene_file(given)); }

void tell_notices(const SceneFile& scene) {
  for (const BodySource& body : scene.bodies()) {
    if (!body.loaded) continue;
    for (const std::string& notice : body.loaded->notices)
      if (!notice.starts_with("skipped "))  // cells of a lower dimension, no part of a body: `mesh info` reports them
        tell(stderr, "notice: {}/mesh: {}\n", body.path, notice);
  }
}

}  // namespace dartboard
