#pragma once
// Free shapes: changes of a cell's shape in which no spring of it changes length, to first order.

#include <cstddef>
#include <map>
#include <string>

#include "core/plain/diagonals.h"
#include "core/plain/mesh.h"

namespace dartboard {

/// The number of free shapes of a cell whose edges and these diagonals carry springs: 3 n coordinates, less the rank of
/// the springs' stiffness, less the six motions of a rigid body. With edges alone 0 for a tetrahedron, 1 for a pyramid,
/// 3 for a prism, 6 for a hexahedron; with diagonals of faces 0, with those of the volume 2 for a hexahedron.
///
/// pre  a volume
std::size_t free_shapes(CellKind kind, Diagonals diagonals = Diagonals::none);

/// A warning about the cells of a body that have free shapes, from the counts of cells by kind; empty without any.
std::string free_shapes_of(const std::map<CellKind, std::size_t>& counts, Diagonals diagonals = Diagonals::none);

}  // namespace dartboard
