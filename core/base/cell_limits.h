#pragma once
// The number of cells that a map can hold: its elements are numbered in 32 bits.

#include <array>
#include <cstdint>
#include <string>

#include "core/plain/mesh.h"

namespace dartboard {

/// Tetrahedra of a map of tetrahedra alone: a face is stored as 8 times its number, four per tetrahedron, plus a turn.
inline constexpr std::uint64_t most_tetrahedra = (std::uint64_t{1} << 32) / (4 * 8);
/// Darts of any other map: the alphas are numbered too, dimension + 1 for each dart.
constexpr std::uint64_t most_darts(int dimension) {
  return (std::uint64_t{1} << 32) / (static_cast<std::uint64_t>(dimension) + 1);
}

/// A dart for each end of each edge of each face.
constexpr std::uint64_t darts_of(CellKind kind) {
  constexpr std::array<std::uint64_t, 6> counts{6, 8, 24, 32, 36, 48};
  return counts[static_cast<std::size_t>(kind)];
}

/// The numbers of cells of each kind, in the order of CellKind; they may exceed 32 bits.
using CountsByKind = std::array<double, 6>;

/// The excess of a mesh with so many cells, and the limit: "134554608 tetrahedra, where a map numbers at most
/// 134217728". Empty if they fit.
std::string beyond_a_map(const CountsByKind& cells);

}  // namespace dartboard
