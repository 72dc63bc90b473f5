#pragma once
// From a mesh to a map: darts cell by cell, then shared faces are sewn. They are matched by numbers, not by geometry.

#include <cstdint>
#include <vector>

#include "core/plain/mesh.h"
#include "core/topology/generalized_map.h"

namespace dartboard {

/// Add the darts of one cell, sewn within the cell, and return the first.
///
/// Face by face as `faces_of(kind)` lists them, edge by edge around the face; darts 2k and 2k + 1 of a face are the two
/// ends of its k-th edge.
/// throws  TopologyError if the map cannot hold the kind (a hexahedron in a tetrahedral map, a volume in a 2-g-map)
template <class Map>
Dart add_cell(Map& map, CellKind kind);

/// Remove all darts of an isolated cell of top dimension.
/// throws  TopologyError, map unchanged, if a dart of it is not n-free
template <class Map>
void remove_cell(Map& map, Dart d);

/// A map, and the points and cells of the mesh that its darts came from.
template <class Map>
struct BuiltMap {
  Map map;
  std::vector<std::uint32_t> point;       // by map.slot<0>(dart): number of the mesh point
  std::vector<std::uint32_t> first_dart;  // by mesh cell: its first dart
};

/// Build the map of a mesh: an n-g-map in which two cells are n-sewn where they share a face (an edge, for a surface).
///
/// throws  InputError if the mesh has cells of another dimension or kind than the map holds, a cell repeats a node or
///         names a point that does not exist, or a face is shared by three cells
/// cost    O(cells), 0.3 microseconds per tetrahedron of a TetMap
template <class Map>
BuiltMap<Map> build_map(const Mesh& mesh);

extern template BuiltMap<Map2> build_map(const Mesh&);
extern template BuiltMap<Map3> build_map(const Mesh&);
extern template BuiltMap<TetMap> build_map(const Mesh&);
extern template Dart add_cell(Map2&, CellKind);
extern template Dart add_cell(Map3&, CellKind);
extern template Dart add_cell(TetMap&, CellKind);
extern template void remove_cell(Map2&, Dart);
extern template void remove_cell(Map3&, Dart);
extern template void remove_cell(TetMap&, Dart);

}  // namespace dartboard
