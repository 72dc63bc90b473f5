#pragma once
// The problem that a scene describes: its mesh and its mechanics.

#include <cstddef>
#include <vector>

#include "core/plain/mesh.h"
#include "core/plain/problem.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// The mesh of the body, or of all bodies, one after another.
///
/// throws  IoError if its file cannot be read, InputError for a generator that cannot make it
Mesh make_mesh(const SceneFile& scene);
/// The same for one body of a scene; errors name the scene's file.
Mesh make_mesh(const std::string& scene, const BodySource& body);

/// The mechanics of the scene: mesh, materials, gravity, fixed points, initial velocities. Driven vertices are fixed
/// here: only DrivenVertices defines how they move.
///
/// throws  as make_mesh; InputError for an id that is no point of the mesh, an empty selection, a speed above that of
///         light, bodies without an inside that are to touch each other, and as assign_materials
Problem make_problem(const SceneFile& scene);

/// Where the cells of each body begin in the mesh of the scene.
///
/// throws  as make_mesh
/// cost    for several bodies, the generated ones are made once more
std::vector<std::size_t> first_cells(const SceneFile& scene);

/// The body of each cell of the mesh of the scene, then of each link of chains; empty for a scene of one body.
///
/// throws and costs as first_cells
std::vector<std::uint32_t> body_of_cells(const SceneFile& scene);

}  // namespace dartboard
