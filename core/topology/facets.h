#pragma once
// Facets of cells of top dimension, faces of a solid and edges of a surface: alpha_n leads across them.

#include <cstdint>
#include <vector>

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

/// Call f(dart) for every facet between two cells, with its lowest dart, ascending.
///
/// cost    O(darts); a sixth for tetrahedra
template <class Map, class F>
void for_each_inner_facet(const Map& map, F&& f) {
  constexpr int n = Map::dimension;
  if constexpr (Map::tetrahedral) {  // six darts to a face, which the lower of two tetrahedra reports
    const auto end = static_cast<std::uint32_t>(map.capacity());
    for (Dart d{0}; d.index < end; d.index += 6)
      if (map.is_live(d) && map.template alpha<n>(d).index / 6 > d.index / 6) f(d);
  } else {
    for_each_cell<n - 1>(map, [&](Cell<n - 1> facet) {
      if (!map.template is_free<n>(facet.dart)) f(facet.dart);
    });
  }
}

template <class Map>
std::vector<Dart> inner_facets(const Map& map) {
  std::vector<Dart> facets;
  for_each_inner_facet(map, [&facets](Dart d) { facets.push_back(d); });
  return facets;
}

}  // namespace dartboard
