#pragma once
// Joining of points that several files of one mesh have in common.

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

/// Join the points of different pieces that have equal coordinates, with -0 equal to 0; points of one piece stay
/// separate, as in a torn body.
///
/// returns  the number of points removed
/// throws   IoError if the pairs are ambiguous: a piece has several points at the place of another's; or
///          points of two pieces are not equal but nearer than a thousandth of the shortest edge and a millionth of the
///          size of the mesh, so that it is uncertain whether the pieces belong together there
/// cost     O(n log n) in the points
std::size_t join_pieces(std::span<const PieceFile> pieces, const std::string& file, MeshBuilder& builder);

}  // namespace dartboard
