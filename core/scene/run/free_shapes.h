#pragma once
// Ways in which a cell can change its shape without any spring of its edges changing length, to first order.

#include <cstddef>
#include <map>
#include <string>

#include "core/plain/mesh.h"

namespace dartboard {

/// How many there are for a cell whose edges alone carry springs: 3 n coordinates, less the rank of the springs'
/// stiffness, less the six motions of a rigid body. None of a tetrahedron, 1 of a pyramid, 3 of a prism, 6 of a
/// hexahedron.
///
/// pre  a volume
std::size_t free_shapes(CellKind kind);

/// A warning of the cells in a body that have some, by how many there are of each kind; empty where none has.
std::string free_shapes_of(const std::map<CellKind, std::size_t>& counts);

}  // namespace dartboard
