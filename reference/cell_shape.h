#pragma once
// The faces and edges of cells from one rule, without a table: a cell is a unit cube some of whose corners coincide.

#include <array>
#include <span>
#include <utility>
#include <vector>

#include "core/plain/mesh.h"

namespace dartboard::reference {

/// The node of a 3D cell at each corner (r, s, t) of the unit cube, at place r + 2 s + 4 t.
std::array<int, 8> corners_of(CellKind kind);

/// The faces of a cell, each as a cycle of local nodes: the sides of the cube that keep three corners or more. A 2D
/// kind has one face, itself. The orders, and the sense in which a cycle runs, are not those of core.
std::span<const std::vector<int>> own_faces(CellKind kind);

/// The edges of a cell, each once, as pairs of local nodes, the lower first.
std::span<const std::pair<int, int>> own_edges(CellKind kind);

}  // namespace dartboard::reference
