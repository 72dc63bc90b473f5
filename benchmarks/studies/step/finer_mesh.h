#pragma once
// Meshes of the same body with smaller cells, in the order that their mesher has left.

#include <cstddef>

#include "core/plain/mesh.h"

namespace dartboard {

/// Each tetrahedron as eight: one at each corner, and four around the shortest diagonal of the octahedron between them.
/// New points, in the middles of edges, follow the old ones in the order in which cells meet them; the eight of a cell
/// take its place.
/// throws  InputError for a cell that is no tetrahedron
Mesh finer_mesh(const Mesh& mesh);

/// Made finer until there are so many cells.
/// pre  there is a cell
Mesh finer_mesh_of(Mesh mesh, std::size_t least_cells);

}  // namespace dartboard
