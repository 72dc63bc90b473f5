#pragma once
// The mesh file of a scene, read once, and the points of the scene by their numbers in the body.

#include <cstdint>
#include <vector>

#include "core/meshes/mesh_io.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// The mesh in the file of a body, with a point for each vertex of its map.
///
/// throws  IoError and InputError as read_mesh_file; InputError, where the body says so, for cells that touch without
///         sharing a face
LoadedMesh read_body_mesh(const BodySource& body);

/// Read the mesh files of a scene, if it has some, and replace the point numbers of the scene, which are those of the
/// file, by the places of the points in the body, and tags of cells by the cells' numbers.
///
/// A point where cells only touch is several vertices: fixing, driving and pulling act on all of them, a probe or a
/// tear uses the first, and a face those that belong to it. A mesh with an error is refused later, where the body is
/// made.
/// throws  InputError "FILE: /fixed/0/ids/1: ..." for a number that is no point of the file, or a point of no cell, and
///         for any number in a scene of several bodies; as resolve_tags
void load_mesh(SceneFile& scene);

/// The number by which a user knows a point of the body: that of the mesh file, if the body comes from one, and the
/// same for all points split off one; for several bodies, and for generated ones, the number itself.
std::size_t number_in_file(const SceneFile& scene, std::uint32_t point);
/// These numbers for all points of the body; empty where each is the point's own number.
std::vector<std::uint32_t> numbers_in_file(const SceneFile& scene);

}  // namespace dartboard
