#pragma once
// A scene whose bodies are files of their meshes: as they are, in a mirror, or with points and cells in another order.

#include <cstddef>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/scene/file/scene_file.h"

namespace dartboard {

enum class MeshChange { none, mirrored, renumbered };

struct WrittenScene {
  nlohmann::ordered_json json;
  std::vector<std::size_t> number;  // by point of its bodies: that in the scene it was made from
};

/// The scene, which `file` is, with its bodies from files in a folder: in place, so that nothing scales, turns or moves
/// them. In a mirror x is -x, and all else of the scene is as it was.
///
/// pre  no body is a chain
WrittenScene with_written_meshes(nlohmann::ordered_json scene, const SceneFile& file,
                                 const std::filesystem::path& folder, MeshChange change);

}  // namespace dartboard
