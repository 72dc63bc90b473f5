#pragma once
// The key of a scene to blame if the numbers of its first state are too large, or too small, for a double.

#include <string>

#include "core/plain/mesh.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// The key whose value is the most orders of magnitude away from 1, in words:
/// "/material/stiffness: is 1e+308, and energies or forces at the start are not finite; expected a smaller value".
std::string key_beyond_numbers(const SceneFile& scene, const Mesh& mesh);

/// "/body/generate/box/spacing: is 1e+300" if the cubes of lengths overflow or vanish; otherwise empty.
std::string size_beyond_numbers(const SceneFile& scene, const Mesh& mesh);

}  // namespace dartboard
