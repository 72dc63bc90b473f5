#pragma once
// Springs that represent an elastic solid: the stiffness of the edges of simplices from a Young's modulus.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/plain/mesh.h"

namespace dartboard {

/// The number of the first cell whose edges alone do not hold its shape: neither a tetrahedron nor a triangle.
std::optional<std::size_t> first_loose_cell(const Mesh& mesh);
/// The number of the first such cell among these.
std::optional<std::size_t> first_loose_cell(const Mesh& mesh, std::span<const std::uint32_t> cells);

/// The stiffness [N/m] of the springs of a Young's modulus, a mean over the edges of all cells: that of the edge of
/// rest length l of a cell of volume V (area, length) is young V / l^2. The links of chains are cells of one edge.
///
/// Averaged over all directions, the energy of such edges is that of an elastic solid with this modulus: in tetrahedra
/// of Poisson's ratio 1/4, in triangles of 1/3; it cannot be chosen. Single meshes have directions: a box of cubes of
/// six tetrahedra is too stiff by a fifth along its axes if its sides are held (13/9 in place of 6/5).
/// throws  InputError for a mesh with a loose cell
/// cost    a pass over the mesh
/// source  Van Gelder, Journal of Graphics Tools 3(2), 1998: k = E V / l^2; the averages by integration over directions
double mean_stiffness(const Mesh& mesh, double young);
/// A mean over the edges of these cells; numbers from the number of cells on are links.
double mean_stiffness(const Mesh& mesh, double young, std::span<const std::uint32_t> cells);

}  // namespace dartboard
