#pragma once
// The coverage of cells together with all places of each.

#include <cstdint>
#include <vector>

#include "core/topology/cells.h"

namespace dartboard {

/// Call f(cell, places) once for each i-cell, by its dart of lowest number and in ascending order, with one dart for
/// every place `slot<i>` of it (for_each_place_of), that of the cell's first.
///
/// `seen` is a mark of the caller, so that several threads can walk the map at once, each with its own.
///
/// pre     nothing is marked
/// cost    one walk of the map: to label all cells by `for_each_cell` takes two
template <int i, class Map, class F>
void for_each_cell_with_places(const Map& map, Mark& seen, F&& f) {
  std::vector<Dart> places;
  const auto cover = [&](Dart d) {
    places.clear();
    for_each_place_of(map, Cell<i>{d}, seen, [&places](Dart e) { places.push_back(e); });
    if (!places.empty()) f(Cell<i>{d}, places);
  };
  if constexpr (Map::tetrahedral) {
    constexpr unsigned within = cell_orbit<i, Map>().bits & 7u;
    const auto end = static_cast<std::uint32_t>(map.capacity());
    for (std::uint32_t first = 0; first < end; first += 24) {
      if (!map.is_live({first})) continue;
      for (std::uint32_t p = 0; p < 24; ++p)
        if (tet_darts.lowest(within, p) == p) cover({first + p});
    }
  } else {
    map.for_each_dart(cover);
  }
}

template <int i, class Map, class F>
void for_each_cell_with_places(const Map& map, F&& f) {
  Mark seen(map);
  for_each_cell_with_places<i>(map, seen, f);
}

}  // namespace dartboard
