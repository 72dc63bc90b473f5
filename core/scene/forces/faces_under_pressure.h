#pragma once
// The faces and edges that the pressures and tractions of a scene act on.

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

/// The size of what shares a force, by point of the mesh: the areas [m^2] of the outer faces with all corners selected,
/// or the lengths [m] of the edges on the border of a surface with both ends selected, each divided among its corners
/// as its linear or bilinear shape functions are.
///
/// pre     the force is not shared by vertices
/// throws  InputError "/forces/0/...: ..." if there are no such faces or edges
/// cost    O(n log n) for n cells
std::vector<double> loaded_sizes(const SceneForce& force, const Mesh& mesh);

/// The faces of all pressures of the scene that follow their faces; errors name its file.
std::vector<PressedFace> followed_faces(const SceneFile& scene, const Mesh& mesh);

}  // namespace dartboard
