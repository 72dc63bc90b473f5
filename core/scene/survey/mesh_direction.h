#pragma once
// Whether the edges of a mesh favour a direction, which springs along them then give to the body.

#include <Eigen/Core>
#include <optional>
#include <string>

#include "core/plain/mesh.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// The direction in which the edges of the cells lie most.
struct MeshDirection {
  Eigen::Vector3d axis;  // a unit vector
  double ratio;          // of the sum of squares of the edges along it to that along the direction where it is least
};

/// Of the edges of all cells, each counted once for every cell that has it; nothing for a mesh without cells or in a
/// line or plane.
///
/// A box cut alike around diagonals along (1, 1, 1) has 4, one of even counts that is cut in mirror images 1.
std::optional<MeshDirection> direction_of(const Mesh& mesh);

/// What such a direction does to a body, where the ratio is 1.5 or more; empty elsewhere.
std::string direction_in_words(const SceneFile& scene, const Mesh& mesh);

}  // namespace dartboard
