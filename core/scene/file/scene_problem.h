#pragma once
// What a scene stands for: its mesh, and its mechanics.

#include <cstddef>
#include <vector>

#include "core/plain/mesh.h"
#include "core/plain/problem.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// The mesh of the body, or of all bodies, one after another; of a chain its points alone.
///
/// throws  IoError if its file cannot be read, InputError for a generator that cannot make it
Mesh make_mesh(const SceneFile& scene);
/// The same of one body of a scene, whose file errors name.
Mesh make_mesh(const std::string& scene, const BodySource& body);

/// The mechanics of the scene: mesh, materials, gravity, what is fixed, how it moves first. Driven vertices are fixed
/// here: how they move is told by DrivenVertices alone.
///
/// throws  as make_mesh; InputError for an id that is no point of the mesh, a selection of none, a speed above that of
///         light, bodies of two dimensions, surfaces that are to touch each other, and as assign_materials
Problem make_problem(const SceneFile& scene);

/// Where the cells of each body begin in the mesh of the scene.
///
/// throws  as make_mesh
/// cost    of several bodies, those that are generated are made once more
std::vector<std::size_t> first_cells(const SceneFile& scene);

}  // namespace dartboard
