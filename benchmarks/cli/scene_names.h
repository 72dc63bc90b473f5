#pragma once
// The scenes of the gallery by their names, for every verb that takes a scene file.

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "core/scene/file/scene_file.h"

namespace dartboard {

/// benchmarks/scenes
std::filesystem::path gallery_folder();
/// Its scene files, in alphabetical order.
///
/// throws  IoError if there are none
std::vector<std::filesystem::path> gallery_files();

/// The names of the scene files in a folder, without their ending, in alphabetical order.
std::vector<std::string> scene_names(const std::filesystem::path& folder = gallery_folder());

/// The file meant: the file of that path if there is one, else the scene of that name in the gallery.
///
/// throws  InputError for a name found in neither place, IoError for a path; both list similar names, of the gallery
///         and of the `others` that the verb knows
std::filesystem::path scene_file(const std::string& given, std::span<const std::string> others = {});

/// The scene in that file.
///
/// throws  as scene_file and read_scene
SceneFile read_named_scene(const std::string& given);

/// Print the notices about its meshes on standard error.
void tell_notices(const SceneFile& scene);

}  // namespace dartboard
