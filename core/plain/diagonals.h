#pragma once
// Springs within a cell in addition to those of its edges: between corners that no edge joins.

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "core/plain/mesh.h"

namespace dartboard {

/// Which diagonals of cells carry springs: those across faces, those through volumes, or both.
enum class Diagonals : std::uint8_t { none, faces, volumes, all };
/// "none", "faces", "volumes", "all"
inline constexpr std::array<std::string_view, 4> diagonals_names{"none", "faces", "volumes", "all"};
constexpr std::string_view name(Diagonals diagonals) { return diagonals_names[static_cast<std::size_t>(diagonals)]; }

/// A spring between two corners of a cell, in the node order of its kind. With a Young's modulus E, one of rest length
/// l in a cell of volume (area) V has the stiffness weight E V / l^2.
struct CornerSpring {
  int a, b;
  double weight;
};

/// The diagonals of a kind of cell: 12 of the faces and 4 of the volume of a hexahedron, 6 of the faces of a prism, 2
/// of the base of a pyramid, 2 of a quadrilateral. Other kinds have no diagonals.
std::span<const CornerSpring> diagonals_of(CellKind kind, Diagonals diagonals);
/// No kind has more.
inline constexpr std::size_t most_diagonals = 16;

/// The edges and their weights for a cell that has these diagonals. The weight is 1 if the cell has no such diagonals.
///
/// The weights make springs an elastic solid of this modulus and of Poisson's ratio 1/4 (a surface: 1/3): exactly, in
/// cubes, in prisms as high as the sides of their equal-sided triangles are long, in squares; for pyramids in the mean
/// of the six that fill a cube. The weights add up to 6 (3), so it holds for cells of any shape in the mean over all
/// directions, as it does for tetrahedra (core/base/young.h).
/// source  sum of weight n n n n over the directions n, compared with the elasticity tensor; cubes of side a then have
///         .1 E a along edges and .2 E a across faces, or .2 E a and .3 E a through the volume, or the mean of both
std::span<const CornerSpring> edges_beside(CellKind kind, Diagonals diagonals);

}  // namespace dartboard
