#pragma once
// The direction that the edges of a mesh favour, if any: springs along the edges make the body anisotropic.

#include <Eigen/Core>
#include <optional>
#include <string>

#include "core/plain/mesh.h"
#include "core/scene/file/scene_file.h"

namespace dartboard {

/// The direction in which most of the edges of the cells lie.
struct MeshDirection {
  Eigen::Vector3d axis;  // a unit vector
  double ratio;          // of the sum of squares of the edges along it to that along the direction where it is least
};

/// The direction of the edges of all cells, each counted once for every cell that has it; no value for a mesh without
/// cells or in a line or plane.
///
/// A box cut alike around diagonals along (1, 1, 1) has the ratio 4, a box of even counts cut in mirror images 1.
std::optional<MeshDirection> direction_of(const Mesh& mesh);

/// The effect of such a direction on a body, in words, if the ratio is 1.5 or more; otherwise empty.
std::string direction_in_words(const SceneFile& scene, const Mesh& mesh);

}  // namespace dartboard
