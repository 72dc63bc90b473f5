#pragma once
// Points that several files of one mesh hold, made one.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "core/meshes/formats/mesh_builder.h"

namespace dartboard {

/// The points of a file are those from `first_point` to that of the next.
struct PieceFile {
  std::string name;
  std::size_t first_point;
};

/// Join the points of different pieces that are equal number for number, so that -0 is 0; those of one piece stay
/// apart, as a torn body has them.
///
/// returns  how many points are no more
/// throws   IoError where it cannot be told which are meant: a piece has several points at the place of another's; or
///          points of two pieces are not equal but nearer than a thousandth of the shortest edge and a millionth of the
///          size of the mesh, which leaves it open whether the pieces belong together there
/// cost     O(n log n) in the points
std::size_t join_pieces(std::span<const PieceFile> pieces, const std::string& file, MeshBuilder& builder);

}  // namespace dartboard
