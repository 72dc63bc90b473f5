#pragma once
// The conditions for every mesh from outside before a body is built of it.

#include <cstdint>
#include <span>
#include <string>

#include "core/meshes/formats/loaded_mesh.h"

namespace dartboard {

/// Check a mesh, and turn inverted volumes right-handed by mirroring the order of their nodes.
///
/// Refused: no cell; polygons mixed with volumes; an index out of range; a coordinate that is not finite; a node twice
/// in a cell; two cells of the same nodes; a face of more than two volumes or, for a surface, an edge of more than
/// two polygons; a cell that crosses itself, unless `keep_crossed`; a cell without volume (or area). Noted: how many
/// cells were reordered, and how many points coincide with another, or almost, as they do in a torn body.
///
/// `cell_lines` holds the line of each cell in `file`, or is empty.
///
/// throws  IoError; cells are named by their index, points by their number in the file, both from 0
void check_and_repair(LoadedMesh& loaded, const std::string& file, std::span<const std::uint32_t> cell_lines = {},
                      bool keep_crossed = false);

}  // namespace dartboard
