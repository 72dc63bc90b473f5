#pragma once
// The cells of a large mesh along a space-filling curve, where that brings neighbours closer together in memory.

#include <cstdint>
#include <span>
#include <vector>

#include "core/plain/problem.h"

namespace dartboard {

/// Vertices whose numbers differ by no more than this are near each other in memory: the places and velocities of so
/// many take a tenth of a second-level cache.
inline constexpr std::uint32_t near_vertices = 4096;

/// The numbers of the cells in the order in which they are built. Empty where that is the order of the mesh: if it is
/// no worse than twice the curve, by the cells that span more than `near_vertices`; so always up to so many points.
///
/// Vertices are numbered as cells reach them, so a body is stored in this order altogether.
/// cost    O(n log n) for n cells
/// source  J. Skilling, Programming the Hilbert curve, AIP Conference Proceedings 707, 2004
std::vector<std::uint32_t> order_along_curve(const Mesh& mesh);

/// The numbers of the cells in the order of the mesh.
std::vector<std::uint32_t> order_of_mesh(const Mesh& mesh);
/// The cells whose corners have numbers more than `near_vertices` apart if points are numbered as cells reach them in
/// this order.
std::size_t count_wide_cells(const Mesh& mesh, std::span<const std::uint32_t> order);

/// The problem with its cells in this order.
Problem in_order(const Problem& problem, std::span<const std::uint32_t> order);

}  // namespace dartboard
