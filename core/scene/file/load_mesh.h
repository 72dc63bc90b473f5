#pragma once
// The mesh file of a scene, read once, and the points of the scene by the numbers that the body has them by.

#include <cstdint>
#include <vector>

#include "core/meshes/mesh_io.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// The mesh in the file of a body, with a point for each vertex of its map.
///
/// throws  IoError and InputError as read_mesh; InputError, where the body says so, for cells that touch without sharing
///         a face
LoadedMesh read_body_mesh(const BodySource& body);

/// Read the mesh files of a scene, if it has some, and replace the point numbers of the scene, which are those of the
/// file, by the places of the points in the body, and tags of cells by the cells' numbers.
///
/// A point that cells only touch at is several vertices: what is fixed, driven or pulled at there is all of them, a
/// probe or a tear the first, and of a face those that it has. A mesh that is refused is refused where the body is
/// made.
/// throws  InputError "FILE: /fixed/0/ids/1: ..." for a number that is no point of the file, or one of no cell, and for
///         any in a scene of several bodies; as resolve_tags
void load_mesh(SceneFile& scene);

/// The number by which a user knows a point of the body: that of the mesh file, if the body comes from one, and the
/// same for all that are split off one; of several bodies, and of those that are generated, the number itself.
std::size_t number_in_file(const SceneFile& scene, std::uint32_t point);
/// Those of all points of the body; empty where each is the point's own.
std::vector<std::uint32_t> numbers_in_file(const SceneFile& scene);

}  // namespace dartboard
