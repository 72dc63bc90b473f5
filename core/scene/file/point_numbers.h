#pragma once
// Points as a scene numbers them, from 0 in the order of the mesh file, and as the body has them.

#include "core/scene/file/scene_file.h"

namespace dartboard {

/// Replace the point numbers of a scene whose mesh file has points of no cell, which a body cannot have, by the places
/// of those that are kept. A mesh that cannot be read is left to who makes the body.
///
/// throws  InputError "FILE: /fixed/0/ids/1: ..." for a number that is no point of the file, or one of no cell
/// cost    the mesh is read where the scene has such numbers
void number_points_as_kept(SceneFile& scene);

}  // namespace dartboard
