#pragma once
// The ways out of a cell of top dimension: its facets, across which alpha_n leads to the neighbours.

#include <cstdint>

#include "core/topology/cells.h"

namespace dartboard {

/// Call f(dart) for darts of the n-cell, at least one on each of its facets (faces of a volume, edges of a surface's
/// face); a facet may be reported more than once.
///
/// cost    O(darts of the cell); four calls for a tetrahedron
template <class Map, class F>
void for_each_facet_dart(const Map& map, Cell<Map::dimension> cell, F&& f) {
  if constexpr (Map::tetrahedral) {
    const std::uint32_t first = cell.dart.index - cell.dart.index % 24;
    for (std::uint32_t p = 0; p < 24; p += 6) f(Dart{first + p});
  } else {
    for_each_dart_of(map, cell, [&f](Dart d) { f(d); });
  }
}

}  // namespace dartboard
