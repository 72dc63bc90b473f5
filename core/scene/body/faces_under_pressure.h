#pragma once
// The faces that the pressures of a scene act on.

#include <vector>

#include "core/plain/mesh.h"
#include "core/scene/file/scene_file.h"
#include "core/views/pressed_faces.h"

namespace dartboard {

/// The outer faces with all corners selected.
///
/// pre     the force is a pressure; it is the one of that number in its scene
/// throws  InputError "/forces/0/pressure: ..." if there are no such faces
/// cost    O(n log n) for n cells
std::vector<PressedFace> faces_under_pressure(const SceneForce& force, std::uint32_t number, const Mesh& mesh);

/// The same for all pressures of the scene that follow their faces; errors name its file.
std::vector<PressedFace> followed_faces(const SceneFile& scene, const Mesh& mesh);

}  // namespace dartboard
