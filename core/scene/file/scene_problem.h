#pragma once
// The problem that a scene describes: its mesh and its mechanics.

#include <cstdint>
#include <vector>

#include "core/plain/mesh.h"
#include "core/plain/problem.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// The mesh of the body, or of all bodies, one after another.
///
/// throws  IoError if its file cannot be read, InputError for a generator that cannot make it
Mesh make_mesh(const SceneFile& scene);
/// The mesh of one body of a scene; errors name the scene's file.
Mesh make_mesh(const std::string& scene, const BodySource& body);

/// The mechanics of the scene: mesh, bodies, materials, gravity, fixed points, initial velocities. Driven vertices are
/// fixed here: only DrivenVertices defines how they move.
///
/// throws  as make_mesh; InputError for an id that is no point of the mesh, an empty selection, a speed above that of
///         light, bodies without an inside that are to touch each other, and as assign_materials
Problem make_problem(const SceneFile& scene);

/// The body of each cell of a mesh, then of each link of chains.
std::vector<std::uint32_t> body_of_cells(const BodyRanges& bodies);

}  // namespace dartboard
