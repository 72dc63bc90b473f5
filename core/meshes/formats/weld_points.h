#pragma once
// Seams closed: points at almost the same place made one.

#include <cstdint>
#include <span>
#include <string>

#include "core/meshes/formats/loaded_mesh.h"

namespace dartboard {

/// Make points that are at most `distance` apart one, and those that hang together by such pairs; the point of the
/// lowest number stays where it is, and the others become that point. A notice says how many.
///
/// `cell_lines` holds the line of each cell in `file`, or nothing.
///
/// pre     finite coordinates
/// throws  InputError for a distance that is not positive, or that joins two corners of one cell
void weld_points(LoadedMesh& loaded, double distance, const std::string& file,
                 std::span<const std::uint32_t> cell_lines);

/// What points that would be welded have in common, as a notice: how many there are, how far from another, and the
/// distance that would join them; empty where there are none.
std::string open_seams(const LoadedMesh& loaded);

}  // namespace dartboard
