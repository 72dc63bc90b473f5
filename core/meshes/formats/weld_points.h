#pragma once
// Closing of seams: points at almost the same place become one.

#include <cstdint>
#include <span>
#include <string>

#include "core/meshes/formats/loaded_mesh.h"

namespace dartboard {

/// Make points that are at most `distance` apart one, and those connected by such pairs; the point of the lowest number
/// keeps its place, and the others become that point. A notice gives their number.
///
/// `cell_lines` holds the line of each cell in `file`, or is empty.
///
/// pre     finite coordinates
/// throws  InputError for a distance that is not positive, or that joins two corners of one cell
void weld_points(LoadedMesh& loaded, double distance, const std::string& file,
                 std::span<const std::uint32_t> cell_lines);

/// A notice about points that could be welded: their number, their distances, and the distance that would join them;
/// empty without such points.
std::string open_seams(const LoadedMesh& loaded);

}  // namespace dartboard
