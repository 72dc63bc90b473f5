#pragma once
// Refinement on the map: stellar subdivision of an edge, a face or a volume of tetrahedra (the paper's future work).

#include <array>
#include <cstdint>
#include <vector>

#include "core/topology/generalized_map.h"

namespace dartboard {

/// A vertex was put into a cell with s vertices, and each tetrahedron around it became s: in every one of them the new
/// vertex took the place of another node of the cell.
struct Subdivision {
  using Darts = std::array<Dart, 24>;  // of a tetrahedron, in the order of tet_darts

  struct Parent {
    Darts darts;           // dead now; labels kept by slot can still be read there
    std::uint8_t of_cell;  // bit n: node n belongs to the cell
  };
  struct Child {
    std::uint32_t parent;
    std::uint8_t replaced;  // the node of the parent whose place the new vertex took; the other three are the parent's
    Darts darts;
  };
  int cell_vertices = 0;  // s: 2 for an edge, 3 for a face, 4 for a volume
  std::vector<Parent> parents;
  std::vector<Child> children;  // s for each parent, in the parents' order

  /// A dart of the new vertex.
  Dart vertex() const;
};

/// Subdivide the cell: an edge (i = 1), a face (2) or a volume (3).
///
/// throws  TopologyError, map unchanged, if the dart is dead, a volume around the cell is no tetrahedron, or one of
///         them meets the cell more than once
/// cost    O(tetrahedra around the cell)
template <int i, class Map>
Subdivision subdivide(Map& map, Cell<i> cell);

#define DARTBOARD_SUBDIVIDE(prefix, Map)                \
  prefix template Subdivision subdivide(Map&, Cell<1>); \
  prefix template Subdivision subdivide(Map&, Cell<2>); \
  prefix template Subdivision subdivide(Map&, Cell<3>);
DARTBOARD_SUBDIVIDE(extern, Map3)
DARTBOARD_SUBDIVIDE(extern, TetMap)

}  // namespace dartboard
