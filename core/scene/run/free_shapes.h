#pragma once
// Ways in which a cell can change its shape without any of its springs changing length, to first order.

#include <cstddef>
#include <map>
#include <string>

#include "core/plain/diagonals.h"
#include "core/plain/mesh.h"

namespace dartboard {

/// How many there are for a cell whose edges and these diagonals carry springs: 3 n coordinates, less the rank of the
/// springs' stiffness, less the six motions of a rigid body. Of edges alone none of a tetrahedron, 1 of a pyramid, 3 of
/// a prism, 6 of a hexahedron; diagonals of faces leave none, those of the volume 2 of a hexahedron.
///
/// pre  a volume
std::size_t free_shapes(CellKind kind, Diagonals diagonals = Diagonals::none);

/// A warning of the cells in a body that have some, by how many there are of each kind; empty where none has.
std::string free_shapes_of(const std::map<CellKind, std::size_t>& counts, Diagonals diagonals = Diagonals::none);

}  // namespace dartboard
