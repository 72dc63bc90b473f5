#pragma once
// The sizes that a map of a mesh will have, counted from the mesh: no map is built.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/plain/mesh.h"

namespace dartboard {

/// The counts of the map of a mesh, and its vertices by the numbers that a body will give them.
///
/// Bodies number vertices by their lowest dart (`build_body`), and darts are made cell by cell in the order
/// of `faces_of`: so numbers follow the order of first appearance. Points and pairs of points are counted:
/// the mesh of a body has a point for each vertex (split_touching_points), and two edges between the same two points
/// are one here.
struct MeshTally {
  std::size_t vertices = 0, edges = 0, faces = 0, cells = 0;  // cells: volumes, or the faces of a surface
  std::size_t darts = 0;
  std::size_t components = 0;
  std::size_t boundary_facets = 0, boundary_corners = 0;  // faces of a solid, edges of a surface, with one cell

  std::vector<std::uint32_t> point;                          // by vertex: its point of the mesh
  std::vector<std::array<std::uint32_t, 2>> cells_of_facet;  // of those between two cells
};

/// Of solids, surfaces and chains in one mesh the counts are those of all of them, which bodies hold one after another.
///
/// pre     cells name points of the mesh
/// cost    O(darts), some 0.2 microseconds per dart
MeshTally tally_of(const Mesh& mesh);

}  // namespace dartboard
