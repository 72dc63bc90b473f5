#pragma once
// Selection of cells by the marks in their mesh file.

#include <cstdint>
#include <string>
#include <vector>

#include "core/scene/file/scene_file.h"

namespace dartboard {

/// The numbers of the cells that a mesh file marks in this way, ascending; those of several bodies count on from one to
/// the next.
///
/// throws  InputError "FILE: PATH: ..." where no file has such marks, several kinds of marks could be meant, or no cell
///         has this one; IoError if a file cannot be read
std::vector<std::uint32_t> cells_with(const SceneFile& scene, const TagSelection& tag, const std::string& path);

/// Replace the tags in the regions and the events of a scene by the numbers of their cells.
/// throws  as cells_with
void resolve_tags(SceneFile& scene);

}  // namespace dartboard
