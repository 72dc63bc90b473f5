#pragma once
// Delaunay tetrahedralisations: meshes without a pattern, with vertices of every degree and cells of every shape.

#include <cstdint>
#include <span>

#include "core/meshes/generators/mesh_generators.h"
#include "core/plain/mesh.h"

namespace dartboard {

/// The Delaunay tetrahedralisation of random points, uniform in the unit ball; its boundary is that of their convex
/// hull. Points ascend by x, then y, then z; cells by their sorted nodes. About 6.5 tetrahedra per point, slivers
/// included, all of positive signed_measure: if rounding leaves one without, all points are drawn again.
///
/// throws  InputError if points < 4
Mesh delaunay_ball(int points, std::uint64_t seed);

/// As test_meshes(), of 100 to 2,000 cells.
std::span<const NamedMesh> delaunay_meshes();

}  // namespace dartboard
