#pragma once
// What a scene stands for: its mesh, and its mechanics.

#include "core/plain/mesh.h"
#include "core/plain/problem.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// The mesh of the body; of a chain its points alone.
///
/// throws  IoError if its file cannot be read, InputError for a generator that cannot make it
Mesh make_mesh(const SceneFile& scene);

/// The mechanics of the scene: mesh, material, gravity, what is fixed, how it moves first. Driven vertices are fixed
/// here: how they move is told by DrivenVertices alone.
///
/// throws  as make_mesh; InputError for an id that is no point of the mesh, a selection of none, a speed above that of
///         light, a Young's modulus of cells that are no simplices
Problem make_problem(const SceneFile& scene);

}  // namespace dartboard
